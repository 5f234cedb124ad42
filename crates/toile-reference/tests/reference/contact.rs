//! Contact: friction on a plate, the sphere, and which side of a map answers.

use crate::support::{GRAVITY, Grid, changed, settings, with};
use glam::{DQuat, DVec3, Vec3, vec2, vec3};
use toile_model::{NO_CORNER, ShapeStep};
use toile_reference::maps::{BodyMaps, Surface};
use toile_reference::{Colliders, Contact, Lag, Probe, Reference, step};
use toile_scene::{Form, Friction, MapKind, Mesh, RigidKey, RigidMotion, Rule, Shape, ShapeMotion};

/// Coulomb coefficient of the plate: it holds up to 16.7°.
const FRICTION: f32 = 0.3;

/// A plate with its front at z = 0.
fn plate() -> BodyMaps {
    let mesh = Mesh::cuboid(vec3(-0.5, -0.5, -0.1), vec3(3.0, 0.5, 0.0));
    BodyMaps::around(MapKind::Layers, &[Surface { mesh: &mesh, thickness: 0.0, velocities: None, open: false }], 0.01)
}

/// Speed [m/s] down the slope and distance [m] after 1 s of a cloth that starts at rest on the plate, under gravity tilted by
/// `degrees`; and its largest distance from the plate [m].
fn slide(maps: &BodyMaps, degrees: f32, law: Friction) -> (f32, f32, f32) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut settings = settings();
    settings.thickness = 0.0;
    settings.gravity = vec3(sin, 0.0, -cos) * GRAVITY;
    settings.law = law;
    settings.friction = FRICTION;
    settings.rule = Rule::Predictive;
    let model = Grid { down: Vec3::Y, ..Grid::horizontal(5, 0.02) }.model();
    let model = changed(model, |model| model.positions.iter_mut().for_each(|position| position.z = 0.0));
    let start = model.positions[12].x;
    let mut reference = Reference::new(&model, &settings, Colliders::new(Some(maps.clone()), Vec::new()));
    let mut off = 0.0_f32;
    for _ in 0..600 {
        reference.step();
        off = reference.positions().iter().fold(off, |off, p| off.max(p.z.abs()));
    }
    (reference.velocities()[12].x, reference.positions()[12].x - start, off)
}

#[test]
fn coulomb_friction_holds_up_to_its_angle() {
    let maps = plate();
    let limit = FRICTION.atan().to_degrees();
    for degrees in [5.0, limit - 0.5] {
        let (speed, distance, off) = slide(&maps, degrees, Friction::Coulomb);
        assert!(speed.abs() < 1e-6 && distance.abs() < 1e-5 && off < 1e-5, "{degrees}: {speed} {distance} {off}");
    }
}

/// Difference of the speed after 1 s from g·(sin a − μ·cos a), in parts of it.
fn slide_error(maps: &BodyMaps, degrees: f32, friction: f32) -> f32 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let expected = GRAVITY * (sin - friction * cos);
    (slide(maps, degrees, Friction::Coulomb).0 - expected).abs() / expected
}

#[test]
fn coulomb_friction_slides_above_its_angle() {
    let maps = plate();
    for degrees in [FRICTION.atan().to_degrees() + 0.5, 20.0, 30.0] {
        let error = slide_error(&maps, degrees, FRICTION);
        assert!(error < 1e-3, "{degrees}: {error}");
    }
}

#[test]
fn the_oracle_of_sliding_sees_a_flipped_sign() {
    assert!(slide_error(&plate(), 30.0, -FRICTION) > 0.1);
}

#[test]
fn the_papers_law_never_sticks() {
    let maps = plate();
    let sin = 5.0_f32.to_radians().sin();
    let whole = Friction::Papers { velocity_kept: 0.5, force_removed: 1.0 };
    let (speed, ..) = slide(&maps, 5.0, whole);
    let creep = 0.5 * GRAVITY * sin * settings().dt;
    assert!((speed - creep).abs() < 1e-3 * creep, "creeps at {speed}, not at {creep}");

    let half = Friction::Papers { velocity_kept: 0.5, force_removed: 0.5 };
    let (speed, ..) = slide(&maps, 5.0, half);
    let expected = 0.5 * GRAVITY * sin;
    assert!((speed - expected).abs() < 2e-3 * expected, "reaches {speed}, not {expected}");
}

