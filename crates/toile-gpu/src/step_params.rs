//! The numbers of a step, as the kernels read them.

use glam::DVec3;
use toile_kernels::structs::StepParams;
use toile_model::{Model, StepSettings};
use toile_scene::{Friction, Wind};

/// What the kernels read of a model and the settings of its step; `after_maps` when shapes are sampled after maps.
pub fn step_params(model: &Model, settings: &StepSettings, after_maps: bool) -> StepParams {
    let (friction_law, velocity_kept, force_removed) = match settings.law {
        Friction::Coulomb => (0, 0.0, 0.0),
        Friction::Papers { velocity_kept, force_removed } => (1, velocity_kept as f32, force_removed as f32),
    };
    let still = Wind { drag: 0.0, lift: 0.0, ..Wind::new(DVec3::ZERO) };
    let wind = settings.wind.unwrap_or(still);
    StepParams {
        gravity: settings.gravity,
        dt: settings.dt,
        damping: settings.damping,
        push_speed: settings.push_speed_per_sweep(),
        pressing_speed: settings.pressing_speed_per_sweep(),
        contact_margin: settings.contact_margin,
        reflection: settings.reflection,
        friction_law,
        friction: settings.friction,
        velocity_kept,
        force_removed,
        hold_rate: settings.hold_rate,
        hold_speed: settings.hold_speed,
        particle_count: model.particle_count(),
        quad_count: model.quad_count(),
        swept: u32::from(settings.swept),
        wind: wind.velocity.as_vec3(),
        drag: wind.drag as f32,
        lift: wind.lift as f32,
        pressure: wind.pressure as f32,
        thickness: settings.thickness,
        guard_way: settings.guard_way(),
        aim: settings.aim(),
        limit_count: model.limits.len() as u32,
        after_maps: u32::from(after_maps),
    }
}
