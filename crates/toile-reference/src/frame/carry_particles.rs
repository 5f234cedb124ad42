//! The cloth goes along with a body that is set elsewhere at once.

use crate::{Contact, Particles};
use glam::{Vec3, Vec4};

/// Carries every particle, pinned ones too, by the first three rows of a rigid transform: places [m] go by all of it, velocities [m/s] and
/// what was touched by its rotation. `contacts` has the shape [particle_count], or none without a body.
pub fn carry_particles(particles: &mut Particles, contacts: &mut [Contact], rows: [Vec4; 3]) {
    let turned = |v: Vec3| Vec3::from_array(rows.map(|row| row.truncate().dot(v)));
    let way = Vec3::from_array(rows.map(|row| row.w));
    for position in &mut particles.positions {
        *position = turned(*position) + way;
    }
    for velocity in &mut particles.velocities {
        *velocity = turned(*velocity);
    }
    for contact in contacts {
        contact.normal = turned(contact.normal);
        contact.velocity = turned(contact.velocity);
    }
}