/// Velocity of the cloth after it met the plate at 1 m/s, 2 m/s along it.
fn pressed(pressing: f32, sweeps: u32) -> Vec3 {
    let maps = plate();
    let settings = with(settings(), |step| {
        step.thickness = 0.0;
        step.gravity = Vec3::ZERO;
        step.friction = FRICTION;
        step.pressing = pressing;
        step.sweeps = sweeps;
    });
    let model = Grid { down: Vec3::Y, ..Grid::horizontal(2, 0.02) }.model();
    let mut particles = toile_reference::Particles::new(&model);
    particles.positions.iter_mut().for_each(|position| position.z = 0.0);
    particles.velocities.fill(vec3(2.0, 0.0, -1.0));
    let mut probes =
        step::sample_body_maps(&particles.positions, &particles.velocities, &maps, Lag::default(), &settings);
    let midpoints = step::quad_midpoints(&particles.positions, &particles.velocities, &model.quads);
    let seen = step::Probes { particles: &mut probes, quads: &[Probe::default()] };
    step::collide(&mut particles, &model.particle_quads, &midpoints, seen, &settings);
    particles.velocities[0]
}

#[test]
fn friction_counts_a_pressure_up_to_its_bound() {
    let whole = pressed(f32::INFINITY, 1);
    assert!((whole - vec3(2.0 - FRICTION, 0.0, 0.0)).length() < 1e-6, "{whole}");
    for sweeps in [1, 4] {
        let bounded = pressed(200.0, sweeps);
        let counted = 200.0 * settings().dt / sweeps as f32;
        assert!(counted < 1.0, "the bound acts");
        assert!((bounded - vec3(2.0 - FRICTION * counted, 0.0, 0.0)).length() < 1e-6, "{sweeps}: {bounded}");
    }
}

#[test]
fn a_rebound_gives_back_its_part_of_the_approach() {
    let maps = plate();
    let mut settings = settings();
    settings.thickness = 0.0;
    settings.gravity = Vec3::ZERO;
    settings.reflection = 0.5;
    settings.friction = 0.0;
    let model = Grid { down: Vec3::Y, ..Grid::horizontal(2, 0.02) }.model();
    let model = changed(model, |model| model.positions.iter_mut().for_each(|position| position.z = 0.0005));
    let mut probes =
        step::sample_body_maps(&model.positions, &[vec3(0.1, 0.0, -1.0); 4], &maps, Lag::default(), &settings);
    let mut particles = toile_reference::Particles::new(&model);
    particles.velocities = vec![vec3(0.1, 0.0, -1.0); 4];
    let midpoints = step::quad_midpoints(&particles.positions, &particles.velocities, &model.quads);
    let seen = step::Probes { particles: &mut probes, quads: &[Probe::default()] };
    step::collide(&mut particles, &model.particle_quads, &midpoints, seen, &settings);
    for velocity in particles.velocities {
        assert!((velocity - vec3(0.1, 0.0, 0.5)).length() < 1e-6, "{velocity}");
    }
}

/// A pinned ball stands beside a particle whose limit reaches over it. The far end is struck by another ball in the first sweep, so that the limit
/// pulls the particle into the first ball in the second sweep, which no particle reached before.
#[test]
fn what_a_later_sweep_leads_into_a_shape_meets_it() {
    let model = Grid { columns: 2, rows: 1, ..Grid::horizontal(2, 0.3) }.model();
    let near = vec3(0.0, 0.0525, 0.0);
    let far = near - vec3(0.0, 0.3 * 1.05, 0.0);
    let model = changed(model, |model| model.positions = vec![near, far]);
    let ball = Shape::sphere(DVec3::ZERO, 0.05);
    // It comes from above at 3 m/s, and touches the far end at once.
    let speed = 3.0;
    let keys =
        [0.0, 1.0].map(|time| RigidKey { time, translation: DVec3::NEG_Y * speed * time, rotation: DQuat::IDENTITY });
    let beside = DVec3::new(0.0, f64::from(far.y) + 0.02 + 0.0011, 0.0);
    let motion = ShapeMotion::Keys(RigidMotion { keys: keys.to_vec() });
    let mut striker = Shape::sphere(beside, 0.02);
    striker.motion = motion;
    let mut settings = settings();
    settings.gravity = Vec3::ZERO;
    settings.rule = Rule::Predictive;
    settings.sweeps = 2;
    let mut reference = Reference::new(&model, &settings, Colliders::new(None, vec![ball, striker]));
    reference.step();
    assert!(reference.velocities()[1].y < -1.0, "it is struck: {}", reference.velocities()[1]);
    let clearance = reference.positions()[0].y - 0.05 - settings.thickness;
    assert!(clearance > -1e-4, "{clearance} m");
}

