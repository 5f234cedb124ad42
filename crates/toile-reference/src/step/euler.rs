//! Forces become velocities. W §2.2, eq. 3.

use glam::Vec3;

/// Adds to each velocity [m/s] what its force [N] gives in the time `dt` [s]: v += f·(dt·w). All arrays have the shape
/// [particle_count]. W §2.2, eq. 3.
pub fn euler(velocities: &mut [Vec3], forces: &[Vec3], inverse_masses: &[f32], dt: f32) {
    for ((velocity, force), inverse_mass) in velocities.iter_mut().zip(forces).zip(inverse_masses) {
        *velocity += *force * (dt * inverse_mass);
    }
}
