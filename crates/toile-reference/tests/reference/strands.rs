//! Limits along a strand.

use glam::Vec3;
use toile_model::{Model, Strand};
use toile_reference::{Particles, step};

const COUNT: usize = 33;
const EDGE: f32 = 0.01;
const DT: f32 = 1e-3;

/// A strand around a body of 5 cm, each edge 2 % too long, of which limits over eight edges alone say so.
fn around_a_body() -> (Particles, Strand, Vec<f32>) {
    let radius = 0.05;
    let weight = |k: usize| 1.0 + (k % 3) as f32;
    let angle = |k: usize| 2.0 * (0.51 * EDGE / radius).asin() * k as f32;
    let model = Model {
        positions: (0..COUNT).map(|k| radius * Vec3::new(angle(k).cos(), angle(k).sin(), 0.0)).collect(),
        masses: (0..COUNT).map(|k| 1.0 / weight(k)).collect(),
        inverse_masses: (0..COUNT).map(weight).collect(),
        ..Model::default()
    };
    let lengths =
        (0..4).flat_map(|level| vec![if level < 3 { 1.0 } else { 8.0 * EDGE }; COUNT - (1 << level)]).collect();
    (Particles::new(&model), Strand { particles: 0..COUNT as u32, stride: 1, lengths: 0, level_count: 4 }, lengths)
}

#[test]
fn a_long_limit_holds_the_path_around_a_body_where_its_chord_is_slack() {
    let (mut particles, strand, lengths) = around_a_body();
    let after = |particles: &Particles, k: usize| particles.positions[k] + particles.velocities[k] * DT;
    let path = |particles: &Particles, first: usize| -> f32 {
        (0..4).map(|k| after(particles, first + 2 * k).distance(after(particles, first + 2 * k + 2))).sum()
    };
    let longest = |particles: &Particles| (0..COUNT - 8).map(|k| path(particles, k)).fold(0.0, f32::max);
    assert!(after(&particles, 0).distance(after(&particles, 8)) < 0.95 * 8.0 * EDGE, "the chord is slack");
    assert!(longest(&particles) > 1.01 * 8.0 * EDGE, "the path is too long");
    let line: Vec<u32> = (0..COUNT as u32).collect();
    for _ in 0..40 {
        step::limit_strands(&mut particles, std::slice::from_ref(&strand), &line, &lengths, DT);
    }
    assert!(longest(&particles) < 1.0005 * 8.0 * EDGE, "{}", longest(&particles) / (8.0 * EDGE));
    let momenta = || particles.velocities.iter().zip(&particles.inverse_masses).map(|(v, weight)| *v / *weight);
    let (sum, sizes): (Vec3, f32) = (momenta().sum(), momenta().map(Vec3::length).sum());
    assert!(sum.length() < 1e-6 * sizes, "{sum} of {sizes}");
    let spins = || particles.positions.iter().zip(momenta()).map(|(place, momentum)| place.cross(momentum));
    let (spin, sizes): (Vec3, f32) = (spins().sum(), spins().map(Vec3::length).sum());
    assert!(spin.length() < 1e-2 * sizes, "{spin} of {sizes}");
}

#[test]
fn a_path_within_its_length_changes_nothing() {
    let (mut particles, strand, lengths) = around_a_body();
    particles.positions.iter_mut().for_each(|place| *place *= 0.98);
    let line: Vec<u32> = (0..COUNT as u32).collect();
    step::limit_strands(&mut particles, &[strand], &line, &lengths, DT);
    assert!(particles.velocities.iter().all(|velocity| *velocity == Vec3::ZERO));
}
