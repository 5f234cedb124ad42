//! An open seam is a limit that shrinks.

use super::pair::{after_move, inverse_mass_sum, pull_together};
use crate::Particles;
use toile_model::SeamPair;

/// Removes from the velocities of each pair what would leave its gap, after a move of `dt` [s], wider than the closing speed
/// allows. The pairs are those of one colour: no two share a particle.
pub fn close_seams(particles: &mut Particles, pairs: &[SeamPair], dt: f32) {
    for pair in pairs {
        let weight = inverse_mass_sum(particles, pair.ends);
        if !(weight > 0.0) {
            continue;
        }
        let [a, b] = pair.ends.map(|end| particles.positions[end as usize]);
        let target = ((b - a).length() - pair.closing_speed * dt).max(0.0);
        let span = after_move(particles, pair.ends, dt);
        let length = span.length();
        if length > target {
            pull_together(particles, pair.ends, span * ((length - target) / ((length * dt) * weight)));
        }
    }
}
