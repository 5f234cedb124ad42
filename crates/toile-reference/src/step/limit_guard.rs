//! The last word on single springs.

use super::pair::{after_move, inverse_mass_sum, pull_together};
use crate::Particles;
use toile_model::Limit;

/// Removes from the velocities of both ends, by inverse mass, what would leave a limit stretched more than twice as far as it may be after
/// a move of `dt` [s]. The limits are those of one colour: no two share a particle.
pub fn limit_guard(particles: &mut Particles, limits: &[Limit], dt: f32) {
    for limit in limits {
        let weight = inverse_mass_sum(particles, limit.ends);
        if !(weight > 0.0) {
            continue;
        }
        let span = after_move(particles, limit.ends, dt);
        let length = span.length();
        let guard_length = 2.0 * limit.max_length - limit.rest_length;
        if length > guard_length {
            let pull = (length - guard_length) / (dt * weight);
            pull_together(particles, limit.ends, span * (pull / length));
        }
    }
}
