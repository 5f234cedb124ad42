//! The life of a reference: the same answer every time, in words a reviewer can read.

use crate::support::{Grid, settings};
use glam::DVec3;
use toile_reference::{Colliders, Reference};
use toile_scene::{Rule, Shape};

fn draped() -> Reference {
    let sphere = Shape::sphere(DVec3::new(0.0, -0.11, 0.0), 0.1);
    let mut settings = settings();
    settings.rule = Rule::Predictive;
    settings.sweeps = 2;
    let colliders = Colliders::new(None, vec![sphere]);
    let mut reference = Reference::new(&Grid::horizontal(16, 0.02).model(), &settings, colliders);
    for _ in 0..20 {
        reference.frame();
    }
    reference
}

#[test]
fn two_runs_agree_to_the_bit() {
    assert_eq!(draped().positions(), draped().positions());
}

#[test]
fn the_digest_of_a_draped_sheet() {
    insta::assert_snapshot!(draped().digest(), @"
    step 200
    particles 256
    springs 1378
    limits 930 in 8 colours
    quads 225
    non-finite 0
    x -143 .. 142 mm
    y -146 .. -9 mm
    z -142 .. 142 mm
    speed 9.54e-1 m/s
    kinetic energy 9.58e-4 J
    elongation 0.050, 4 over-long
    contacts 11
    ");
}
