//! Normals to draw the cloth with.

use crate::particles::doubled_area;
use glam::Vec3;
use toile_model::Csr;

/// Unit normal of each particle on the outside of the cloth, shape [particle_count]: its quads weighted by their area, in the
/// order of `particle_quads` (one row per particle). A particle without area gets +y, so that no normal is non-finite.
pub fn particle_normals(positions: &[Vec3], quads: &[[u32; 4]], particle_quads: &Csr<u32>) -> Vec<Vec3> {
    (0..positions.len())
        .map(|i| {
            let mut sum = Vec3::ZERO;
            for &quad in particle_quads.row(i) {
                sum += doubled_area(positions, quads[quad as usize]);
            }
            let length = sum.length();
            if length > 0.0 { sum / length } else { Vec3::Y }
        })
        .collect()
}
