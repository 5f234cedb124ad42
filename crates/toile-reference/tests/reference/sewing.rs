//! Sewing: seams that close, edges that are held, and the handover.

use crate::support::{Grid, Parts, THRESHOLD, changed, momentum, settings, with};
use glam::{Vec3, vec3};
use toile_model::{Csr, Hold, Merge, Model, SeamPair, Spring, SpringKind};
use toile_reference::{Colliders, Particles, Reference, frame, step};
use toile_scene::Rule;

fn with_seam(model: Model, pair: SeamPair) -> Model {
    changed(model, |model| {
        model.seam_pairs = vec![pair];
        model.seam_colours = std::iter::once(0..1).collect();
    })
}

fn two_particles() -> Model {
    let model =
        Parts { positions: vec![Vec3::ZERO, vec3(0.3, 0.0, 0.4)], masses: vec![1.0, 3.0], ..Parts::default() }.model();
    with_seam(model, SeamPair { ends: [0, 1], closing_speed: 2.0, seam: 0 })
}

/// Four particles at the corner of two seams: of one seam they meet already, and what is on one side of it is drawn along the gap of the other, by
/// limits that answer once the seams were drawn.
#[test]
fn a_corner_of_two_seams_closes_at_its_speed() {
    let mut settings = settings();
    settings.gravity = Vec3::ZERO;
    settings.rule = Rule::Predictive;
    let (gap, beside) = (0.04, Vec3::Y * 1e-9);
    let [near, far, pin] = [0.0, gap, 10.0].map(|x| Vec3::X * x);
    // Over-long by what 2 m/s do in a step.
    let limit = |end, place: Vec3| Spring {
        ends: [end, 4],
        kind: SpringKind::Structural,
        rest_length: (place.distance(pin) - 2.0 * settings.dt) / (1.0 + THRESHOLD),
        stiffness: 0.0,
        threshold: THRESHOLD,
    };
    let model = Parts {
        positions: vec![near, far, near + beside, far + beside, pin],
        masses: vec![3.3e-5, 1.9e-5, 3.8e-5, 3.7e-5, 1.0],
        springs: vec![limit(2, near), limit(3, far)],
        pins: vec![4],
        ..Parts::default()
    };
    let pair = |ends, seam| SeamPair { ends, closing_speed: 0.3, seam };
    let model = changed(model.model(), |model| {
        model.seam_pairs = vec![pair([0, 1], 0), pair([2, 3], 0), pair([0, 2], 1), pair([1, 3], 1)];
        model.seam_colours = vec![0..2, 2..4];
    });
    let mut reference = Reference::new(&model, &settings, Colliders::default());
    reference.step();
    let closed = 0.3 * settings.dt;
    for [a, b] in [[0, 1], [2, 3]] {
        let left = reference.positions()[a].distance(reference.positions()[b]);
        assert!((gap - left - closed).abs() < 0.1 * closed, "{a} and {b} are {left} m apart");
    }
}

#[test]
fn a_seam_closes_at_its_speed_and_stays_closed() {
    let mut settings = settings();
    settings.gravity = Vec3::ZERO;
    let mut reference = Reference::new(&two_particles(), &settings, Colliders::default());
    for k in 1..=200 {
        reference.step();
        let expected = (0.5 - 2.0 * settings.dt * k as f32).max(0.0);
        let gap = reference.status().seam_gap_max;
        assert!((gap - expected).abs() < 1e-5, "step {k}: {gap}, not {expected}");
    }
    let meeting = vec3(0.3, 0.0, 0.4) * 0.75;
    assert!(reference.positions()[0].distance(meeting) < 1e-5, "they meet at the centre of mass");
}

