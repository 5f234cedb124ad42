//! A polish sweeps further where the sweeps of a step leave springs above its target, and says where that was not enough.

use glam::Vec3;
use toile::Cloth;
use toile_lab::Random;
use toile_lab::fixtures::{scene, shapes, sheet_model};
use toile_model::{Arrays, Model, Status, StepSettings};
use toile_scene::{Polish, Settings, Shape};
use toile_workspace::{advance, gpu};

/// How a scene went.
struct Run {
    /// At the end.
    positions: Vec<Vec3>,
    /// At the end.
    status: Status,
    /// At the end of any frame.
    elongation_max: f32,
    steps: u32,
}

fn run(model: &Model, settings: &Settings, polish: Option<Polish>, shapes: Vec<Shape>, frames: u32) -> Run {
    let mut settings = StepSettings::new(settings, model);
    settings.polish = polish;
    let colliders = toile::Colliders::new(None, shapes);
    let mut cloth = Cloth::new(&gpu().device, model, &settings, colliders).expect("it fits the device");
    let mut elongation_max: f32 = 0.0;
    let mut status = Status::default();
    for _ in 0..frames {
        status = advance(&mut cloth).expect("it stays finite");
        elongation_max = elongation_max.max(status.elongation_max);
    }
    let strain = cloth.strain().expect("it stays finite").expect("a frame is done");
    assert_eq!([strain.further_sweeps, strain.missed_steps], [status.further_sweeps, status.missed_steps]);
    let positions = gpu().vec3s(&cloth.frame().positions);
    Run { positions, status, elongation_max, steps: frames * settings.steps_per_frame }
}

#[test]
fn a_polish_holds_a_target_that_the_sweeps_of_a_step_do_not() {
    // Lower than the fixture has it, so that it touches within few frames.
    let lower = ("sheet.0.corner", "[-0.5, 0.256, 0.5]");
    let ball = scene("ball", &[("n", "32"), ("fabric.threshold", "0.01"), ("sweeps", "1"), lower]);
    let model = sheet_model(&ball);
    let target = 0.0075;
    let [without, with] = [None, Some(Polish { target, sweeps: 16 })]
        .map(|polish| run(&model, &ball.settings, polish, shapes(&ball), 10));
    assert!(f64::from(without.elongation_max) > 1.2 * target, "{}", without.elongation_max);
    assert_eq!([without.status.further_sweeps, without.status.missed_steps], [0, 0]);
    // The move rounds what was measured before it.
    assert!(f64::from(with.elongation_max) < target + 1e-6, "{}", with.elongation_max);
    assert_eq!(with.status.missed_steps, 0);
    // Only while needed: the sheet touches late, and then one sweep more is often enough.
    assert!((1..2 * with.steps).contains(&with.status.further_sweeps), "{}", with.status.further_sweeps);
}

#[test]
fn a_step_that_holds_the_target_moves_as_without_a_polish() {
    let hang = scene("hang", &[("n", "24")]);
    let model = sheet_model(&hang);
    let polish = Some(Polish { target: 0.06, sweeps: 4 });
    let [without, with] = [None, polish].map(|polish| run(&model, &hang.settings, polish, Vec::new(), 15));
    assert!(with.elongation_max > 0.03, "its limits act: {}", with.elongation_max);
    assert_eq!([with.status.further_sweeps, with.status.missed_steps], [0, 0]);
    assert_eq!(with.positions, without.positions);
}

#[test]
fn a_target_that_cannot_be_held_is_missed_in_bounded_work() {
    let hang = scene("hang", &[("n", "16")]);
    let model = sheet_model(&hang);
    let pin = (0..model.positions.len()).rfind(|i| model.inverse_masses[*i] == 0.0).expect("two pins");
    let model = model.changed(|model| model.positions[pin].x += 0.2).expect("a pin elsewhere");
    let Run { status, steps, .. } =
        run(&model, &hang.settings, Some(Polish { target: 0.06, sweeps: 3 }), Vec::new(), 3);
    assert_eq!([status.further_sweeps, status.missed_steps], [3 * steps, steps]);
}

#[test]
fn a_polish_keeps_the_momentum() {
    let ball = scene("ball", &[("n", "24"), ("gravity", "[0, 0, 0]"), ("sweeps", "1")]);
    let random = &mut Random::new(1);
    let crumple = |model: &mut Arrays| model.positions.iter_mut().for_each(|position| *position += random.vector(0.01));
    let model = sheet_model(&ball).changed(crumple).expect("particles elsewhere");
    let polish = Some(Polish { target: 0.031, sweeps: 8 });
    let mut settings = StepSettings::new(&ball.settings, &model);
    settings.polish = polish;
    let mut cloth = Cloth::new(&gpu().device, &model, &settings, Default::default()).expect("it fits");
    let status = advance(&mut cloth).expect("it stays finite");
    assert!(status.further_sweeps > 0, "{status:?}");
    let velocities = gpu().vec3s(cloth.velocities());
    let weighed = || velocities.iter().zip(&model.masses).map(|(v, mass)| v.as_dvec3() * f64::from(*mass));
    let momentum: glam::DVec3 = weighed().sum();
    let sum_of_sizes: f64 = weighed().map(glam::DVec3::length).sum();
    assert!(momentum.length() < 1e-6 * sum_of_sizes, "{momentum} of {sum_of_sizes}");
}
