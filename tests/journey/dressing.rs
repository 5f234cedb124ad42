//! From garments and a body to a walk, without waiting.

use crate::support::{advance, gpu, standing, start, walking, woman};
use std::collections::VecDeque;
use toile::{Error, Simulation, Stage};
use toile_model::{Finding, Fit, FitOptions, Flaw, Solid, crossed_particles};
use toile_scene::Scene;

/// Frames that a host has under way, as a swap chain has.
const FRAMES_UNDER_WAY: usize = 2;

/// Goes on until a stage, as a host that draws: it waits for frames of the past, never for the one that it submits. The stages on the way.
fn drive(simulation: &mut Simulation, until: Stage) -> Vec<Stage> {
    let mut stages = Vec::new();
    let mut under_way = VecDeque::new();
    for _ in 0..2000 {
        let stage = simulation.stage().unwrap_or_else(|error| panic!("{error}"));
        if stages.last() != Some(&stage) {
            stages.push(stage);
        }
        if stage == until {
            return stages;
        }
        let mut encoder = gpu().device.create_command_encoder(&Default::default());
        simulation.advance(&mut encoder, 1.0 / 60.0).unwrap_or_else(|error| panic!("{error}"));
        under_way.push_back(gpu().queue.submit([encoder.finish()]));
        if under_way.len() > FRAMES_UNDER_WAY {
            let wait = wgpu::PollType::Wait { submission_index: under_way.pop_front(), timeout: None };
            gpu().device.poll(wait).expect("the device answers");
        }
    }
    panic!("{until:?} does not come after {stages:?}");
}

#[test]
fn a_striding_woman_is_dressed_and_walks() {
    let mut simulation = start(&walking(&["skirt"], "walk_loop"));
    let stages = drive(&mut simulation, Stage::Running);
    // In her first pose a leg stands before its panel: she is dressed without the clip and goes over to it.
    let all = [Stage::Sewing, Stage::Easing, Stage::Draping, Stage::Dressed, Stage::Posing, Stage::Running];
    assert_eq!(stages, all);
    for _ in 0..12 {
        let mut encoder = gpu().device.create_command_encoder(&Default::default());
        simulation.advance(&mut encoder, 1.0 / 60.0).unwrap_or_else(|error| panic!("{error}"));
        gpu().queue.submit([encoder.finish()]);
    }
    let worn = simulation.cloths().next().expect("the skirt");
    assert_eq!(worn.name, "skirt");
    let heights: Vec<f32> = gpu().vec3s(&worn.cloth.frame().positions).iter().map(|p| p.y).collect();
    let (low, high) = heights.iter().fold((f32::INFINITY, 0.0f32), |(low, high), y| (low.min(*y), high.max(*y)));
    assert!(0.3 < low && 0.85 < high && high < 1.2, "from {low} to {high} m it hangs from her waist");
    assert!((simulation.time() - 0.2).abs() < 0.02, "{} s of the walk", simulation.time());
    assert!(simulation.bodies().next().is_some_and(|body| body.index_count > 10_000), "a host can draw her");
}

/// Side seams of a circle skirt close where the hands of who stands with hanging arms are.
#[test]
fn a_mesh_at_rest_is_dressed_with_level_arms_and_lowers_them() {
    let (scene, mesh) = standing("circle_skirt", 1.0);
    let mut simulation = start(&scene);
    assert!(matches!(simulation.findings(), [Finding::RaisedArms { .. }]), "{:?}", simulation.findings());
    drive(&mut simulation, Stage::Dressed);
    assert_eq!(most_limbs(&simulation), 2, "her legs");
    assert_eq!(drive(&mut simulation, Stage::Running), [Stage::Dressed, Stage::Posing, Stage::Running]);
    advance(&mut simulation, 0.5);
    let worn = simulation.cloths().next().expect("the skirt");
    let positions = gpu().vec3s(&worn.cloth.frame().positions);
    let (crossed, depth) = crossed_particles(worn.model, &positions, &Solid::of([&mesh]));
    assert!(crossed.is_empty(), "{crossed:?} up to {depth} m");
    let top = positions.iter().map(|p| p.y).fold(0.0, f32::max);
    assert!(0.85 < top && top < 1.15, "{top} m: it hangs from her waist");
    let mut simulation = Simulation::fitted(&gpu().device, &as_she_stands(&scene)).expect("it can be sewn");
    drive(&mut simulation, Stage::Dressed);
    assert_eq!(most_limbs(&simulation), 4, "her legs and her hands");
}

