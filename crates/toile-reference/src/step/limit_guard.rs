//! The last word on single springs.

use super::pair::{after_move, inverse_mass_sum, pull_together};
use crate::Particles;
use toile_model::{Limit, StepSettings};

/// Removes from the velocities of both ends, by inverse mass, what would leave a limit stretched more than twice as far as it may be after
/// the coming move; of a great excess only so much that nothing is flung into a body that it was not near. `share` is the part of it that is
/// removed [1]. The limits are those of one colour: no two share a particle.
pub fn limit_guard(particles: &mut Particles, limits: &[Limit], share: f32, settings: &StepSettings) {
    for limit in limits {
        let weight = inverse_mass_sum(particles, limit.ends);
        if !(weight > 0.0) {
            continue;
        }
        let span = after_move(particles, limit.ends, settings.dt);
        let length = span.length();
        let guard_length = 2.0 * limit.max_length - limit.rest_length;
        if length > guard_length {
            let excess = share * (length - guard_length).min(settings.guard_way());
            let pull = excess / (settings.dt * weight);
            pull_together(particles, limit.ends, span * (pull / length));
        }
    }
}
