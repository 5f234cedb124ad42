//! An open seam is a limit that shrinks.

use super::pair::{after_move, inverse_mass_sum, pull_together};
use crate::Particles;
use toile_model::SeamPair;

/// Speed at which a seam closes whatever holds it open [m/s].
const FIRM_SPEED: f32 = 0.3;

/// Has the pairs of one colour, no two of which share a particle, come nearer at their closing speeds in a move of `dt` [s]. Cloth and
/// bodies answer later in the sweep.
pub fn draw_seams(particles: &mut Particles, pairs: &[SeamPair], dt: f32) {
    for pair in pairs {
        close(particles, pair, pair.closing_speed, dt);
    }
}

/// Has the pairs of one colour come nearer at a low speed, whatever cloth and bodies answered.
pub fn close_seams(particles: &mut Particles, pairs: &[SeamPair], dt: f32) {
    for pair in pairs {
        close(particles, pair, pair.closing_speed.min(FIRM_SPEED), dt);
    }
}

/// Removes from the velocities of a pair what would leave its gap, after a move of `dt` [s], wider than a speed [m/s] allows.
fn close(particles: &mut Particles, pair: &SeamPair, speed: f32, dt: f32) {
    let weight = inverse_mass_sum(particles, pair.ends);
    if !(weight > 0.0) {
        return;
    }
    let [a, b] = pair.ends.map(|end| particles.positions[end as usize]);
    let target = ((b - a).length() - speed * dt).max(0.0);
    let span = after_move(particles, pair.ends, dt);
    let length = span.length();
    if length > target {
        pull_together(particles, pair.ends, span * ((length - target) / ((length * dt) * weight)));
    }
}
