//! The point of a quad that is tested against the body. D §6.

use crate::Midpoints;
use glam::Vec3;
use toile_model::NO_CORNER;

/// Mean position [m] and velocity [m/s] of the corners of each quad or triangle. `positions` and `velocities` have the shape
/// [particle_count]. D §6.
pub fn quad_midpoints(positions: &[Vec3], velocities: &[Vec3], quads: &[[u32; 4]]) -> Midpoints {
    Midpoints {
        positions: quads.iter().map(|quad| mean(positions, quad)).collect(),
        velocities: quads.iter().map(|quad| mean(velocities, quad)).collect(),
    }
}

fn mean(values: &[Vec3], &[a, b, c, d]: &[u32; 4]) -> Vec3 {
    let three = (values[a as usize] + values[b as usize]) + values[c as usize];
    if d == NO_CORNER { three * (1.0 / 3.0) } else { (three + values[d as usize]) * 0.25 }
}
