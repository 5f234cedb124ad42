//! The status sees what went wrong.

use crate::support::{Grid, changed, settings};
use glam::Vec3;
use toile_model::PinTarget;
use toile_reference::frame::{particle_status, total_energy};
use toile_reference::{Colliders, Particles, Reference};

#[test]
fn a_single_broken_particle_is_counted_and_named() {
    for broken in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in 0..3 {
            let model = Grid::horizontal(9, 0.02).model();
            let mut particles = Particles::new(&model);
            assert_eq!(particle_status(&particles).non_finite_count, 0);
            particles.velocities[70][axis] = broken;
            particles.positions[37][axis] = broken;
            let status = particle_status(&particles);
            assert_eq!((status.non_finite_count, status.first_non_finite), (2, Some(37)));
        }
    }
}

#[test]
fn a_broken_particle_stays_in_sight_and_breaks_no_other() {
    let model = Grid::horizontal(9, 0.02).model();
    let mut reference = Reference::new(&model, &settings(), Colliders::default());
    // A model has numbers alone; what is held may be sent anywhere.
    reference.set_pins(&[PinTarget::held(40, Vec3::NAN, 1.0)]);
    for _ in 0..10 {
        reference.frame();
        let status = reference.status();
        assert_eq!((status.non_finite_count, status.first_non_finite), (1, Some(40)));
    }
}

#[test]
fn a_step_that_is_too_long_diverges_in_sight() {
    let model = changed(Grid::horizontal(9, 0.02).model(), |model| model.positions[40].y += 1e-3);
    // ω² = 2·Σk/m is at most 2·34/8e-5: stable below 2.2 ms, surely not at ten times that.
    let mut settings = settings();
    settings.dt = 0.022;
    let mut reference = Reference::new(&model, &settings, Colliders::default());
    for _ in 0..200 {
        reference.step();
    }
    let status = reference.status();
    assert!(status.non_finite_count > 0 && status.first_non_finite.is_some(), "{status:?}");
}

#[test]
fn energy_and_elongation_are_measured() {
    let model = Grid { pins: vec![0], ..Grid::horizontal(30, 0.01) }.model();
    let mut particles = Particles::new(&model);
    for (i, velocity) in particles.velocities.iter_mut().enumerate() {
        *velocity = Vec3::new(1.0, 0.0, 1e-3 * i as f32);
    }
    let expected: f64 = (1..900)
        .map(|i| 0.5 * f64::from(particles.masses[i]) * f64::from(particles.velocities[i].length_squared()))
        .sum();
    let status = particle_status(&particles);
    assert_eq!(status.energy_partials.len(), 15);
    assert!((f64::from(total_energy(&status.energy_partials)) - expected).abs() < 1e-6 * expected);
    assert!((status.speed_max - particles.velocities[899].length()).abs() < 1e-6);

    // The last particle of the first row is pulled out by 12 %: its row and one diagonal are over-long.
    let model = changed(model, |model| model.positions[29].x += 0.0012);
    let reference = Reference::new(&model, &settings(), Colliders::default());
    let status = reference.status();
    assert!((status.elongation_max - 0.12).abs() < 1e-4, "{status:?}");
    assert_eq!(status.over_long_count, 2);
    assert_eq!(status.kinetic_energy, 0.0);
}

#[test]
fn energy_is_summed_in_the_order_of_the_workgroup() {
    // 1 J is lost beside 1e8 J unless the two large partial sums, 64 apart, meet first.
    let mut partials = vec![0.0; 65];
    (partials[0], partials[1], partials[64]) = (1e8, 1.0, -1e8);
    assert_eq!(total_energy(&partials), 1.0);
}
