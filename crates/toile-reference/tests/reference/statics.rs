//! Cloth at rest: pins and the hanging strip.

use crate::support::{GRAVITY, Grid, changed, settings};
use glam::{DVec3, Vec3};
use toile_model::Model;
use toile_reference::{Colliders, Reference};
use toile_scene::{Rule, Shape};

#[test]
fn pinned_particles_stay_where_they_are() {
    let sphere = Shape::sphere(DVec3::new(0.0, -0.05, 0.0), 0.06);
    for rule in [Rule::None, Rule::Predictive, Rule::Position] {
        let model = Grid { pins: vec![0, 24, 40], ..Grid::horizontal(9, 0.02) }.model();
        let mut settings = settings();
        settings.rule = rule;
        let colliders = Colliders::new(None, vec![sphere.clone()]);
        let mut reference = Reference::new(&model, &settings, colliders);
        for _ in 0..300 {
            reference.step();
        }
        assert!(reference.contacts()[40].touching, "the pinned particle over the sphere is inside it");
        for pin in [0, 24, 40] {
            assert_eq!(reference.positions()[pin], model.positions[pin]);
            assert_eq!(reference.velocities()[pin], Vec3::ZERO);
        }
        assert_ne!(reference.positions()[1], model.positions[1]);
    }
}

/// A strip one particle wide, pinned at the top.
fn strip() -> Model {
    Grid {
        columns: 1,
        rows: 21,
        down: Vec3::NEG_Y,
        stiffnesses: [20.0, 0.0, 0.0],
        pins: vec![0],
        ..Grid::horizontal(21, 0.05)
    }
    .model()
}

/// Largest difference of a spring's elongation from (weight below)/(stiffness·rest length), in parts of that of the top
/// spring, w·L/k.
fn strip_error(model: &Model) -> f32 {
    let mut settings = settings();
    settings.damping = 4.0;
    let mut reference = Reference::new(model, &settings, Colliders::default());
    for _ in 0..12_000 {
        reference.step();
    }
    let [k, h, m] = [20.0, 0.05, 0.2 * 0.05 * 0.05];
    let elongation = |below: usize| below as f32 * m * GRAVITY / (k * h);
    let positions = reference.positions();
    (1..21)
        .map(|i| {
            let measured = positions[i - 1].distance(positions[i]) / h - 1.0;
            (measured - elongation(21 - i)).abs()
        })
        .fold(0.0, f32::max)
        / elongation(20)
}

#[test]
fn a_hanging_strip_stretches_by_the_weight_below() {
    let error = strip_error(&strip());
    assert!(error < 1e-3, "{error}");
}

#[test]
fn the_oracle_of_the_strip_sees_a_wrong_stiffness() {
    let model = changed(strip(), |model| model.links.values.iter_mut().for_each(|link| link.stiffness *= 1.02));
    assert!(strip_error(&model) > 1e-2);
}
