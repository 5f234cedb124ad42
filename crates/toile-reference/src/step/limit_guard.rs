//! The last word on single springs.

use super::cluster::each_pair;
use super::pair::{after_move, inverse_mass_sum, pull_together};
use crate::Particles;
use std::ops::Range;
use toile_model::{Arrays, StepSettings};

/// Removes from the velocities of both ends, by inverse mass, what would leave a limit stretched more than twice as far as it may be after
/// the coming move; of a great excess only so much that nothing is flung into a body that it was not near. `share` is the part of it that is removed [1]. The clusters are those of one colour
/// of the cloth itself: no two share a particle.
pub fn limit_guard(
    particles: &mut Particles,
    model: &Arrays,
    clusters: &Range<u32>,
    share: f32,
    settings: &StepSettings,
) {
    each_pair(&model.clusters, clusters, |ends, cluster, place| {
        let guard_length = model.guard_lengths[cluster][place];
        let weight = inverse_mass_sum(particles, ends);
        let span = after_move(particles, ends, settings.dt);
        let length = span.length();
        if length > guard_length && weight > 0.0 {
            let excess = share * (length - guard_length).min(settings.guard_way());
            let pull = excess / (settings.dt * weight);
            pull_together(particles, ends, span * (pull / length));
        }
    });
}
