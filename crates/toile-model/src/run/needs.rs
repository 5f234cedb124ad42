//! What a solver must have for a model.

use crate::{Model, StepSettings};
use toile_scene::Rule;

/// What the maps show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Maps {
    /// There are none.
    None,
    /// Bodies at rest: depth and normals.
    Still,
    /// Bodies that move: velocities too.
    Moving,
}

/// What a solver must have for a model: passes, buffers and textures exist for this and nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs {
    /// Mesh bodies, sampled through maps.
    pub maps: Maps,
    /// Air around the cloth.
    pub wind: bool,
    /// Analytic shapes.
    pub shapes: bool,
    /// Held edges.
    pub holds: bool,
    /// Open seams.
    pub seams: bool,
    /// The rule of the velocity modification; `None` without limits.
    pub rule: Rule,
    /// Springs whose elongation is reported.
    pub limits: bool,
    /// Pins that hold particles farther away.
    pub attachments: bool,
    /// Further sweeps in steps that need them.
    pub polish: bool,
}

impl Needs {
    /// What this model needs, with or without maps and shapes.
    ///
    /// # Panics
    /// When the rule of the settings is hierarchical and that of the model is not, or when there is a polish under a rule that is not
    /// predictive.
    pub fn new(model: &Model, settings: &StepSettings, maps: Maps, shapes: bool) -> Self {
        let hierarchical = Rule::Hierarchical;
        assert!(
            settings.rule != hierarchical || model.rule == hierarchical,
            "a model has strands only when it was made for the hierarchical rule"
        );
        assert!(
            settings.polish.is_none() || matches!(settings.rule, Rule::Predictive | Rule::Hierarchical),
            "a polish measures what the coming move would do, so it needs a predictive rule"
        );
        let limits = !model.limits.is_empty();
        let rule = if limits && settings.sweeps > 0 { settings.rule } else { Rule::None };
        Self {
            wind: settings.wind.is_some(),
            maps,
            shapes,
            holds: !model.holds.is_empty() && settings.hold_rate > 0.0,
            seams: !model.seam_pairs.is_empty(),
            rule,
            limits,
            attachments: rule == Rule::Hierarchical && !model.attachments.values.is_empty(),
            polish: rule != Rule::None && settings.polish.is_some(),
        }
    }

    /// Whether single springs have the last word. Seams that are still open would be held apart by them.
    pub fn guard(&self) -> bool {
        self.rule == Rule::Hierarchical && !self.seams
    }

    /// Whether there is any body to collide with.
    pub fn body(&self) -> bool {
        self.maps != Maps::None || self.shapes
    }
}
