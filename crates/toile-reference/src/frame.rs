//! The kernels that run once per frame, and those of the handover.

mod limit_status;
mod longest_limit;
mod merge_particles;
mod particle_normals;
mod particle_status;
mod seam_status;
mod state_copy;
mod total_energy;

pub use limit_status::{LimitStatus, limit_status};
pub use longest_limit::longest_limit;
pub use merge_particles::merge_particles;
pub use particle_normals::particle_normals;
pub use particle_status::{ParticleStatus, particle_status};
pub use seam_status::seam_status;
pub use state_copy::state_copy;
pub use total_energy::total_energy;

/// Particles whose energies are summed together: the workgroup of the GPU's reduction. The order of a sum is part of it.
pub(crate) const GROUP: usize = 64;

/// Sum of a group, by halves.
pub(crate) fn tree_sum(mut values: [f32; GROUP]) -> f32 {
    let mut stride = GROUP / 2;
    while stride > 0 {
        for i in 0..stride {
            values[i] += values[i + stride];
        }
        stride /= 2;
    }
    values[0]
}
