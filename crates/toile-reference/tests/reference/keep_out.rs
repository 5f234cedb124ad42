//! Where the guard ends: a body, at the depth of the cloth's thickness.

use crate::support::{Grid, settings, with};
use glam::Vec3;
use toile_reference::{Particles, Probe, step};

/// Thickness of the cloth [m].
const THICKNESS: f32 = 1e-3;

/// Velocity of a particle that came with `velocity` to a surface, with the kernel.
fn kept_out(velocity: Vec3, inverse_mass: f32, probe: Probe) -> Vec3 {
    let model = Grid { columns: 1, rows: 1, ..Grid::horizontal(1, 1.0) }.model();
    let mut particles = Particles::new(&model);
    particles.velocities[0] = velocity;
    particles.inverse_masses[0] = inverse_mass;
    step::keep_out(
        &mut particles,
        &[probe],
        &with(settings(), |step| {
            step.dt = 0.01;
            step.thickness = THICKNESS;
        }),
    );
    particles.velocities[0]
}

#[test]
fn a_particle_ends_a_step_no_deeper_than_the_thickness_or_than_it_was() {
    let surface = Vec3::new(0.0, 0.3, 0.1);
    let slide = 0.7 * Vec3::X;
    // Ways of a step along the normal and distances before and after it, all in thicknesses.
    for (before, way, after) in [
        (0.5, -5.0, -1.0),
        (0.0, -5.0, -1.0),
        (-0.5, -5.0, -1.0),
        (0.0, -0.9, -0.9),
        (0.0, 5.0, 5.0),
        (-3.0, -2.0, -3.0),
        (-3.0, 1.0, -2.0),
    ] {
        let probe = Probe { hit: true, distance: before * THICKNESS, normal: Vec3::Y, velocity: surface };
        let velocity = kept_out(surface + slide + way * THICKNESS / 0.01 * Vec3::Y, 1.0, probe);
        let moved = before * THICKNESS + (velocity - surface).y * 0.01;
        assert!((moved - after * THICKNESS).abs() < 1e-7, "{before} and {way} end at {}", moved / THICKNESS);
        let along = velocity - surface - slide;
        assert!(along.x == 0.0 && along.z == 0.0, "it slides as before: {velocity}");
    }
}

#[test]
fn a_pin_and_a_particle_that_meets_no_body_go_as_they_went() {
    let surface = Probe { hit: true, distance: 0.0, normal: Vec3::Y, velocity: Vec3::ZERO };
    let fast = -9.0 * Vec3::Y;
    assert_ne!(kept_out(fast, 1.0, surface), fast);
    assert_eq!(kept_out(fast, 0.0, surface), fast);
    assert_eq!(kept_out(fast, 1.0, Probe { hit: false, ..surface }), fast);
}
