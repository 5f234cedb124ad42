//! Particles begin a step with part of what limits gave them in the last one.

use crate::Particles;
use glam::Vec3;

/// Part of what limits gave that a step begins with [1]. With more the slow modes of a cloth swing up: where a step leaves the part τ of what
/// a mode lacks, its error follows z³ = τ·((2 + c)·z² − (1 + 2·c)·z + c), and no root leaves the unit circle for any τ < 1 up to c = 1/2.
const CARRIED: f32 = 0.5;

/// Gives each particle half of the velocity that limits gave it in the last step: `pulls` [m/s], shape [particle_count].
pub fn warm_start(particles: &mut Particles, pulls: &mut [Vec3]) {
    for (velocity, pull) in particles.velocities.iter_mut().zip(pulls) {
        *pull *= CARRIED;
        *velocity += *pull;
    }
}