#[test]
fn a_seam_that_a_tight_fit_holds_open_closes_all_the_same() {
    let spring =
        |ends| Spring { ends, kind: SpringKind::Structural, rest_length: 0.1, stiffness: 1.0, threshold: THRESHOLD };
    let model = Parts {
        positions: [0.0, 0.1, 0.14, 0.24].map(|x| x * Vec3::X).to_vec(),
        masses: vec![1.0; 4],
        pins: vec![0, 3],
        springs: vec![spring([0, 1]), spring([2, 3])],
        ..Parts::default()
    }
    .model();
    let model = with_seam(model, SeamPair { ends: [1, 2], closing_speed: 0.2, seam: 0 });
    let settings = with(settings(), |step| {
        step.gravity = Vec3::ZERO;
        step.damping = 5.0;
        step.rule = Rule::Hierarchical;
        step.sweeps = 3;
    });
    let mut reference = Reference::new(&model, &settings, Colliders::default());
    (0..600).for_each(|_| reference.step());
    let gap = reference.status().seam_gap_max;
    assert!(gap < 1e-5, "a fifth longer than at rest, further than the guard allows, they meet: {gap} m apart");
}

#[test]
fn held_edges_return_to_their_mean_height_and_stay_free_within() {
    let settings = settings();
    let mut particles = Particles::new(&two_particles());
    particles.positions = vec![vec3(0.0, 1.0, 0.0), vec3(0.3, 1.2, 0.0)];
    particles.velocities = vec![vec3(1.0, 7.0, 2.0), vec3(0.0, 1.0, 0.0)];
    let holds = [Hold { label: "waist".into(), particles: 0..2, height: 1.08 }];
    step::hold_edges(&mut particles, &holds, &[0, 1], &settings);
    let [a, b] = [particles.velocities[0], particles.velocities[1]];
    assert!((0.5 * (a.y + b.y) + 0.02 * settings.hold_rate).abs() < 1e-5, "the mean sinks towards the height");
    assert!((a.y - b.y - 6.0).abs() < 1e-5, "what they do against each other stays");
    assert_eq!([a.x, a.z, b.x, b.z], [1.0, 2.0, 0.0, 0.0]);
    let far = [Hold { label: "waist".into(), particles: 0..2, height: 9.0 }];
    step::hold_edges(&mut particles, &far, &[0, 1], &settings);
    assert!((0.5 * (particles.velocities[0].y + particles.velocities[1].y) - settings.hold_speed).abs() < 1e-5);
}

#[test]
fn the_handover_keeps_momentum_and_the_centre_of_mass() {
    let open = Grid::horizontal(3, 0.1).model();
    let mut particles = Particles::new(&open);
    for (i, (velocity, mass)) in particles.velocities.iter_mut().zip(&mut particles.masses).enumerate() {
        *velocity = vec3(i as f32, 1.0, -(i as f32));
        *mass *= 1.0 + i as f32;
    }
    let members = Csr::from_rows([vec![0, 8], vec![1], vec![2, 3, 4], vec![5], vec![6, 7]]);
    let masses = (0..5).map(|i| members.row(i).iter().map(|m| particles.masses[*m as usize]).sum()).collect();
    let mut sewn = Particles {
        positions: vec![Vec3::NAN; 5],
        velocities: vec![Vec3::NAN; 5],
        masses,
        inverse_masses: vec![1.0; 5],
    };
    frame::merge_particles(&particles, &members, &mut sewn);
    assert!((momentum(&sewn) - momentum(&particles)).length() < 1e-6 * momentum(&particles).length());
    assert!((sewn.positions[1] - particles.positions[1]).length() < 1e-7);

    // The middle of two particles, weighted 1 to 9.
    let expected = (particles.positions[0] + particles.positions[8] * 9.0) / 10.0;
    assert!((sewn.positions[0] - expected).length() < 1e-7);
}

#[test]
fn a_sewn_reference_goes_on_where_the_open_one_stopped() {
    let mut settings = settings();
    settings.gravity = Vec3::ZERO;
    let mut open = Reference::new(&two_particles(), &settings, Colliders::default());
    for _ in 0..200 {
        open.step();
    }
    let sewn_model = Parts { positions: vec![Vec3::ZERO], masses: vec![4.0], ..Parts::default() }.model();
    let merge = Merge { members: Csr::from_rows([[0, 1]]) };
    let mut sewn = open.sewn(&sewn_model, &super::support::settings(), &merge);
    assert_eq!(sewn.status().step, 200);
    assert!(sewn.positions()[0].distance(vec3(0.3, 0.0, 0.4) * 0.75) < 1e-5);
    sewn.step();
    assert!(sewn.velocities()[0].y < 0.0, "the settings of the sewn model have gravity");
}
