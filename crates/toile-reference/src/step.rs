//! The kernels of one step, in the order in which a step runs them.

mod close_seams;
mod cluster;
mod collide;
mod draw_seams;
mod euler;
mod grant_sweep;
mod hold_edges;
mod keep_out;
mod layer_planes;
mod lead_level;
mod limit_attachments;
mod limit_average;
mod limit_directional;
mod limit_guard;
mod limit_level;
mod limit_position;
mod limit_predictive;
mod limit_small_levels;
mod limit_zero;
mod measure_excess;
mod move_particles;
mod pair;
mod pressure_forces;
mod quad_midpoints;
mod quad_wind;
mod reaction;
mod sample_layers;
mod sample_moving_layers;
mod sample_moving_sides;
mod sample_shapes;
mod sample_sides;
mod seam;
mod shift_velocities;
mod side_planes;
mod spring_forces;
mod warm_start;
mod wind_forces;

pub use close_seams::close_seams;
pub use collide::{Probes, collide};
pub use draw_seams::draw_seams;
pub use euler::euler;
pub use grant_sweep::{PolishState, grant_sweep};
pub use hold_edges::hold_edges;
pub use keep_out::keep_out;
pub use lead_level::lead_level;
pub use limit_attachments::limit_attachments;
pub use limit_average::limit_average;
pub use limit_directional::limit_directional;
pub use limit_guard::limit_guard;
pub use limit_level::limit_level;
pub use limit_position::limit_position;
pub use limit_predictive::limit_predictive;
pub use limit_small_levels::limit_small_levels;
pub use limit_zero::limit_zero;
pub use measure_excess::measure_excess;
pub use move_particles::move_particles;
pub use pressure_forces::pressure_forces;
pub use quad_midpoints::quad_midpoints;
pub use quad_wind::quad_wind;
pub use reaction::reaction;
pub use sample_layers::sample_layers;
pub use sample_moving_layers::sample_moving_layers;
pub use sample_moving_sides::sample_moving_sides;
pub use sample_shapes::sample_shapes;
pub use sample_sides::sample_sides;
pub use shift_velocities::shift_velocities;
pub use spring_forces::spring_forces;
pub use warm_start::warm_start;
pub use wind_forces::wind_forces;

use crate::maps::BodyMaps;
use crate::{Lag, Particles, Probe};
use glam::Vec3;
use toile_model::{Arrays, StepSettings};

/// The surface that each point meets in the coming move, or none, whatever the maps. All arrays have the shape [point_count].
pub fn sample_body_maps(
    positions: &[Vec3],
    velocities: &[Vec3],
    maps: &BodyMaps,
    lag: Lag,
    settings: &StepSettings,
) -> Vec<Probe> {
    match maps {
        BodyMaps::Sides(sides) if maps.is_moving() => sample_moving_sides(positions, velocities, sides, lag, settings),
        BodyMaps::Sides(sides) => sample_sides(positions, velocities, sides, settings),
        BodyMaps::Layers(layers) if maps.is_moving() => {
            sample_moving_layers(positions, velocities, layers, lag, settings)
        }
        BodyMaps::Layers(layers) => sample_layers(positions, velocities, layers, settings),
    }
}

/// Force on each particle [N] before the bodies answer, shape [particle_count]: that of the springs, and on it what the scene has.
pub fn forces(particles: &Particles, model: &Arrays, settings: &StepSettings) -> Vec<Vec3> {
    let mut forces = spring_forces(particles, &model.links, settings);
    if let Some(wind) = &settings.wind {
        let winds = quad_wind(particles, &model.quads, &model.particle_quads, wind, settings.dt);
        wind_forces(&mut forces, &winds, &model.quads, &model.particle_quads);
        if wind.pressure != 0.0 {
            let (quads, particle_quads) = (&model.quads, &model.particle_quads);
            pressure_forces(&mut forces, &particles.positions, quads, particle_quads, wind.pressure as f32);
        }
    }
    forces
}
