//! The particles go where limits have shifted them.

use crate::{Nodes, Particles};
use glam::Vec3;

/// Changes the velocities so that a move of `dt` [s] takes each particle as much farther as its node has been shifted, and adds the change to `pulls`
/// [m/s], shape [particle_count].
pub fn shift_velocities(particles: &mut Particles, nodes: &Nodes, pulls: &mut [Vec3], dt: f32) {
    for ((velocity, pull), shift) in particles.velocities.iter_mut().zip(pulls).zip(&nodes.shifts) {
        let change = *shift / dt;
        *velocity += change;
        *pull += change;
    }
}
