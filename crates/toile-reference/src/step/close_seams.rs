//! An open seam closes slowly, whatever cloth and bodies answered.

use super::seam::close_pair;
use crate::Particles;
use toile_model::SeamPair;

/// Speed at which a seam closes whatever holds it open [m/s].
const FIRM_SPEED: f32 = 0.3;

/// Has the pairs of one colour, no two of which share a particle, come nearer at a low speed in a move of `dt` [s].
pub fn close_seams(particles: &mut Particles, pairs: &[SeamPair], dt: f32) {
    for pair in pairs {
        close_pair(particles, pair, pair.closing_speed.min(FIRM_SPEED), dt);
    }
}