#[test]
fn a_colliding_midpoint_stops_its_corners_and_pushes_none_away() {
    let model = Grid::horizontal(2, 0.02).model();
    let mut settings = settings();
    settings.friction = 0.0;
    let mut particles = toile_reference::Particles::new(&model);
    // One corner falls, one rises: the midpoint falls.
    particles.velocities = vec![vec3(0.0, -1.0, 0.0), vec3(0.0, 0.4, 0.0), Vec3::ZERO, Vec3::ZERO];
    let before = particles.velocities.clone();
    let midpoints = step::quad_midpoints(&particles.positions, &particles.velocities, &model.quads);
    let touched = [Probe { normal: Vec3::Y, distance: 0.0, velocity: Vec3::ZERO, hit: true }];
    let seen = step::Probes { particles: &mut [Probe::default(); 4], quads: &touched };
    step::collide(&mut particles, &model.particle_quads, &midpoints, seen, &settings);
    assert!((particles.velocities[0].y + 0.4).abs() < 1e-6, "{}", particles.velocities[0]);
    assert_eq!(particles.velocities[1..], before[1..], "who does not approach is left alone");
    let mean: f32 = particles.velocities.iter().map(|v| v.y).sum();
    assert!(mean.abs() < 1e-6, "the midpoint stops: {mean}");
}

#[test]
fn the_nearer_side_of_the_plate_answers() {
    let maps = plate();
    let mut settings = settings();
    settings.thickness = 0.0;
    // Farther out than the reach of four texels of the plate's maps nothing answers.
    let points = [-0.01, -0.09, 0.1, -0.2].map(|z| vec3(0.203, 0.104, z));
    let probes = step::sample_body_maps(&points, &[Vec3::ZERO; 4], &maps, Lag::default(), &settings);
    assert_eq!(probes.iter().map(|probe| probe.hit).collect::<Vec<_>>(), [true, true, false, false]);
    assert_eq!((probes[0].normal, probes[1].normal), (Vec3::Z, Vec3::NEG_Z));
    for probe in &probes[..2] {
        assert!((probe.distance + 0.01).abs() < 1e-6, "{probe:?}");
    }
    let not_a_number = step::sample_body_maps(&[Vec3::NAN], &[Vec3::ZERO], &maps, Lag::default(), &settings);
    assert!(!not_a_number[0].hit);
}

/// Smallest distance [m] of a particle to a sphere of radius `reach` [m] over 2 s of a sheet dropped on one of 0.2 m.
///
/// The cloth strikes at 1 m/s, 1.7 mm per step; its own contact has the last word, so it keeps its thickness of 1 mm all the same.
fn sphere_clearance(motion: ShapeMotion, reach: f32) -> f32 {
    let mut sphere = Shape::sphere(DVec3::new(0.0, -0.25, 0.0), 0.2);
    sphere.motion = motion;
    let mut settings = settings();
    settings.dt = 1.0 / 600.0;
    settings.rule = Rule::Predictive;
    settings.sweeps = 2;
    settings.damping = 0.5;
    let model = Grid::horizontal(21, 0.03).model();
    let colliders = Colliders::new(None, vec![sphere.clone()]);
    let mut reference = Reference::new(&model, &settings, colliders);
    let mut touched = 0;
    let mut clearance = f32::INFINITY;
    for k in 0..1200 {
        reference.step();
        touched = touched.max(reference.contacts().iter().filter(|contact| contact.touching).count());
        let centre = ShapeStep::of(&sphere, k, &settings).centre;
        for position in reference.positions() {
            clearance = clearance.min(position.distance(centre) - reach);
        }
    }
    assert!(touched > 30, "{touched} particles touched the sphere");
    assert_eq!(reference.status().non_finite_count, 0);
    clearance
}

