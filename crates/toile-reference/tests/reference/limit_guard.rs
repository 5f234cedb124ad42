//! The last word on single springs, after contacts.

use crate::support::{Grid, settings};
use glam::{DVec3, Vec3};
use toile_reference::{Colliders, Particles, Reference, limits, step};
use toile_scene::{Rule, Shape};

const DT: f32 = 0.01;

/// How much the guard may shorten a spring at once [m].
const WAY: f32 = 0.15;

/// Length of a spring of 1 m with a limit of 1.05 m that stands at `start` [m] and would move to `end` [m], after the kernel, which removes
/// a `share` of its excess [1], and the move.
fn guarded(start: f32, end: f32, share: f32) -> f32 {
    let model = Grid { columns: 2, rows: 1, spacing: 1.0, ..Grid::horizontal(2, 1.0) }.model();
    let mut particles = Particles::new(&model);
    particles.positions = vec![Vec3::ZERO, start * Vec3::X];
    particles.velocities[1] = (end - start) / DT * Vec3::X;
    let mut settings = settings();
    settings.dt = DT;
    settings.thickness = 2.0 * WAY;
    step::limit_guard(&mut particles, &model, &model.levels[0].colours[0], share, &settings);
    step::move_particles(&mut particles.positions, &particles.velocities, DT);
    particles.positions[0].distance(particles.positions[1])
}

#[test]
fn a_spring_ends_a_step_at_most_twice_as_far_as_its_limit() {
    for (start, end, expected) in
        [(1.0, 1.2, 1.1), (1.2, 1.2, 1.1), (1.2, 1.08, 1.08), (1.0, 1.08, 1.08), (1.0, 0.5, 0.5), (1.0, 1.5, 1.5 - WAY)]
    {
        let length = guarded(start, end, 1.0);
        assert!((length - expected).abs() < 1e-5, "from {start} m to {end} m: {length} m");
        let half = guarded(start, end, 0.5);
        assert!((half - 0.5 * (end + expected)).abs() < 1e-5, "half from {start} m to {end} m: {half} m");
    }
}

#[test]
fn a_taut_line_shares_what_is_left_among_its_springs() {
    // Every other spring of a line between two pins would be 1.12 m long, the others 1.1 m, where the guard begins. The line has no other way.
    let model = Grid { columns: 34, rows: 1, pins: vec![0, 33], ..Grid::horizontal(34, 1.0) }.model();
    let mut particles = Particles::new(&model);
    let end = |i: usize| (1.1 * i as f32 + 0.02 * i.div_ceil(2) as f32) * Vec3::X;
    particles.positions = (0..34).map(end).collect();
    let mut settings = settings();
    settings.dt = DT;
    settings.thickness = 1.0;
    settings.rule = Rule::Hierarchical;
    limits::guard(&mut particles, &model, &settings, &[]);
    step::move_particles(&mut particles.positions, &particles.velocities, DT);
    let excess = |ends: &[Vec3]| ends[0].distance(ends[1]) - 1.1;
    let excesses: Vec<f32> = particles.positions.windows(2).map(excess).collect();
    // A particle beside a pin gives way alone, and so twice as far.
    assert!(excesses.iter().all(|excess| *excess < 0.014), "{excesses:?}");
    assert!(excesses[6..27].iter().all(|excess| (excess - 0.01).abs() < 1e-5), "{excesses:?}");
}

/// Largest elongation [1] and depth [m] of two springs of 2 cm in line, their far ends pinned, a second after a ball stands where their
/// middle would have to stretch them by `stretch` [1] to pass around it, a cloth's thickness of 1 mm away.
fn on_a_ball(rule: Rule, stretch: f64) -> (f32, f32) {
    let model = Grid { columns: 3, rows: 1, pins: vec![0, 2], ..Grid::horizontal(3, 0.02) }.model();
    let rise = 0.02 * ((1.0 + stretch).powi(2) - 1.0).sqrt();
    let centre = DVec3::new(0.0, rise - 0.051, model.positions[1].z.into());
    let sphere = Shape::sphere(centre, 0.05);
    let mut settings = settings();
    settings.rule = rule;
    settings.sweeps = 3;
    settings.damping = 2.0;
    let mut reference = Reference::new(&model, &settings, Colliders::new(None, vec![sphere]));
    (0..600).for_each(|_| reference.step());
    let middle = reference.positions()[1];
    let elongation =
        [0, 2].map(|end| middle.distance(model.positions[end]) / 0.02 - 1.0).into_iter().fold(0.0, f32::max);
    (elongation, 0.05 - middle.as_dvec3().distance(centre) as f32)
}

#[test]
fn cloth_gives_way_into_its_thickness_before_a_spring_yields_further() {
    let (unguarded, _) = on_a_ball(Rule::Predictive, 0.12);
    assert!(unguarded > 0.115, "{unguarded}");
    // Each of the two takes a little back of what the other was given.
    let (guarded, depth) = on_a_ball(Rule::Hierarchical, 0.12);
    assert!(guarded > 0.10 && guarded < 0.105 && depth < 0.0, "{guarded}, {depth} m");
}

#[test]
fn cloth_that_is_much_too_short_gives_way_no_deeper_and_stretches() {
    let (elongation, depth) = on_a_ball(Rule::Hierarchical, 0.2);
    assert!(elongation > 0.17 && depth < 1e-6 && depth > -3e-4, "{elongation}, {depth} m");
}
