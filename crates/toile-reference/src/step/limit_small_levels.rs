//! The predictive rule on all small levels.

use super::{lead_level, limit_level};
use crate::{Nodes, Particles};
use toile_model::{Arrays, StepSettings};

/// Leads and limits the nodes of each small level, from the coarsest to the finest of them.
pub fn limit_small_levels(nodes: &mut Nodes, particles: &Particles, model: &Arrays, settings: &StepSettings) {
    for level in model.levels.iter().rev().filter(|level| level.is_small()) {
        lead_level(nodes, &level.nodes, particles, model, settings.dt);
        for colour in (0..settings.level_passes(level)).flat_map(|_| &level.colours) {
            limit_level(nodes, model, colour, StepSettings::relaxation(level));
        }
    }
}
