//! An open seam is drawn together before cloth and bodies answer.

use super::seam::close_pair;
use crate::Particles;
use toile_model::SeamPair;

/// Has the pairs of one colour, no two of which share a particle, come nearer at their closing speeds in a move of `dt` [s].
pub fn draw_seams(particles: &mut Particles, pairs: &[SeamPair], dt: f32) {
    for pair in pairs {
        close_pair(particles, pair, pair.closing_speed, dt);
    }
}
