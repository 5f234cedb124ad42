//! Each particle takes its share of the pressure on its quads.

use crate::particles::doubled_area;
use glam::Vec3;
use toile_model::{Csr, NO_CORNER};

/// Adds to each force [N] an equal share of what `pressure` [Pa] does to the area of each quad of the particle, out of the cloth: a quarter
/// of a quad's, a third of a triangle's, in the order of `particle_quads` (one row per particle). `positions` has the shape [particle_count].
pub fn pressure_forces(
    forces: &mut [Vec3],
    positions: &[Vec3],
    quads: &[[u32; 4]],
    particle_quads: &Csr<u32>,
    pressure: f32,
) {
    for (i, force) in forces.iter_mut().enumerate() {
        for &quad in particle_quads.row(i) {
            let corners = quads[quad as usize];
            // Of twice the area.
            let share = if corners[3] == NO_CORNER { 1.0 / 6.0 } else { 0.125 };
            *force += doubled_area(positions, corners) * (pressure * share);
        }
    }
}
