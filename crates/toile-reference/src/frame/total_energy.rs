//! Sum of the energies of all groups.

use super::reduction::{GROUP, tree_sum};

/// Total kinetic energy [J] from the partial sums of [`particle_status`](super::particle_status).
pub fn total_energy(partials: &[f32]) -> f32 {
    let mut sums = [0.0; GROUP];
    for (i, partial) in partials.iter().enumerate() {
        sums[i % GROUP] += partial;
    }
    tree_sum(sums)
}
