//! The kernels of one step, in the order in which a step runs them.

mod close_seams;
mod collide;
mod euler;
mod hold_edges;
mod limit_average;
mod limit_directional;
mod limit_position;
mod limit_predictive;
mod limit_zero;
mod move_particles;
mod quad_midpoints;
mod quad_wind;
mod reaction;
mod sample_maps;
mod sample_sphere;
mod spring_forces;
mod wind_forces;

pub use close_seams::close_seams;
pub use collide::{Probes, collide};
pub use euler::euler;
pub use hold_edges::hold_edges;
pub use limit_average::limit_average;
pub use limit_directional::limit_directional;
pub use limit_position::limit_position;
pub use limit_predictive::limit_predictive;
pub use limit_zero::limit_zero;
pub use move_particles::move_particles;
pub use quad_midpoints::quad_midpoints;
pub use quad_wind::quad_wind;
pub use reaction::reaction;
pub use sample_maps::sample_maps;
pub use sample_sphere::sample_sphere;
pub use spring_forces::spring_forces;
pub use wind_forces::wind_forces;
