//! The predictive rule: no spring is over-long after the coming move.

use super::pair::{after_move, inverse_mass_sum, pull_together};
use crate::Particles;
use glam::Vec3;
use toile_model::Limit;

/// Removes from the velocities of both ends, by inverse mass, what would make a limit over-long after a move of `dt` [s], and adds it to `pulls`
/// [m/s], shape [particle_count]. The limits are those of one colour: no two share a particle.
pub fn limit_predictive(particles: &mut Particles, limits: &[Limit], pulls: &mut [Vec3], dt: f32) {
    for limit in limits {
        let weight = inverse_mass_sum(particles, limit.ends);
        if !(weight > 0.0) {
            continue;
        }
        let span = after_move(particles, limit.ends, dt);
        let length = span.length();
        if length > limit.max_length {
            let pull = (length - limit.max_length) / (dt * weight);
            let impulse = span * (pull / length);
            pull_together(particles, limit.ends, impulse);
            let [a, b] = limit.ends.map(|end| end as usize);
            pulls[a] += impulse * particles.inverse_masses[a];
            pulls[b] -= impulse * particles.inverse_masses[b];
        }
    }
}
