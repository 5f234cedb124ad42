//! Hierarchical limits hold their thresholds on every scene of the bench `strain`, of which this is the small version.

use glam::Vec3;
use toile::Cloth;
use toile_lab::fixtures::{SCENES, scene, shapes, sheet_model};
use toile_model::StepSettings;
use toile_scene::{Rule, Threshold, VelocityModification};
use toile_workspace::{advance, gpu};

/// Frames until the falling sheet has slapped around its sphere, and the other one is carried along by its own.
const FRAMES: u32 = 40;

/// How far a scene stretched.
#[derive(Debug)]
struct Stretch {
    /// Largest elongation at the end of any frame [1].
    over_run: f32,
    /// Springs above the threshold at the end, as a part of all.
    over_long: f64,
}

fn stretch(name: &str, n: u32, rule: Rule, threshold: f64) -> Stretch {
    let mut scene = scene(name, &[("n", &n.to_string())]);
    scene.settings.velocity_modification = VelocityModification::new(rule);
    scene.settings.fabric.threshold = Threshold::even(threshold);
    let model = sheet_model(&scene);
    let settings = StepSettings::new(&scene.settings, &model);
    assert!(settings.steps_per_frame <= 16 && settings.sweeps <= 4, "{name}");
    let colliders = toile::Colliders::new(None, shapes(&scene));
    let mut cloth = Cloth::new(&gpu().device, &model, &settings, colliders).expect("it fits the device");
    let mut stretch = Stretch { over_run: 0.0, over_long: 0.0 };
    for _ in 0..FRAMES {
        let status = advance(&mut cloth).expect("it stays finite");
        stretch.over_run = stretch.over_run.max(status.elongation_max);
        stretch.over_long = f64::from(status.over_long_count) / model.limits.len() as f64;
    }
    stretch
}

/// What is above the threshold at the end is less than one spring in a hundred, so the 99th percentile is below it.
#[test]
fn every_scene_holds_its_threshold() {
    for name in SCENES {
        for (threshold, bar) in [(0.05, 0.07), (0.01, 0.025)] {
            let held = stretch(name, 32, Rule::Hierarchical, threshold);
            assert!(held.over_run <= bar && held.over_long < 0.01, "{name} at {threshold}: {held:?}");
        }
    }
}

/// The ends of the range that a fabric may ask for.
#[test]
fn the_least_and_the_largest_threshold_are_held() {
    for (threshold, least, bar) in [(0.001, 0.001, 0.006), (0.15, 0.08, 0.15)] {
        for name in ["hang", "ball"] {
            let held = stretch(name, 24, Rule::Hierarchical, threshold);
            assert!(held.over_run >= least && held.over_run <= bar, "{name} at {threshold}: {held:?}");
        }
    }
}

/// The bars would see limits of single springs alone.
#[test]
fn limits_of_single_springs_alone_do_not() {
    for name in ["hang", "ball"] {
        let held = stretch(name, 32, Rule::Predictive, 0.05);
        assert!(held.over_run > 0.07, "{name}: {held:?}");
    }
}

/// Where the middle of the hanging sheet is after half a second, at the lowest point of its swing [m].
fn middle_of_the_swing(overrides: &[(&str, &str)]) -> Vec3 {
    let hang = scene("hang", &[&[("n", "16")], overrides].concat());
    let model = sheet_model(&hang);
    let settings = StepSettings::new(&hang.settings, &model);
    let mut cloth = Cloth::new(&gpu().device, &model, &settings, Default::default()).expect("it fits the device");
    for _ in 0..30 {
        advance(&mut cloth).expect("it stays finite");
    }
    let positions = gpu().vec3s(&cloth.frame().positions);
    positions.iter().sum::<Vec3>() / positions.len() as f32
}

/// Little strain proves nothing in a cloth that is slowed: limits leave the sheet as fast as springs of 200 times the stiffness.
#[test]
fn cloth_that_is_held_swings_like_stiff_cloth() {
    let stiff = [
        ("rule", "none"),
        ("fabric.structural_stiffness", "4000"),
        ("fabric.shear_stiffness", "2000"),
        ("fabric.bend_stiffness", "0.1"),
    ];
    let held = ("fabric.threshold", "0.01");
    let stiff = middle_of_the_swing(&stiff);
    let off = middle_of_the_swing(&[held]).distance(stiff);
    assert!(off < 0.015, "{off} m");
    let off = middle_of_the_swing(&[held, ("fabric.damping", "1")]).distance(stiff);
    assert!(off > 0.08, "a damping of 1/s shows: {off} m");
}
