//! A body that is set elsewhere at once takes its garments along.

use crate::support::{advance, gpu, start, walking};
use glam::{DQuat, DVec3, Vec3};
use std::f64::consts::PI;
use toile::{Simulation, Stage, Teleport};
use toile_lab::motion::carried;
use toile_scene::{Body, RigidKey, Scene};

/// When the body jumps [s].
const JUMP: f64 = 0.155;

/// So long after its start the walk is looked at [s].
const SECONDS: f64 = 0.6;

/// What is seen of a walk.
struct Walked {
    elongation_max: f32,
    /// Of all particles at the end [m].
    positions: Vec<Vec3>,
    teleports: Vec<Teleport>,
}

/// A skirt on the woman who walks on the spot and stands elsewhere from a time on: turned by an angle [rad], so far along x [m], and there
/// after some seconds.
fn scene(distance: f64, angle: f64, seconds: f64) -> Scene {
    let mut scene = walking(&["skirt"], "walk_loop");
    let Body::Moving(woman) = &mut scene.bodies[0] else { panic!("she moves") };
    let here = RigidKey { time: 0.0, translation: DVec3::ZERO, rotation: DQuat::IDENTITY };
    let there = RigidKey { translation: DVec3::X * distance, rotation: DQuat::from_rotation_y(angle), ..here };
    let at = |time, key| RigidKey { time, ..key };
    *woman = carried(woman, &[here, at(JUMP, here), at(JUMP + seconds, there), at(SECONDS + 1.0, there)]);
    scene
}

/// The state of the skirt at the start of the walk: that of all of them, because they begin alike.
fn dressed() -> Vec<u8> {
    let mut simulation = start(&scene(0.0, 0.0, 0.0));
    while simulation.stage().expect("she can be dressed") != Stage::Running {
        advance(&mut simulation, 1.0 / 60.0);
    }
    simulation.save(&gpu().queue).expect("a device")
}

fn walked(dressed: &[u8], distance: f64, angle: f64, seconds: f64) -> Walked {
    let mut simulation = start(&scene(distance, angle, seconds));
    simulation.restore(&gpu().queue, dressed).expect("the same skirt");
    let mut walked = Walked { elongation_max: 0.0, positions: Vec::new(), teleports: Vec::new() };
    while simulation.time() < SECONDS {
        advance(&mut simulation, 1.0 / 60.0);
        let strain = skirt(&simulation).strain().expect("it stays finite").expect("it is told");
        walked.elongation_max = walked.elongation_max.max(strain.elongation_max);
    }
    walked.positions = gpu().vec3s(&skirt(&simulation).frame().positions);
    walked.teleports = simulation.teleports().to_vec();
    walked
}

fn skirt(simulation: &Simulation) -> &toile::Cloth {
    simulation.cloths().next().expect("the skirt").cloth
}

/// How far the particles are at most from those of a walk without the jump, taken back [m].
fn apart(jumped: &Walked, still: &Walked, distance: f32, angle: f32) -> f32 {
    let back = glam::Quat::from_rotation_y(-angle);
    let pairs = jumped.positions.iter().zip(&still.positions);
    pairs.map(|(there, here)| (back * (there - Vec3::X * distance)).distance(*here)).fold(0.0, f32::max)
}

#[test]
fn a_body_that_jumps_takes_its_garments_along() {
    let dressed = dressed();
    let still = walked(&dressed, 0.0, 0.0, 0.0);
    assert!(still.teleports.is_empty() && still.elongation_max < 0.12, "{} without a jump", still.elongation_max);
    // Places at 40 m are told to 4 µm, and cloth that moves spreads that as it spreads any other nudge.
    let nudge = 4e-6;
    let spread = apart(&walked(&dressed, nudge, 0.0, 0.0), &still, nudge as f32, 0.0);
    assert!(spread < 0.05, "{spread} m apart after {nudge} m");
    for (distance, angle, seconds) in [(2.0, 0.0, 0.0), (0.0, PI, 0.0), (40.0, 1.0, 1.0 / 24.0)] {
        let jumped = walked(&dressed, distance, angle, seconds);
        let [told] = jumped.teleports[..] else { panic!("one jump: {:?}", jumped.teleports) };
        // Of a jump between two keys the parts of an interval at its ends are slow enough for the cloth.
        assert!((told.distance - distance).abs() < 0.45 && (told.angle - angle).abs() < 0.45, "{told:?}");
        assert!((told.time - JUMP).abs() < 1.0 / 30.0, "{told:?}");
        let elongation = jumped.elongation_max;
        assert!(elongation < still.elongation_max + 0.02, "{elongation} after {distance} m and {angle} rad");
        let apart = apart(&jumped, &still, distance as f32, angle as f32);
        assert!(apart < 2.0 * spread, "{apart} m apart after {distance} m and {angle} rad");
    }
    // A short one is left to the cloth, which recovers.
    let short = walked(&dressed, 0.3, 0.0, 0.0);
    assert_eq!(short.teleports, []);
    let apart = apart(&short, &still, 0.3, 0.0);
    assert!(apart < 0.2, "{apart} m apart after 0.3 m");
}
