//! Body, maps and cloths go together at any rate of the host.

use crate::support::{advance, gpu, positions, rolling, start, walking};
use toile_scene::Scene;

/// So long the cloth falls on the ball and is taken along [s].
const SECONDS: f64 = 0.15;

/// Positions after this time in calls of these seconds.
fn after_seconds(scene: &Scene, seconds: impl Fn(u32) -> f64) -> Vec<Vec<u32>> {
    let mut simulation = start(scene);
    let (mut asked, mut index) = (0.0, 0);
    while asked < SECONDS - 1e-9 {
        let next = seconds(index).min(SECONDS - asked);
        assert_eq!(advance(&mut simulation, next).dropped_seconds, 0.0);
        asked += next;
        index += 1;
    }
    assert!((simulation.time() - SECONDS).abs() < 1e-6, "{} s are simulated", simulation.time());
    positions(&simulation)
}

#[test]
fn the_same_motion_at_every_rate() {
    for sheet_count in [1, 2] {
        let scene = rolling(sheet_count);
        let at_60 = after_seconds(&scene, |_| 1.0 / 60.0);
        assert_eq!(at_60.len(), sheet_count);
        for rate in [24.0, 30.0, 144.0] {
            assert!(after_seconds(&scene, |_| 1.0 / rate) == at_60, "{sheet_count} sheets at {rate} calls per second");
        }
        let irregular = after_seconds(&scene, |index| [0.003, 0.0171, 0.0, 0.09, 0.0005][index as usize % 5]);
        assert!(irregular == at_60, "{sheet_count} sheets at irregular times");
    }
}

#[test]
fn the_body_goes_with_the_cloth() {
    let mut simulation = start(&rolling(1));
    for call in 1..=50 {
        advance(&mut simulation, 1.0 / 144.0);
        let lag = simulation.body_time() - simulation.time();
        assert!((0.0..=1.0 / 60.0 + 1e-9).contains(&lag), "call {call}: the maps show the body {lag} s ahead");
    }
    assert!((simulation.time() - 50.0 / 144.0).abs() < 1.0 / 960.0);
}

/// A host that draws faster than the maps are drawn sees cloth in the light before its first step.
#[test]
fn cloth_has_normals_before_its_first_step() {
    let mut simulation = start(&rolling(2));
    gpu().run(|encoder| {
        let advance = simulation.advance(encoder, 1e-4).expect("it is finite");
        assert_eq!(advance.step_count, 0);
    });
    for worn in simulation.cloths() {
        let normals = gpu().vec3s(&worn.cloth.frame().normals);
        assert!(normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-5), "{}: {}", worn.name, normals[0]);
    }
}

#[test]
fn calls_say_what_they_did() {
    let mut simulation = start(&rolling(1));
    assert_eq!(advance(&mut simulation, 1.0 / 60.0).step_count, 16);
    let part = advance(&mut simulation, 1.0 / 1920.0);
    assert_eq!(part.step_count, 0, "half a step has passed");
    assert!((part.fraction - 0.5).abs() < 1e-6, "{part:?}");
    assert_eq!(advance(&mut simulation, 1.0 / 1920.0).step_count, 1);
    let late = advance(&mut simulation, 3.0);
    assert_eq!((late.step_count, late.dropped_seconds), (240, 2.75), "a host that falls behind loses time");
    let status = simulation.cloths().next().expect("a sheet").cloth.status().expect("it is finite");
    assert_eq!(status.map(|status| status.step), Some(257));
}

#[test]
fn frames_are_dressed_at_every_rate() {
    let scene = walking(&["skirt"], "apose_to_walk");
    let mut simulation = start(&scene);
    let mut steps = 0;
    for _ in 0..12 {
        steps += advance(&mut simulation, 1.0 / 144.0).step_count;
    }
    let per_frame = simulation.cloths().next().expect("the skirt").cloth.settings().steps_per_frame;
    assert_eq!(steps, 5 * per_frame, "12/144 s are five frames of 1/60 s");
}
