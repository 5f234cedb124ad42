//! What is lost without a term of the model.

use crate::lab;
use toile_report::experiments::terms::{Term, Trial, outcome};

/// The number that a term is there for, with it and without.
fn measures(term: Term) -> [f64; 2] {
    [term.with(), term.without()]
        .map(|trial: Trial| term.measure(&outcome(&lab(), trial, 9, 15).expect("the device answers")))
}

#[test]
fn midpoints_keep_the_middle_of_the_quads_out_of_the_body() {
    let [with, without] = measures(Term::QuadMidpoints);
    // A chord of one cell, 12.5 cm, of a sphere of 0.255 m lies 7.7 mm below it along each of two directions.
    assert!(with < 1.0 && without > 3.0, "{with} mm and {without} mm");
}

#[test]
fn velocities_in_the_maps_carry_the_cloth_along() {
    let [with, without] = measures(Term::VelocityMap);
    assert!(with < 0.8 * without, "{with} mm and {without} mm behind");
}

#[test]
fn levels_hold_what_single_limits_do_not() {
    let [with, without] = measures(Term::Levels);
    assert!(with < 5.0 && without > with, "{with} % and {without} %");
}
