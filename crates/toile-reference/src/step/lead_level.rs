//! The nodes of a level take their places and follow those of the next coarser level.

use crate::{Nodes, Particles};
use glam::Vec3;
use std::ops::Range;
use toile_model::Arrays;

/// Puts the nodes of a level where the cloth would be after a move of `dt` [s], and shifts them as much as those that lead them. Gives nothing
/// for nodes of other levels.
pub fn lead_level(nodes: &mut Nodes, level: &Range<u32>, particles: &Particles, model: &Arrays, dt: f32) {
    for node in level.clone().map(|node| node as usize) {
        let coarse = node.checked_sub(model.positions.len());
        let site = coarse.map_or(node, |coarse| model.coarse_particles[coarse].site as usize);
        nodes.places[node] = particles.positions[site] + particles.velocities[site] * dt;
        let is_pinned = particles.inverse_masses[site] == 0.0;
        nodes.inverse_masses[node] = match coarse {
            Some(coarse) if !is_pinned => model.coarse_particles[coarse].inverse_mass,
            _ => particles.inverse_masses[site],
        };
        // A particle that is pinned, or a coarse particle where one is, follows nobody.
        let leaders = if is_pinned { &[] } else { model.leaders.row(node) };
        nodes.shifts[node] =
            leaders.iter().fold(Vec3::ZERO, |sum, leader| sum + nodes.shifts[leader.node as usize] * leader.part);
    }
}
