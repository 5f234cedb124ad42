//! Limits of all levels in a sweep.

use crate::support::changed;
use glam::{DVec2, DVec3, Vec3};
use toile_model::{Csr, Model, StepSettings};
use toile_reference::{Particles, limits};
use toile_scene::{Fabric, Pin, Rule, Settings, Sheet, VelocityModification};

/// A sheet of 33 × 33 particles whose lower half flies off, and its settings.
fn torn(pins: Vec<Pin>) -> (Model, StepSettings, Particles) {
    let mut settings = Settings::new(Fabric::preset("cotton").expect("cotton is a preset"));
    settings.velocity_modification = VelocityModification::new(Rule::Hierarchical);
    let mut sheet = Sheet::new("sheet", [33, 33], DVec2::splat(0.32));
    sheet.down = DVec3::NEG_Y;
    sheet.pins = pins;
    let model = Model::from_sheet(&sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    let mut particles = Particles::new(&model);
    for (i, velocity) in particles.velocities.iter_mut().enumerate() {
        if i / 33 > 16 && model.inverse_masses[i] > 0.0 {
            *velocity = Vec3::new(3.0, -30.0, 1.0);
        }
    }
    (model, step, particles)
}

/// Largest elongation after the coming move.
fn stretch(model: &Model, particles: &Particles, dt: f32) -> f32 {
    let after = |i: u32| particles.positions[i as usize] + particles.velocities[i as usize] * dt;
    let stretch =
        |limit: &toile_model::Limit| after(limit.ends[0]).distance(after(limit.ends[1])) / limit.rest_length - 1.0;
    model.limits.iter().map(stretch).fold(0.0, f32::max)
}

#[test]
fn a_sweep_keeps_momentum_and_reaches_over_the_whole_sheet() {
    let (model, step, mut particles) = torn(Vec::new());
    let momentum = |particles: &Particles| -> DVec3 {
        particles.velocities.iter().zip(&model.masses).map(|(v, mass)| v.as_dvec3() * f64::from(*mass)).sum()
    };
    let before = momentum(&particles);
    let mut pulls = vec![Vec3::ZERO; model.positions.len()];
    limits::sweep(&mut particles, &model, &step, None, &mut pulls);
    let lost = (momentum(&particles) - before).length();
    assert!(lost < 1e-6 * before.length(), "{lost} of {before}");
    assert!(particles.velocities[16].y < -1e-3, "the far edge is drawn along: {}", particles.velocities[16]);
    let left = stretch(&model, &particles, step.dt);
    let (model, step, mut particles) = torn(Vec::new());
    let leaders = Csr::from_rows(model.positions.iter().map(|_| []));
    let single = changed(model, |model| {
        model.levels.truncate(1);
        model.clusters.truncate(model.guard_lengths.len());
        model.coarse_particles.clear();
        model.leaders = leaders;
    });
    limits::sweep(&mut particles, &single, &step, None, &mut vec![Vec3::ZERO; single.positions.len()]);
    assert!(particles.velocities[16].y > -1e-3, "single springs do not reach it");
    let alone = stretch(&single, &particles, step.dt);
    assert!(left < 0.7 * alone, "{left}, and {alone} with single springs alone");
}

#[test]
fn pins_stay() {
    let pins = (0..33).map(|column| Pin { column, row: 0 }).chain([Pin { column: 9, row: 21 }]).collect();
    let (model, step, mut particles) = torn(pins);
    let mut pulls = vec![Vec3::ZERO; model.positions.len()];
    limits::sweep(&mut particles, &model, &step, None, &mut pulls);
    let pinned = |i: &usize| model.inverse_masses[*i] == 0.0;
    assert_eq!((0..33 * 33).filter(pinned).count(), 34);
    assert!((0..33 * 33).filter(pinned).all(|i| particles.velocities[i] == Vec3::ZERO));
}

#[test]
fn cloth_within_its_limits_is_left_as_it_is() {
    let (model, step, mut particles) = torn(Vec::new());
    particles.velocities.fill(Vec3::new(0.1, 0.2, 0.3));
    particles.positions.iter_mut().for_each(|place| *place *= 0.9);
    limits::sweep(&mut particles, &model, &step, None, &mut vec![Vec3::ZERO; model.positions.len()]);
    assert!(particles.velocities.iter().all(|velocity| *velocity == Vec3::new(0.1, 0.2, 0.3)));
}