#[test]
fn a_sheet_dropped_on_a_sphere_stays_outside() {
    let clearance = sphere_clearance(ShapeMotion::Still, 0.2);
    assert!(clearance > 9e-4, "{clearance}");
}

#[test]
fn a_sheet_on_a_moving_sphere_stays_outside() {
    let swing = ShapeMotion::Swing { amplitude: DVec3::new(0.1, 0.05, 0.0), period: 1.0 };
    let clearance = sphere_clearance(swing, 0.2);
    assert!(clearance > 4e-4, "{clearance}");
}

#[test]
fn the_oracle_of_the_sphere_sees_a_larger_one() {
    assert!(sphere_clearance(ShapeMotion::Still, 0.202) < 0.0);
}

/// By how much the direction is wrong in which a capsule meets points that it passes at 100 m/s within one step.
fn capsule_error(swept: bool) -> f32 {
    let mut settings = settings();
    settings.dt = 1.0 / 60.0;
    settings.swept = swept;
    settings.thickness = 0.0;
    let swing = ShapeMotion::Swing { amplitude: DVec3::Z * 2.0, period: 4.0 / 60.0 };
    let ends = [DVec3::new(-0.4, 0.0, -0.2), DVec3::new(0.4, 0.1, -0.2)];
    let radius = 0.05;
    let capsule = ShapeStep::of(&with(Shape::capsule(ends, radius), |shape| shape.motion = swing), 0, &settings);
    let [a, b] = [capsule.centre - capsule.axis, capsule.centre + capsule.axis].map(|end| end.truncate());
    // From beside one end to beside the other, and from the line outward.
    let places =
        (-2..=22).flat_map(|x| [0.0, 0.3, 0.6, 0.9].map(|y| a + (b - a) * (x as f32 / 20.0) + vec2(0.0, y * 0.05)));
    let mut worst: f32 = 0.0;
    for place in places {
        let along = ((place - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        let beside = place.distance(a + (b - a) * along) / radius as f32;
        if beside < 0.95 {
            let mut probes = [Probe::default()];
            step::sample_shapes(&mut probes, &[place.extend(0.0)], &[Vec3::ZERO], &[capsule], &settings);
            assert!(probes[0].hit && probes[0].velocity.z > 50.0, "{place} is met");
            worst = worst.max((probes[0].normal.z - (1.0 - beside * beside).sqrt()).abs());
        }
    }
    worst
}

#[test]
fn a_fast_capsule_meets_points_where_it_first_touches_them() {
    assert!(capsule_error(true) < 1e-3, "{}", capsule_error(true));
    assert!(capsule_error(false) > 0.3, "without the test of the whole way: {}", capsule_error(false));
}

/// A box that is turned, with edges of this radius [m], whose upmost corner or edge is at about this height.
fn turned_box(radius: f64, motion: ShapeMotion) -> Shape {
    let rotation = DQuat::from_rotation_z(0.7) * DQuat::from_rotation_x(0.5);
    let half_size = DVec3::new(0.2, 0.12, 0.25);
    let mut shape = Shape::cuboid(DVec3::new(0.0, -0.35, 0.0), 2.0 * half_size, radius);
    shape.form = Form::Box { half_size, rotation, radius };
    shape.motion = motion;
    shape
}

/// By how much [m] the planes that a box tells of points around it are off its exact distance, within and outside.
fn box_error(shape: &Shape, thickness: f32) -> f64 {
    let mut settings = settings();
    settings.thickness = thickness;
    settings.swept = false;
    let told = ShapeStep::of(shape, 0, &settings);
    let places = (0..4000).map(|k| {
        let place = |k: u32, base: u32| {
            (0..12)
                .fold((0.0, 1.0 / base as f64, k), |(sum, part, k), _| {
                    (sum + part * (k % base) as f64, part / base as f64, k / base)
                })
                .0
        };
        shape.centre + (DVec3::new(place(k, 2), place(k, 3), place(k, 5)) - 0.5) * 1.2
    });
    let mut worst: f64 = 0.0;
    for place in places {
        let mut probes = [Probe::default()];
        step::sample_shapes(&mut probes, &[place.as_vec3()], &[Vec3::ZERO], &[told], &settings);
        let [probe] = probes;
        assert!(probe.hit && (probe.normal.length() - 1.0).abs() < 1e-5, "{probe:?}");
        worst = worst.max((f64::from(probe.distance + thickness) + shape.depth(place, 0.0)).abs());
        // Along the normal the distance falls to nothing: it is the plane that touches the box.
        if probe.distance > 0.0 {
            let foot = place - probe.normal.as_dvec3() * f64::from(probe.distance + thickness);
            worst = worst.max(shape.depth(foot, 0.0).abs());
        }
    }
    worst
}

#[test]
fn a_box_is_as_far_away_as_it_is() {
    for radius in [0.0, 0.05, 0.12] {
        for thickness in [0.0, 0.004] {
            let error = box_error(&turned_box(radius, ShapeMotion::Still), thickness);
            assert!(error < 1e-6, "{error} m of a box with edges of {radius} m");
        }
    }
    let mut step = ShapeStep::of(&turned_box(0.05, ShapeMotion::Still), 0, &settings());
    step.centre = Vec3::NAN;
    let mut probes = [Probe::default()];
    step::sample_shapes(&mut probes, &[Vec3::ZERO], &[Vec3::ZERO], &[step], &settings());
    assert!(!probes[0].hit, "a box that is nowhere answers nobody");
}

/// How far [m] from the surface of a box the planes touch it that points tell which pass through it within one step.
fn entry_error(swept: bool) -> f64 {
    let mut settings = settings();
    settings.dt = 1.0 / 60.0;
    settings.swept = swept;
    settings.thickness = 0.0;
    let shape = turned_box(0.04, ShapeMotion::Still);
    let told = ShapeStep::of(&shape, 0, &settings);
    let mut worst: f64 = 0.0;
    for k in 0..200 {
        let angle = 0.37 * f64::from(k);
        let out = DVec3::new(angle.cos(), (1.7 * angle).sin(), (2.3 * angle).cos()).normalize();
        let start = shape.centre + out * 0.6;
        let aim = shape.centre + DVec3::new((3.1 * angle).sin(), (0.9 * angle).cos(), (5.3 * angle).sin()) * 0.06;
        // Most of the way through, and out again on the other side.
        let way = (aim - start) * 2.2;
        let mut probes = [Probe::default()];
        let velocity = (way * 60.0).as_vec3();
        step::sample_shapes(&mut probes, &[start.as_vec3()], &[velocity], &[told], &settings);
        // Where the way meets the plane, and where it meets the box.
        let [probe] = probes;
        let share = -f64::from(probe.distance) / probe.normal.as_dvec3().dot(way);
        worst = worst.max(shape.depth(start + way * share, 0.0).abs());
    }
    worst
}

#[test]
fn a_fast_point_meets_a_box_where_it_first_touches_it() {
    assert!(entry_error(true) < 1e-4, "{} m", entry_error(true));
    assert!(entry_error(false) > 0.03, "without the test of the whole way: {} m", entry_error(false));
}

/// How many particles of a sheet of n × n touch a shape at once, and how deep one is in it at most [m], in so many steps after it was let go.
fn dropped_on(shape: &Shape, n: u32, step_count: u32) -> (usize, f64) {
    let mut settings = settings();
    settings.dt = 1.0 / 600.0;
    settings.rule = Rule::Predictive;
    settings.sweeps = 2;
    settings.damping = 0.5;
    let model = Grid::horizontal(n, 0.03).model();
    let mut reference = Reference::new(&model, &settings, Colliders::new(None, vec![shape.clone()]));
    let (mut touched, mut deepest) = (0, f64::NEG_INFINITY);
    for step in 1..=step_count {
        reference.step();
        touched = touched.max(reference.contacts().iter().filter(|contact| contact.touching).count());
        let time = f64::from(step) / 600.0;
        let depths = reference.positions().iter().map(|position| shape.depth(position.as_dvec3(), time));
        deepest = depths.fold(deepest, f64::max);
    }
    (touched, deepest)
}

#[test]
fn a_sheet_dropped_on_a_box_stays_outside_also_where_it_turns() {
    let key = |time: f64| RigidKey { time, translation: DVec3::ZERO, rotation: DQuat::from_rotation_y(1.5 * time) };
    let turning = ShapeMotion::Keys(RigidMotion { keys: vec![key(0.0), key(1.0), key(2.0)] });
    for (motion, radius) in [(ShapeMotion::Still, 0.0), (ShapeMotion::Still, 0.05), (turning, 0.05)] {
        let shape = turned_box(radius, motion);
        let (touched, deepest) = dropped_on(&shape, 21, 900);
        assert!(touched > 10, "{touched} particles touched the box");
        assert!(deepest < -1e-4, "{deepest} m deep, with edges of {radius} m");
    }
}

#[test]
fn a_sheet_dropped_on_a_capsule_stays_outside() {
    let capsule = Shape::capsule([DVec3::new(-0.2, -0.3, 0.1), DVec3::new(0.2, -0.25, -0.1)], 0.2);
    let (touched, deepest) = dropped_on(&capsule, 21, 1200);
    assert!(touched > 20, "{touched} particles touched the capsule");
    assert!(deepest < -4e-4, "{deepest} m deep");
}

/// A plate lifts the cloth, however fast it falls.
#[test]
fn a_sheet_that_falls_on_a_plane_that_swings_stays_above_it() {
    let swing = ShapeMotion::Swing { amplitude: DVec3::new(0.0, 0.1, 0.0), period: 0.5 };
    let mut plane = Shape::plane(DVec3::new(0.0, -0.2, 0.0), DVec3::new(0.1, 1.0, 0.0));
    plane.motion = swing;
    let (touched, deepest) = dropped_on(&plane, 9, 300);
    assert!(touched > 40, "{touched} particles touched the plane");
    assert!(deepest < 0.0, "{deepest} m deep");
}

#[test]
fn maps_are_read_where_they_were_drawn() {
    let mesh = Mesh::cuboid(vec3(0.1, 0.3, 0.0), vec3(0.2, 0.5, 0.1));
    let maps = BodyMaps::around(
        MapKind::Layers,
        &[Surface { mesh: &mesh, thickness: 0.0, velocities: None, open: false }],
        0.01,
    );
    let points = [vec3(0.12, 0.33, 0.05), vec3(0.18, 0.48, 0.05), vec3(0.12, 0.28, 0.05), vec3(0.08, 0.48, 0.05)];
    let probes = step::sample_body_maps(&points, &[Vec3::ZERO; 4], &maps, Lag::default(), &settings());
    let inside = |probe: &Probe| probe.hit && probe.distance < -settings().thickness;
    assert_eq!(probes.iter().map(inside).collect::<Vec<_>>(), [true, true, false, false]);
}

#[test]
fn a_contact_remembers_the_surface_it_touched() {
    let model = changed(Grid::horizontal(2, 0.02).model(), |model| model.inverse_masses[3] = 0.0);
    let mut particles = toile_reference::Particles::new(&model);
    let velocity = vec3(0.1, 0.2, 0.3);
    let mut probes = [Probe { normal: Vec3::Y, distance: 0.0, velocity, hit: true }; 4];
    probes[0].hit = false;
    let midpoints = step::quad_midpoints(&particles.positions, &particles.velocities, &model.quads);
    let seen = step::Probes { particles: &mut probes, quads: &[Probe::default()] };
    let contacts = step::collide(&mut particles, &model.particle_quads, &midpoints, seen, &settings());
    assert_eq!(contacts[0], Contact::default());
    assert_eq!(contacts[1], Contact { normal: Vec3::Y, velocity, touching: true });
    assert!((particles.velocities[1].y - velocity.y).abs() < 1e-6);
    assert_eq!(particles.velocities[3], Vec3::ZERO, "a pinned particle is in contact but does not answer");
    assert!(contacts[3].touching);
}

#[test]
fn the_midpoint_of_a_triangle_is_its_centroid() {
    let corners = [Vec3::ZERO, vec3(3.0, 0.0, 0.0), vec3(0.0, 6.0, 0.0), vec3(1.0, 2.0, 4.0)];
    let quads = [[0, 1, 2, NO_CORNER], [0, 1, 2, 3]];
    let midpoints = step::quad_midpoints(&corners, &corners, &quads);
    assert!((midpoints.positions[0] - vec3(1.0, 2.0, 0.0)).length() < 1e-6);
    assert!((midpoints.velocities[1] - vec3(1.0, 2.0, 1.0)).length() < 1e-6);
}
