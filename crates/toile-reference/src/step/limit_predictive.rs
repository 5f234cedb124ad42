//! The predictive rule: no spring is over-long after the coming move.

use super::pair::{after_move, inverse_mass_sum, pull_together};
use crate::Particles;
use toile_model::Limit;

/// Removes from the velocities of both ends, by inverse mass, what would make a limit over-long after a move of `dt` [s]. `impulses` are
/// what the limits have pulled with in this step so far [N·s]; a limit that is shorter than it may be takes back of its own what is too
/// much, and no more, so that it never pushes. The limits are those of one colour: no two share a particle.
pub fn limit_predictive(particles: &mut Particles, limits: &[Limit], impulses: &mut [f32], dt: f32) {
    for (limit, impulse) in limits.iter().zip(impulses) {
        let weight = inverse_mass_sum(particles, limit.ends);
        if !(weight > 0.0) {
            continue;
        }
        let span = after_move(particles, limit.ends, dt);
        let length = span.length();
        let pull = ((length - limit.max_length) / (dt * weight)).max(-*impulse);
        if length > 0.0 && pull != 0.0 {
            *impulse += pull;
            pull_together(particles, limit.ends, span * (pull / length));
        }
    }
}
