//! Coarse particles take their places and follow those of the next coarser level.

use crate::{Coarse, Particles};
use glam::Vec3;
use std::ops::Range;
use toile_model::{Leader, Model};

/// Puts the coarse particles of a level where the cloth would be after a move of `dt` [s], and shifts them as much as those that lead them.
pub fn lead_coarse(coarse: &mut Coarse, level: &Range<u32>, particles: &Particles, model: &Model, dt: f32) {
    for i in level.clone() {
        let row = model.leaders.row((model.particle_count() + i) as usize);
        let i = i as usize;
        let site = model.coarse_particles[i].site as usize;
        coarse.places[i] = particles.positions[site] + particles.velocities[site] * dt;
        coarse.shifts[i] = led(&coarse.shifts, row);
    }
}

/// What a row of leaders moves a particle by [m].
pub(super) fn led(shifts: &[Vec3], leaders: &[Leader]) -> Vec3 {
    leaders.iter().fold(Vec3::ZERO, |sum, leader| sum + shifts[leader.coarse as usize] * leader.part)
}
