//! What a solver must have for a model.

use crate::{Model, StepSettings};
use toile_scene::Rule;

/// What a solver must have for a model: passes, buffers and textures exist for this and nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs {
    /// Air around the cloth.
    pub wind: bool,
    /// A mesh body, sampled through maps.
    pub maps: bool,
    /// An analytic sphere.
    pub sphere: bool,
    /// Held edges.
    pub holds: bool,
    /// Open seams.
    pub seams: bool,
    /// The rule of the velocity modification; `None` without limits.
    pub rule: Rule,
    /// Springs whose elongation is reported.
    pub limits: bool,
}

impl Needs {
    /// What this model needs, with or without maps and sphere.
    pub fn new(model: &Model, settings: &StepSettings, maps: bool, sphere: bool) -> Self {
        let limits = !model.limits.is_empty();
        Self {
            wind: settings.wind.is_some(),
            maps,
            sphere,
            holds: !model.holds.is_empty() && settings.hold_rate > 0.0,
            seams: !model.seam_pairs.is_empty(),
            rule: if limits && settings.sweeps > 0 { settings.rule } else { Rule::None },
            limits,
        }
    }

    /// Whether there is any body to collide with.
    pub fn body(&self) -> bool {
        self.maps || self.sphere
    }
}
