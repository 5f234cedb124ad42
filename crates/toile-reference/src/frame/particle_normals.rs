//! Normals to draw the cloth with.

use glam::Vec3;
use toile_model::{Csr, NO_CORNER};

/// Unit normal of each particle on the outside of the cloth, shape [particle_count]: its quads weighted by their area, in the
/// order of `particle_quads` (one row per particle). A particle without area gets +y, so that no normal is non-finite.
pub fn particle_normals(positions: &[Vec3], quads: &[[u32; 4]], particle_quads: &Csr<u32>) -> Vec<Vec3> {
    (0..positions.len())
        .map(|i| {
            let mut sum = Vec3::ZERO;
            for &quad in particle_quads.row(i) {
                sum += area(positions, quads[quad as usize]);
            }
            let length = sum.length();
            if length > 0.0 { sum / length } else { Vec3::Y }
        })
        .collect()
}

/// Twice the area vector of a quad or triangle [m²].
fn area(positions: &[Vec3], [a, b, c, d]: [u32; 4]) -> Vec3 {
    let corner = |index: u32| positions[index as usize];
    if d == NO_CORNER {
        (corner(b) - corner(a)).cross(corner(c) - corner(a))
    } else {
        (corner(c) - corner(a)).cross(corner(d) - corner(b))
    }
}
