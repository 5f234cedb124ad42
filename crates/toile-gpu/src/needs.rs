//! When each need of the kernel table holds.

use crate::step_params::{Counts, step_params};
use toile_kernels::Need;
use toile_model::{Level, Model, StepSettings};
use toile_scene::{MapKind, Rule};

/// What the maps show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Maps {
    /// There are none.
    None,
    /// The papers' maps; `moving` with velocities.
    Sides {
        /// Whether anything in them moves.
        moving: bool,
    },
    /// Layered maps; `moving` with velocities.
    Layers {
        /// Whether anything in them moves.
        moving: bool,
    },
}

impl Maps {
    /// Maps of a kind.
    pub fn of(kind: MapKind, moving: bool) -> Self {
        match kind {
            MapKind::Sides => Self::Sides { moving },
            MapKind::Layers => Self::Layers { moving },
        }
    }
}

/// What decides which passes a cloth gets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Needs<'a> {
    model: &'a Model,
    settings: &'a StepSettings,
    maps: Maps,
    shapes: bool,
    /// The rule that acts: none without limits and without sweeps.
    rule: Rule,
}

impl<'a> Needs<'a> {
    pub(crate) fn new(model: &'a Model, settings: &'a StepSettings, maps: Maps, shapes: bool) -> Self {
        let hierarchical = Rule::Hierarchical;
        assert!(
            settings.rule != hierarchical || model.rule == hierarchical,
            "a model has levels only when it was made for the hierarchical rule"
        );
        assert!(
            settings.polish.is_none() || matches!(settings.rule, Rule::Predictive | Rule::Hierarchical),
            "a polish measures what the coming move would do, so it needs a predictive rule"
        );
        let rule = if model.limits.is_empty() || settings.sweeps == 0 { Rule::None } else { settings.rule };
        Self { model, settings, maps, shapes, rule }
    }

    /// Whether a need holds.
    pub(crate) fn hold(&self, need: Need) -> bool {
        let Self { model, settings, maps, shapes, rule } = *self;
        let hierarchical = rule == Rule::Hierarchical;
        match need {
            Need::Nothing => true,
            // What a body has is no need of a cloth.
            Need::Joints | Need::Morphs | Need::Hosted => false,
            // No pass hangs on whether shapes are sampled after maps.
            Need::Number(name) => step_params(Counts::of(model), settings, false).has(name),
            Need::Wind => settings.wind.is_some(),
            Need::Body => maps != Maps::None || shapes,
            Need::StillSides => maps == Maps::Sides { moving: false },
            Need::MovingSides => maps == Maps::Sides { moving: true },
            Need::StillLayers => maps == Maps::Layers { moving: false },
            Need::MovingLayers => maps == Maps::Layers { moving: true },
            Need::Shapes => shapes,
            Need::Holds => !model.holds.is_empty() && settings.hold_rate > 0.0,
            Need::Seams => !model.seam_pairs.is_empty(),
            Need::Limits => !model.limits.is_empty(),
            Need::RuleZero => rule == Rule::Zero,
            Need::RuleAverage => rule == Rule::Average,
            Need::RuleDirectional => rule == Rule::Directional,
            Need::Pulls => hierarchical || rule == Rule::Predictive,
            Need::RulePredictive => rule == Rule::Predictive,
            Need::RulePosition => rule == Rule::Position,
            Need::Levels => hierarchical,
            Need::SmallLevels => hierarchical && model.levels.iter().any(Level::is_small),
            Need::Attachments => hierarchical && !model.attachments.values.is_empty(),
            // Seams that are still open would be held apart by single springs that have the last word.
            Need::Guard => hierarchical && !self.hold(Need::Seams),
            Need::GuardOnBody => self.hold(Need::Guard) && self.hold(Need::Body),
            Need::Polish => rule != Rule::None && settings.polish.is_some(),
        }
    }
}
