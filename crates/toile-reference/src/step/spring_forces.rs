//! Forces of springs, gravity and viscous damping. D §3, eq. 2.

use crate::Particles;
use glam::Vec3;
use toile_model::{Csr, Link, StepSettings};

/// Force on each particle [N], shape [particle_count]: its springs in the order of `links` (one row per particle), gravity
/// and viscous damping. D §3, eq. 2.
pub fn spring_forces(particles: &Particles, links: &Csr<Link>, settings: &StepSettings) -> Vec<Vec3> {
    (0..particles.positions.len())
        .map(|i| {
            let position = particles.positions[i];
            let mass = particles.masses[i];
            let mut force = settings.gravity * mass;
            force -= particles.velocities[i] * (settings.damping * mass);
            for link in links.row(i) {
                let span = particles.positions[link.other as usize] - position;
                let length = span.length();
                if length > 0.0 {
                    force += span * ((link.stiffness * (length - link.rest_length)) / length);
                }
            }
            force
        })
        .collect()
}
