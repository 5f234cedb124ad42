//! Labelled edges are drawn to their height while the garment is sewn.

use crate::Particles;
use toile_model::{Hold, StepSettings};

/// Accelerates each held particle to its height, in proportion to its distance from it and with a bound, so that seams and
/// limits are stronger.
pub fn hold_edges(particles: &mut Particles, holds: &[Hold], settings: &StepSettings) {
    for hold in holds {
        let i = hold.particle as usize;
        if particles.inverse_masses[i] > 0.0 {
            let wanted = settings.hold_stiffness * (hold.height - particles.positions[i].y);
            // Not `clamp`: a NaN must go the way WGSL's min(max()) sends it, without a panic.
            let acceleration = wanted.max(-settings.hold_acceleration).min(settings.hold_acceleration);
            particles.velocities[i].y += acceleration * settings.dt;
        }
    }
}
