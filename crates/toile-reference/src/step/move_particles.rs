//! Velocities become positions. W §2.2, eq. 3.

use glam::Vec3;

/// Moves each position [m] by its velocity [m/s] for the time `dt` [s]. Both arrays have the shape [particle_count].
/// W §2.2, eq. 3.
pub fn move_particles(positions: &mut [Vec3], velocities: &[Vec3], dt: f32) {
    for (position, velocity) in positions.iter_mut().zip(velocities) {
        *position += *velocity * dt;
    }
}
