//! An open seam is a limit that shrinks.

use super::pair::{after_move, inverse_mass_sum, pull_together};
use crate::Particles;
use toile_model::SeamPair;

/// A pair that is nearer is shut [m]: the square of much less is a denormal number, which not every driver keeps.
const SHUT: f32 = 1e-12;

/// Removes from the velocities of a pair what would leave its gap, after a move of `dt` [s], wider than a speed [m/s] allows.
pub(super) fn close_pair(particles: &mut Particles, pair: &SeamPair, speed: f32, dt: f32) {
    let weight = inverse_mass_sum(particles, pair.ends);
    if !(weight > 0.0) {
        return;
    }
    let [a, b] = pair.ends.map(|end| particles.positions[end as usize]);
    let target = ((b - a).length() - speed * dt).max(SHUT);
    let span = after_move(particles, pair.ends, dt);
    let length = span.length();
    if length > target {
        pull_together(particles, pair.ends, span * ((length - target) / ((length * dt) * weight)));
    }
}
