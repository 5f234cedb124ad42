//! Limits that begin a step where they ended the last one.

use crate::support::{GRAVITY, Parts, THRESHOLD, changed, settings};
use glam::{Vec3, vec3};
use toile_model::{Hold, Model, Spring, SpringKind};
use toile_reference::{Colliders, Particles, Reference, step};
use toile_scene::Rule;

const DT: f32 = 1e-3;
const EDGE: f32 = 0.02;

/// A chain of particles that hangs on its first.
fn chain(count: u32) -> Model {
    let spring = |i| Spring {
        ends: [i, i + 1],
        rest_length: EDGE,
        stiffness: 0.0,
        threshold: THRESHOLD,
        kind: SpringKind::Structural,
    };
    Parts {
        positions: (0..count).map(|i| vec3(0.0, -EDGE * i as f32, 0.0)).collect(),
        masses: vec![1e-3; count as usize],
        pins: vec![0],
        springs: (0..count - 1).map(spring).collect(),
        quads: Vec::new(),
    }
    .model()
}

fn elongation_max(model: &Model, particles: &Particles) -> f32 {
    let length = |[a, b]: [u32; 2]| particles.positions[a as usize].distance(particles.positions[b as usize]);
    let elongations = model.limits.iter().map(|limit| length(limit.ends) / limit.rest_length - 1.0);
    elongations.inspect(|elongation| assert!(elongation.is_finite())).fold(0.0, f32::max)
}

/// Four seconds of the chain, one sweep per step. Gives the largest elongation of the last two and what its limits give the particles in a
/// step [m/s].
fn hung(model: &Model, remembers: bool) -> (f32, Vec<Vec3>) {
    let mut particles = Particles::new(model);
    let mut pulls = vec![Vec3::ZERO; model.positions.len()];
    let mut elongation = 0.0_f32;
    for index in 0..4000 {
        for (velocity, weight) in particles.velocities.iter_mut().zip(&particles.inverse_masses) {
            if *weight > 0.0 {
                *velocity = (*velocity - GRAVITY * DT * Vec3::Y) * (1.0 - 2.0 * DT);
            }
        }
        if remembers {
            step::warm_start(&mut particles, &mut pulls);
        }
        for colour in &model.limit_colours {
            let limits = &model.limits[colour.start as usize..colour.end as usize];
            step::limit_predictive(&mut particles, limits, &mut pulls, DT);
        }
        step::move_particles(&mut particles.positions, &particles.velocities, DT);
        if index >= 2000 {
            elongation = elongation.max(elongation_max(model, &particles));
        }
    }
    (elongation, pulls)
}

#[test]
fn tension_that_lasts_is_half_remembered() {
    let model = chain(24);
    let excess = |remembers| hung(&model, remembers).0 - THRESHOLD;
    let (warm, cold) = (excess(true), excess(false));
    assert!(cold > 0.01 && (warm / cold - 0.5).abs() < 0.05, "{warm} of {cold}");
    // Limits bear what each particle weighs.
    for pull in &hung(&model, true).1[1..] {
        assert!((pull.y / DT - GRAVITY).abs() < 0.05 * GRAVITY, "{pull}");
    }
}

#[test]
fn a_long_chain_does_not_swing_up() {
    // One sweep leaves almost all of what its slowest modes lack.
    let (elongation, _) = hung(&chain(64), true);
    assert!(elongation < hung(&chain(64), false).0, "{elongation}");
}

#[test]
fn a_step_begins_with_half_of_what_limits_gave() {
    let mut particles = Particles::new(&chain(2));
    particles.velocities[1] = vec3(1.0, 0.0, 0.5);
    let mut pulls = [Vec3::ZERO, vec3(0.0, 0.2, -1.0)];
    step::warm_start(&mut particles, &mut pulls);
    assert_eq!(pulls, [Vec3::ZERO, vec3(0.0, 0.1, -0.5)]);
    assert_eq!(particles.velocities, [Vec3::ZERO, vec3(1.0, 0.1, 0.0)]);
}

#[test]
fn edges_are_held_against_the_tension_that_is_carried() {
    // Limits draw an edge down after it was held. Half of their tension comes before and is held too; the other way round the edge hangs
    // 18 mm low.
    let count = 12;
    let model = changed(chain(count), |model| {
        model.inverse_masses.fill(1000.0);
        model.holds = vec![Hold { label: "waist".to_owned(), particles: 0..1, height: 0.0 }];
        model.held_particles = vec![0];
    });
    let mut settings = settings();
    settings.rule = Rule::Predictive;
    settings.sweeps = 3;
    settings.damping = 2.0;
    let mut reference = Reference::new(&model, &settings, Colliders::default());
    (0..1200).for_each(|_| reference.step());
    assert!((reference.positions()[0].y + 0.009).abs() < 1e-3, "{}", reference.positions()[0].y);
}