/// How many limbs go through the widest opening of the first garment.
fn most_limbs(simulation: &Simulation) -> u32 {
    let verdicts = simulation.verdicts(&gpu().queue).expect("a device");
    verdicts[0].openings.iter().map(|opening| opening.limb_count).max().expect("it has openings")
}

/// What was found without the pose that was found for it.
fn as_she_stands(scene: &Scene) -> Fit {
    let mut fit = Fit::new(scene, &FitOptions::default()).expect("it can be dressed");
    fit.dress_in = None;
    fit
}

#[test]
fn a_body_that_stands_clear_is_dressed_as_it_begins() {
    let mut simulation = start(&walking(&["skirt"], "apose_to_walk"));
    let stages = drive(&mut simulation, Stage::Running);
    assert_eq!(stages, [Stage::Sewing, Stage::Easing, Stage::Draping, Stage::Dressed, Stage::Running]);
}

#[test]
fn a_body_is_dressed_in_the_clip_that_is_named_or_not_at_all() {
    let scene = walking(&["skirt"], "walk_loop");
    let named = Simulation::dressed_in(&gpu().device, &scene, &woman("apose_to_walk"));
    assert_eq!(named.expect("a clip of the same body").stage().expect("nothing ran yet"), Stage::Sewing);
    let ball = crate::support::rolling(1);
    let toile_scene::Body::Moving(other) = &ball.bodies[0] else { panic!("it rolls") };
    let error = Simulation::dressed_in(&gpu().device, &scene, other).expect_err("a ball is no woman");
    assert!(matches!(error, Error::Pose), "{error}");
    let error = Simulation::dressed_in(&gpu().device, &toile_lab::fixtures::scene("hang", &[]), other);
    assert!(error.is_err(), "nobody moves");
}

/// The frame rate of a scene decides its steps and how often its maps are drawn, not where the cloth ends.
#[test]
fn a_walk_ends_in_the_same_drape_at_any_frame_rate() {
    let ends = [30.0, 60.0, 120.0].map(|rate| {
        let mut scene = walking(&["skirt"], "apose_to_walk");
        scene.settings.frame_rate = rate;
        scene.settings.texel = 0.01;
        let mut simulation = start(&scene);
        while simulation.stage().expect("it can be dressed") != Stage::Dressed {
            advance(&mut simulation, 1.0 / rate);
        }
        for _ in 0..(0.2 * rate) as u32 {
            advance(&mut simulation, 1.0 / rate);
        }
        gpu().vec3s(&simulation.cloths().next().expect("the skirt").cloth.frame().positions)
    });
    for (one, other) in [(0, 1), (0, 2), (1, 2)] {
        let distances: Vec<f32> = ends[one].iter().zip(&ends[other]).map(|(a, b)| a.distance(*b)).collect();
        let mean = distances.iter().sum::<f32>() / distances.len() as f32;
        let most = distances.iter().copied().fold(0.0, f32::max);
        assert!(mean > 0.0 && mean < 0.006 && most < 0.015, "{mean} m apart on average, at most {most} m");
    }
}

/// A garment that cannot be sewn is no error: the seam is named, nothing is merged across the gap, and everything goes on.
#[test]
fn a_garment_whose_seams_stay_open_is_told_and_goes_on() {
    let mut scene = walking(&["skirt"], "apose_to_walk");
    let toile_scene::Cloth::Garment(skirt) = &mut scene.cloths[0] else { panic!("a garment") };
    // Panels ten kilometres apart do not meet in the time that they have.
    skirt.panels[0].placement.translation.z += 10_000.0;
    let mut simulation = start(&scene);
    drive(&mut simulation, Stage::Dressed);
    let verdicts = simulation.verdicts(&gpu().queue).expect("a device");
    let [verdict] = verdicts.as_slice() else { panic!("{verdicts:?}") };
    let Some(Flaw::SeamOpen { seam, gap }) = verdict.findings.first() else { panic!("{verdict:?}") };
    assert!(seam.contains(" to ") && *gap > 0.1, "{seam}: {gap} m");
    assert!(!verdict.is_worn() && verdict.openings.is_empty(), "{verdict:?}");
    let saved = simulation.save(&gpu().queue).expect("a device");
    let mut restored = start(&scene);
    restored.restore(&gpu().queue, &saved).expect("its own state");
    for mut simulation in [simulation, restored] {
        assert_eq!(drive(&mut simulation, Stage::Running), [Stage::Dressed, Stage::Running]);
        let worn = simulation.cloths().next().expect("the panels");
        assert!(!worn.model.seam_pairs.is_empty(), "its seams are not merged");
    }
}
