//! The kernels that run once per frame, and those of the handover.

mod carry_particles;
mod limit_status;
mod longest_limit;
mod merge_particles;
mod particle_normals;
mod particle_status;
mod reduction;
mod seam_status;
mod set_pins;
mod state_copy;
mod total_energy;

pub use carry_particles::carry_particles;
pub use limit_status::{LimitStatus, limit_status};
pub use longest_limit::longest_limit;
pub use merge_particles::merge_particles;
pub use particle_normals::particle_normals;
pub use particle_status::{ParticleStatus, particle_status};
pub(crate) use reduction::{GROUP, tree_sum};
pub use seam_status::seam_status;
pub use set_pins::set_pins;
pub use state_copy::state_copy;
pub use total_energy::total_energy;
