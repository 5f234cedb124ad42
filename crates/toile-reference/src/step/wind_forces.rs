//! Each particle takes its share of the wind on its quads.

use glam::Vec3;
use toile_model::{Csr, NO_CORNER};

/// Adds to each force [N] an equal share of the wind [N] on each quad of the particle: a quarter of a quad's, a third of a
/// triangle's, in the order of `particle_quads` (one row per particle). `quad_winds` has the shape [quad_count].
pub fn wind_forces(forces: &mut [Vec3], quad_winds: &[Vec3], quads: &[[u32; 4]], particle_quads: &Csr<u32>) {
    for (i, force) in forces.iter_mut().enumerate() {
        for &quad in particle_quads.row(i) {
            let share = if quads[quad as usize][3] == NO_CORNER { 1.0 / 3.0 } else { 0.25 };
            *force += quad_winds[quad as usize] * share;
        }
    }
}
