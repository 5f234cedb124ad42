//! Free fall and momentum: what a rule does to a cloth that nothing holds.

use crate::support::{Grid, Parts, Random, THRESHOLD, centre, changed, momentum, momentum_scale, settings, with};
use glam::{DVec3, Vec3};
use toile_model::{Model, Spring, SpringKind, StepSettings};
use toile_reference::{Colliders, Particles, Reference, limits, step};
use toile_scene::Rule;

const STEPS: u32 = 300;

/// What rounding makes of the fall: particles that fall alike are rounded alike, by up to 6e-8 of their velocity in each step.
const ROUNDING: f64 = 4e-6;

/// A sheet stretched by 20 % in its plane, so that every limit acts; upright, so that the directional rule sees a front.
fn stretched_sheet() -> Model {
    let model = Grid { right: Vec3::X, down: Vec3::NEG_Y, ..Grid::horizontal(8, 0.02) }.model();
    changed(model, |model| model.positions.iter_mut().for_each(|position| *position *= 1.2))
}

/// Largest distance of the centre of mass from the closed form of symplectic Euler, p_k = p_0 + g·dt²·k(k + 1)/2, over the
/// fall, in parts of the distance fallen in all.
fn free_fall_error(model: &Model, settings: &StepSettings) -> f64 {
    let gravity = DVec3::new(0.0, -9.81, 0.0) * f64::from(settings.dt).powi(2);
    let fallen = |k: u32| gravity * (0.5 * f64::from(k) * f64::from(k + 1));
    let mut reference = Reference::new(model, settings, Colliders::default());
    let start = centre(reference.positions());
    (1..=STEPS)
        .map(|k| {
            reference.step();
            (centre(reference.positions()) - start - fallen(k)).length()
        })
        .fold(0.0, f64::max)
        / fallen(STEPS).length()
}

#[test]
fn a_relaxed_sheet_falls_freely_under_every_rule() {
    let model = Grid::horizontal(8, 0.02).model();
    for (_, rule) in Rule::ALL {
        let error = free_fall_error(&model, &with(settings(), |step| step.rule = rule));
        assert!(error < ROUNDING, "{rule:?}: {error}");
    }
}

#[test]
fn a_stretched_sheet_falls_freely_under_the_rules_that_keep_momentum() {
    let model = stretched_sheet();
    for rule in [Rule::None, Rule::Average, Rule::Position, Rule::Predictive, Rule::Hierarchical] {
        let error = free_fall_error(&model, &with(settings(), |step| step.rule = rule));
        assert!(error < ROUNDING, "{rule:?}: {error}");
    }
}

#[test]
fn the_zero_rule_brakes_and_the_directional_rule_disturbs_the_fall_of_a_stretched_sheet() {
    let model = stretched_sheet();
    for rule in [Rule::Zero, Rule::Directional] {
        let error = free_fall_error(&model, &with(settings(), |step| step.rule = rule));
        assert!(error > 1e-3, "{rule:?}: {error}");
    }
}

#[test]
fn the_oracle_of_free_fall_sees_a_flipped_sign() {
    let model = stretched_sheet();
    let mut upwards = settings();
    upwards.gravity = Vec3::new(0.0, 9.81, 0.0);
    assert!(free_fall_error(&model, &upwards) > 1.0);
}

/// Particles of random masses with random springs, most of them over-long, and some pinned when asked.
fn blob() -> (Model, Particles) {
    let mut random = Random(7);
    let mut parts = Parts::default();
    for _ in 0..200 {
        parts.positions.push(random.vector());
        parts.masses.push(0.001 + 0.01 * random.number());
    }
    for _ in 0..600 {
        let [a, b] = [random.index(200), random.index(200)];
        if a != b {
            parts.springs.push(Spring {
                ends: [a.min(b), a.max(b)],
                rest_length: 0.1 + random.number(),
                stiffness: 1.0,
                threshold: THRESHOLD,
                kind: SpringKind::Structural,
            });
        }
    }
    let model = parts.model();
    let mut particles = Particles::new(&model);
    for velocity in &mut particles.velocities {
        *velocity = random.vector() * 3.0;
    }
    (model, particles)
}

/// Change of momentum by `kernel` over all colours, in parts of Σ m·|v|; and whether any velocity changed.
fn momentum_error(kernel: impl Fn(&mut Particles, &[toile_model::Limit])) -> (f64, bool) {
    let (model, before) = blob();
    let mut after = before.clone();
    for colour in &model.limit_colours {
        kernel(&mut after, &model.limits[colour.start as usize..colour.end as usize]);
    }
    let error = (momentum(&after) - momentum(&before)).length() / momentum_scale(&before);
    (error, after.velocities != before.velocities)
}

#[test]
fn average_and_predictive_keep_momentum() {
    let (error, acted) = momentum_error(step::limit_average);
    assert!(acted && error < 1e-6, "average {error}");
    let (error, acted) = momentum_error(|particles, limits| {
        step::limit_predictive(particles, limits, &mut vec![Vec3::ZERO; 200], 0.01);
    });
    assert!(acted && error < 1e-6, "predictive {error}");
    let (model, before) = blob();
    let mut settings = settings();
    settings.dt = 0.01;
    let mut after = before.clone();
    let mut pulls = vec![Vec3::ZERO; 200];
    limits::sweep(
        &mut after,
        &model,
        &with(settings.clone(), |step| {
            step.rule = Rule::Hierarchical;
            step.sweeps = 1;
        }),
        None,
        &mut pulls,
    );
    step::warm_start(&mut after, &mut pulls);
    let error = (momentum(&after) - momentum(&before)).length() / momentum_scale(&before);
    assert!(pulls.iter().any(|pull| *pull != Vec3::ZERO) && error < 1e-6, "levels and warm start {error}");
    let mut after = before.clone();
    for colour in &model.levels[0].colours {
        step::limit_guard(&mut after, &model, colour, 1.0, &settings);
    }
    let error = (momentum(&after) - momentum(&before)).length() / momentum_scale(&before);
    assert!(after.velocities != before.velocities && error < 1e-6, "guard {error}");
}

#[test]
fn zero_and_directional_do_not_keep_momentum() {
    assert!(momentum_error(step::limit_zero).0 > 1e-2);
    let settings = settings();
    let directional = |particles: &mut Particles, limits: &[_]| {
        step::limit_directional(particles, limits, None, &settings);
    };
    assert!(momentum_error(directional).0 > 1e-2);
}

#[test]
fn the_oracle_of_momentum_sees_a_flipped_sign() {
    let (error, _) = momentum_error(|particles, limits| {
        let before = particles.clone();
        step::limit_predictive(particles, limits, &mut vec![Vec3::ZERO; 200], 0.01);
        for limit in limits {
            let b = limit.ends[1] as usize;
            particles.velocities[b] = before.velocities[b] * 2.0 - particles.velocities[b];
        }
    });
    assert!(error > 1e-2, "{error}");
}
