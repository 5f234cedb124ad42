//! Limits that begin a step where they ended the last one.

use crate::support::{GRAVITY, Parts, THRESHOLD, settings};
use glam::{Vec3, vec3};
use toile_model::{Hold, Model, Spring, SpringKind, StepSettings};
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

/// Four seconds of the chain, one sweep per step. Gives the largest elongation of the last two and what its limits pull with.
fn hung(model: &Model, remembers: bool) -> (f32, Vec<f32>) {
    let mut particles = Particles::new(model);
    let mut impulses = vec![0.0; model.limits.len()];
    let mut elongation = 0.0_f32;
    for index in 0..4000 {
        for (velocity, weight) in particles.velocities.iter_mut().zip(&particles.inverse_masses) {
            if *weight > 0.0 {
                *velocity = (*velocity - GRAVITY * DT * Vec3::Y) * (1.0 - 2.0 * DT);
            }
        }
        let colours = || model.limit_colours.iter().map(|colour| colour.start as usize..colour.end as usize);
        if remembers {
            for colour in colours() {
                step::warm_start(&mut particles, &model.limits[colour.clone()], &mut impulses[colour]);
            }
        } else {
            impulses.fill(0.0);
        }
        for colour in colours() {
            step::limit_predictive(&mut particles, &model.limits[colour.clone()], &mut impulses[colour], DT);
        }
        step::move_particles(&mut particles.positions, &particles.velocities, DT);
        if index >= 2000 {
            elongation = elongation.max(elongation_max(model, &particles));
        }
    }
    (elongation, impulses)
}

#[test]
fn tension_that_lasts_is_half_remembered() {
    let model = chain(24);
    let excess = |remembers| hung(&model, remembers).0 - THRESHOLD;
    let (warm, cold) = (excess(true), excess(false));
    assert!(cold > 0.01 && (warm / cold - 0.5).abs() < 0.05, "{warm} of {cold}");
    // Each limit bears what hangs below it.
    for (limit, impulse) in model.limits.iter().zip(hung(&model, true).1) {
        let weight = 1e-3 * GRAVITY * (23 - limit.ends[0]) as f32;
        assert!((impulse / DT - weight).abs() < 0.05 * weight, "{:?}: {} N of {weight} N", limit.ends, impulse / DT);
    }
}

#[test]
fn a_long_chain_does_not_swing_up() {
    // One sweep leaves almost all of what its slowest modes lack.
    let (elongation, _) = hung(&chain(64), true);
    assert!(elongation < hung(&chain(64), false).0, "{elongation}");
}

#[test]
fn a_limit_takes_back_what_it_no_longer_needs() {
    let model = chain(2);
    let mut particles = Particles { inverse_masses: vec![1000.0, 500.0], ..Particles::new(&model) };
    let mut impulses = [1e-5];
    step::warm_start(&mut particles, &model.limits, &mut impulses);
    assert_eq!(impulses, [5e-6]);
    assert!((particles.velocities[0].y + 5e-3).abs() < 1e-7 && (particles.velocities[1].y - 2.5e-3).abs() < 1e-7);
    step::limit_predictive(&mut particles, &model.limits, &mut impulses, DT);
    assert!(particles.velocities.iter().all(|velocity| velocity.length() < 1e-8), "{:?}", particles.velocities);
    assert_eq!(impulses, [0.0]);
    // Once nothing is left, it does not push.
    let shortened = particles.clone();
    step::limit_predictive(&mut particles, &model.limits, &mut impulses, DT);
    assert_eq!(particles, shortened);
}

#[test]
fn a_limit_without_direction_forgets() {
    let model = chain(2);
    let mut particles = Particles::new(&model);
    particles.positions[1] = particles.positions[0];
    let before = particles.clone();
    let mut impulses = [1e-5];
    step::warm_start(&mut particles, &model.limits, &mut impulses);
    assert_eq!(particles, before);
    assert_eq!(impulses, [0.0]);
}

#[test]
fn edges_are_held_against_the_tension_that_is_carried() {
    // Limits draw an edge down after it was held. Half of their tension comes before and is held too; the other way round the edge hangs
    // 18 mm low.
    let count = 12;
    let mut model = Model { inverse_masses: vec![1000.0; count as usize], ..chain(count) };
    model.holds = vec![Hold { label: "waist".to_owned(), particles: 0..1, height: 0.0 }];
    model.held_particles = vec![0];
    let settings = StepSettings { rule: Rule::Predictive, sweeps: 3, damping: 2.0, ..settings() };
    let mut reference = Reference::new(&model, &settings, Colliders::default());
    (0..1200).for_each(|_| reference.step());
    assert!((reference.positions()[0].y + 0.009).abs() < 1e-3, "{}", reference.positions()[0].y);
}
