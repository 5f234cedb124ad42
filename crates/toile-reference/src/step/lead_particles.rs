//! The cloth follows its coarse particles.

use super::lead_coarse::led;
use crate::{Coarse, Particles};
use toile_model::{Csr, Leader};

/// Changes the velocities so that a move of `dt` [s] takes each particle as much farther as the coarse particles that lead it have been
/// shifted. `leaders` are those of the model.
pub fn lead_particles(particles: &mut Particles, coarse: &Coarse, leaders: &Csr<Leader>, dt: f32) {
    for (i, velocity) in particles.velocities.iter_mut().enumerate() {
        *velocity += led(&coarse.shifts, leaders.row(i)) / dt;
    }
}
