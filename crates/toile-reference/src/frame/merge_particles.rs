//! The handover: particles that were sewn together become one.

use crate::Particles;
use glam::Vec3;
use toile_model::Csr;

/// Gives each sewn particle the centre of mass [m] and the mean velocity by mass [m/s] of its members, so that momentum is
/// kept. `members` has one row per sewn particle, with indices of open particles; the masses of `sewn` are left alone.
pub fn merge_particles(open: &Particles, members: &Csr<u32>, sewn: &mut Particles) {
    for i in 0..sewn.positions.len() {
        let mut mass = 0.0;
        let mut position = Vec3::ZERO;
        let mut velocity = Vec3::ZERO;
        for &member in members.row(i) {
            let member = member as usize;
            mass += open.masses[member];
            position += open.positions[member] * open.masses[member];
            velocity += open.velocities[member] * open.masses[member];
        }
        sewn.positions[i] = position / mass;
        sewn.velocities[i] = velocity / mass;
    }
}
