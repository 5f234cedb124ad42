//! Errors against cost: limits, step, spacing, size.

use crate::lab;
use std::time::Duration;
use toile_lab::StepCost;
use toile_report::experiments::cost::{fitted_exponent, step_cost};
use toile_report::experiments::precision::{Limited, Limiting, Scene, limited, rest_error, shape_errors};
use toile_report::experiments::rest::RestScene;
use toile_report::experiments::speed::{self, size_at};
use toile_scene::Rule;

fn swing_down(rule: Rule, sweeps: u32) -> Limited {
    limited(&lab(), Limiting { rule, sweeps, step_division: 1, n: 9 }, 30).expect("the device answers")
}

/// The threshold is 5 %; limits aim below it. Springs alone are stretched several times as far.
#[test]
fn hierarchical_limits_hold_the_threshold_and_springs_alone_do_not() {
    let held = swing_down(Rule::Hierarchical, 4);
    assert!(held.elongation_max < 0.05 && held.elongation_p99 <= held.elongation_max, "{held:?}");
    let free = swing_down(Rule::None, 1);
    assert!(free.elongation_max > 0.15, "{free:?}");
}

/// Symplectic Euler has order 1: half the step, half the error. Its terms of higher order are small here, and f32 rounds to less
/// than a hundredth of the error; limits that do not act must not change anything.
#[test]
fn a_swing_converges_with_order_one_under_any_rule() {
    let exact = Scene::Swing.exact();
    let error = |rule, steps| Scene::Swing.error(&lab(), rule, steps, &exact).expect("the device answers").rms;
    let [rough, fine] = [16, 32].map(|steps| error(Rule::None, steps));
    assert!(rough < 2e-4, "{rough} m");
    assert!((1.8..2.4).contains(&(rough / fine)), "{rough} m and {fine} m");
    for rule in [Rule::Average, Rule::Predictive] {
        let limited = error(rule, 16);
        assert!((limited / rough - 1.0).abs() < 0.01, "{rule:?}: {limited} m, not {rough} m");
    }
}

/// A free fall over t in steps of dt is ahead by ½·g·t·dt, less what the damping of 0.1 /s takes of it.
#[test]
fn a_fall_has_the_error_that_theory_gives() {
    let exact = Scene::Fall.exact();
    let error = Scene::Fall.error(&lab(), Rule::None, 16, &exact).expect("the device answers");
    let theory = 0.5 * 9.81 * 0.5 / 960.0;
    assert!((error.rms / theory - 1.0).abs() < 0.05, "{error:?}, not {theory} m");
    assert!(error.max < 1.01 * error.rms, "it falls as a whole: {error:?}");
}

/// A sheet of 1 m whose limits all act: what hierarchical sweeps leave is a small part of the threshold, which is 10 mm over its
/// height. One predictive sweep reaches one cell and leaves more.
#[test]
fn limits_that_act_leave_the_sheet_where_exact_ones_would() {
    let error = |rule, sweeps| rest_error(&lab(), rule, sweeps).expect("the device answers").max;
    let hierarchical = error(Rule::Hierarchical, 4);
    assert!(hierarchical < 3e-4, "{hierarchical} m");
    let predictive = error(Rule::Predictive, 1);
    assert!(predictive > 1.5 * hierarchical, "{predictive} m and {hierarchical} m");
}

/// The membrane is one of second order; the bend springs, which weaken with the spacing, leave room below and above.
#[test]
fn a_hammock_converges_as_its_mesh_is_refined() {
    let errors = shape_errors(&mut lab(), RestScene::Hammock, &[3, 5, 9], [0.0, 1.0]).expect("the device answers");
    let order = (errors[0].rms / errors[1].rms).log2();
    assert!((1.5..3.0).contains(&order) && errors[1].rms < 5e-3, "order {order}: {errors:?}");
}

#[test]
fn a_power_law_is_found_again() {
    let points: Vec<[f64; 2]> = [1.0, 10.0, 700.0].map(|x: f64| [x, 3.0 * x.powf(0.9)]).to_vec();
    assert!(fitted_exponent(&points).is_some_and(|p| (p - 0.9).abs() < 1e-12));
    assert_eq!(fitted_exponent(&points[..1]), None);
    assert_eq!(fitted_exponent(&[[1.0, 0.0], [2.0, 0.0]]), None, "what has no logarithm says nothing");
}

#[test]
fn a_cost_is_counted_in_copies_that_the_clock_can_see() {
    let cost = StepCost { kernels: vec![("euler", 1, 0.5), ("limit_level", 16, 2.5)], state_copy: 0.25 };
    assert_eq!(cost.copies(), Some(12.0));
    let coarse = StepCost { state_copy: 0.0, ..cost.clone() };
    assert_eq!(coarse.copies(), None, "nothing is divided by zero");
    let unseen = StepCost { kernels: vec![("euler", 1, 0.0)], ..cost };
    assert_eq!(unseen.copies(), None, "a step that the clock does not see is not free");
}

#[test]
fn a_size_is_found_between_two_that_were_measured() {
    let points = [[32.0, 4.0], [64.0, 16.0], [128.0, 128.0]];
    assert!((size_at(&points, 8.0).expect("between the first two") - 32.0 * 2.0_f64.sqrt()).abs() < 1e-9);
    assert_eq!(size_at(&points, 16.0), Some(64.0));
    assert_eq!([size_at(&points, 3.9), size_at(&points, 128.0), size_at(&points[..1], 4.0)], [None; 3]);
}

/// Cost and strain of a frame come from one run; where the time is over there is no strain, and never a zero in its place.
#[test]
fn speed_is_told_beside_strain() {
    for name in speed::SCENES {
        let speed = speed::measure(&lab(), name, 16, 30, Duration::from_secs(600)).expect("a device");
        let [largest, p99] = speed.strain.expect("there was time");
        assert!(p99 > 0.001 && p99 <= largest && largest < 0.08, "{name}: {speed:?}");
        assert!(speed.frame > 0.0 && speed.kernels != Some(0.0), "{name}: {speed:?}");
        assert!(speed.dispatches > u64::from(speed.steps) * 5 && speed.particle_count() == 256, "{name}: {speed:?}");
        let least = speed.dispatches as f64 * speed::DISPATCH * 1e3;
        assert!(speed.on_paper(1e12) > least && speed.on_paper(4e12) < speed.on_paper(1e12), "{name}: {speed:?}");
        let hurried = speed::measure(&lab(), name, 16, 30, Duration::ZERO).expect("a device");
        assert_eq!((hurried.strain, hurried.bytes), (None, speed.bytes), "{name}");
    }
}

#[test]
fn the_cost_of_a_step_names_its_kernels() {
    let cost = step_cost(&lab(), Rule::Hierarchical, 9, 2).expect("the device answers");
    let dispatches =
        |name| cost.kernels.iter().find(|(kernel, ..)| *kernel == name).map(|(_, dispatches, _)| *dispatches);
    assert_eq!(dispatches("euler"), Some(1), "{cost:?}");
}
