//! The numbers of a step, as the kernels read them.

use glam::DVec3;
use toile_kernels::structs::StepParams;
use toile_model::{Arrays, StepSettings};
use toile_scene::{Friction, Wind};

/// How many there are of what the kernels go over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counts {
    /// Particles.
    pub particles: u32,
    /// Quads and triangles.
    pub quads: u32,
    /// Limits of single springs.
    pub limits: u32,
}

impl Counts {
    /// Those of a model.
    pub fn of(model: &Arrays) -> Self {
        Self { particles: model.particle_count(), quads: model.quad_count(), limits: model.limits.len() as u32 }
    }
}

/// What the kernels read of the settings of a step; `after_maps` when shapes are sampled after maps.
pub fn step_params(counts: Counts, settings: &StepSettings, after_maps: bool) -> StepParams {
    let (friction_law, velocity_kept, force_removed) = match settings.law {
        Friction::Coulomb => (0, 0.0, 0.0),
        Friction::Papers { velocity_kept, force_removed } => (1, velocity_kept as f32, force_removed as f32),
    };
    let mut still = Wind::new(DVec3::ZERO);
    still.drag = 0.0;
    still.lift = 0.0;
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
        particle_count: counts.particles,
        quad_count: counts.quads,
        swept: u32::from(settings.swept),
        wind: wind.velocity.as_vec3(),
        drag: wind.drag as f32,
        lift: wind.lift as f32,
        pressure: wind.pressure as f32,
        thickness: settings.thickness,
        guard_way: settings.guard_way(),
        aim: settings.aim(),
        limit_count: counts.limits,
        after_maps: u32::from(after_maps),
    }
}
