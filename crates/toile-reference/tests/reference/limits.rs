//! Each rule on a single limit.

use crate::support::{Parts, THRESHOLD, settings, with};
use glam::{Vec3, vec3};
use toile_model::{Limit, Spring, SpringKind};
use toile_reference::{Contact, Particles, step};

const DT: f32 = 0.01;

/// Two particles of 1 kg and 3 kg at a distance of 1.2 m, b above a, with a limit of 1.05 m.
fn pair(pins: &[usize]) -> (Particles, [Limit; 1]) {
    let spring =
        Spring { ends: [0, 1], rest_length: 1.0, stiffness: 1.0, threshold: THRESHOLD, kind: SpringKind::Structural };
    let model = Parts {
        positions: vec![Vec3::ZERO, vec3(0.0, 1.2, 0.0)],
        masses: vec![1.0, 3.0],
        pins: pins.to_vec(),
        springs: vec![spring],
        quads: vec![],
    }
    .model();
    let mut particles = Particles::new(&model);
    for (velocity, inverse_mass) in particles.velocities.iter_mut().zip(&particles.inverse_masses) {
        *velocity = vec3(1.0, -2.0, 0.0) * inverse_mass;
    }
    (particles, [model.limits[0]])
}

fn axial(particles: &Particles) -> [f32; 2] {
    [particles.velocities[0].y, particles.velocities[1].y]
}

#[test]
fn zero_takes_the_axial_velocity_only() {
    let (mut particles, limits) = pair(&[]);
    let before = particles.clone();
    step::limit_zero(&mut particles, &limits);
    assert_eq!(axial(&particles), [0.0, 0.0]);
    assert_eq!(particles.velocities[0].x, before.velocities[0].x);
}

#[test]
fn average_gives_the_mean_by_mass() {
    let (mut particles, limits) = pair(&[]);
    let mean = (-2.0 * 1.0 + -2.0 / 3.0 * 3.0) / 4.0;
    step::limit_average(&mut particles, &limits);
    for speed in axial(&particles) {
        assert!((speed - mean).abs() < 1e-6);
    }
}

#[test]
fn a_pinned_end_makes_the_other_follow_it() {
    for rule in [step::limit_average, step::limit_zero] {
        let (mut particles, limits) = pair(&[1]);
        rule(&mut particles, &limits);
        assert_eq!(axial(&particles), [0.0, 0.0]);
        assert_eq!(particles.velocities[0].x, 1.0);
    }
}

#[test]
fn directional_makes_the_rear_end_follow_the_front_end() {
    // Gravity points from b to a: b is the rear end.
    let (mut particles, limits) = pair(&[]);
    step::limit_directional(&mut particles, &limits, None, &settings());
    assert_eq!(particles.velocities[0].y, -2.0);
    assert!((particles.velocities[1].y + 2.0).abs() < 1e-6);

    // A fast body that pushes up turns that round, whether one end touches it or both.
    let up = Contact { normal: Vec3::Y, velocity: vec3(0.0, 10.0, 0.0), touching: true };
    for contacts in [[up, up], [up, Contact::default()], [Contact::default(), up]] {
        let (mut particles, limits) = pair(&[]);
        let front = particles.velocities[1].y;
        step::limit_directional(&mut particles, &limits, Some(&contacts), &settings());
        assert_eq!(particles.velocities[1].y, front);
        assert!((particles.velocities[0].y - front).abs() < 1e-6);
    }
}

#[test]
fn directional_averages_across_gravity_and_without_it() {
    for gravity in [Vec3::X, Vec3::ZERO, vec3(1.0, 0.3, 0.0)] {
        let (mut directional, limits) = pair(&[]);
        let mut average = directional.clone();
        step::limit_directional(&mut directional, &limits, None, &with(settings(), |step| step.gravity = gravity));
        step::limit_average(&mut average, &limits);
        assert_eq!(directional, average);
    }
}

#[test]
fn predictive_cuts_what_would_become_over_long() {
    let (mut particles, limits) = pair(&[]);
    step::limit_predictive(&mut particles, &limits, &mut [Vec3::ZERO; 2], DT);
    step::move_particles(&mut particles.positions, &particles.velocities, DT);
    assert!((particles.positions[0].distance(particles.positions[1]) - 1.05).abs() < 1e-5);
}

#[test]
fn position_shortens_without_a_change_of_velocity() {
    let (mut particles, limits) = pair(&[]);
    let before = particles.clone();
    step::limit_position(&mut particles, &limits);
    assert!((particles.positions[0].distance(particles.positions[1]) - 1.05).abs() < 1e-6);
    assert_eq!(particles.velocities, before.velocities);
    let moved: Vec<f32> =
        (0..2).map(|i| (particles.positions[i].y - before.positions[i].y) * particles.masses[i]).collect();
    assert!((moved[0] + moved[1]).abs() < 1e-6 && moved[0] > 0.0);
}

#[test]
fn two_pinned_ends_and_a_short_spring_are_left_alone() {
    let rules: [fn(&mut Particles, &[Limit]); 5] = [
        step::limit_zero,
        step::limit_average,
        step::limit_position,
        |particles, limits| step::limit_predictive(particles, limits, &mut [Vec3::ZERO; 2], DT),
        |particles, limits| step::limit_directional(particles, limits, None, &settings()),
    ];
    for rule in rules {
        let (before, limits) = pair(&[0, 1]);
        let mut particles = before.clone();
        rule(&mut particles, &limits);
        assert_eq!(particles, before);

        let (mut before, limits) = pair(&[]);
        before.positions[1].y = 0.9;
        let mut particles = before.clone();
        rule(&mut particles, &limits);
        assert_eq!(particles, before);
    }
}
