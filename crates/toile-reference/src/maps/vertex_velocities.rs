//! How fast the vertices of a surface move. W §4.3.

use glam::Vec3;

/// Velocities [m/s], shape [vertex_count], from where the vertices were and where they are [m]; `rate` is one over the time in
/// between [1/s], 0 when there was none.
pub fn vertex_velocities(last: &[Vec3], positions: &[Vec3], rate: f32) -> Vec<Vec3> {
    last.iter().zip(positions).map(|(&last, &now)| (now - last) * rate).collect()
}
