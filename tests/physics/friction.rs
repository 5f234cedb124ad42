//! Coulomb's friction angle on a tilted plate: cloth sticks below atan(μ) and slides above, through the maps.

use glam::{DQuat, DVec2, DVec3, Vec3};
use toile::{Colliders, Simulation};
use toile_model::{Model, StepSettings};
use toile_scene::{Friction, Mesh, Settings, Sheet};
use toile_workspace::{Layers, advance, box_mesh, gpu, sheet_settings};

/// μ of the cloth on the plate: atan(0.5) is 26.6°.
const FRICTION: f64 = 0.5;

const SECONDS: f64 = 0.6;

/// A plate whose upper side falls towards the front camera by `degrees`.
fn plate(degrees: f64) -> (Mesh, DQuat) {
    let tilt = DQuat::from_rotation_x(degrees.to_radians());
    let mut mesh = box_mesh(Vec3::new(-0.5, -0.3, -1.0), Vec3::new(0.5, 0.0, 1.0));
    for vector in mesh.positions.iter_mut().chain(&mut mesh.normals) {
        *vector = (tilt * vector.as_dvec3()).as_vec3();
    }
    (mesh, tilt)
}

/// How far a sheet on the plate slides downhill [m], the mean of its particles; and how far any of them leaves the plate [m].
fn slide(degrees: f64, friction: Friction) -> [f64; 2] {
    let mut settings: Settings = sheet_settings();
    settings.fabric.friction = FRICTION;
    settings.fabric.damping = 0.0;
    settings.friction = friction;
    let thickness = settings.fabric.thickness;
    let (mesh, tilt) = plate(degrees);
    let [right, uphill, normal] = [DVec3::X, tilt * DVec3::NEG_Z, tilt * DVec3::Y];
    let sheet = Sheet {
        name: "sheet".to_owned(),
        columns: 9,
        rows: 9,
        size: DVec2::splat(0.24),
        corner: normal * thickness - right * 0.12,
        right,
        down: uphill,
        pins: Vec::new(),
    };
    let model = Model::from_sheet(&sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    let layers = Layers::draw(gpu(), &[(&mesh, thickness as f32)], settings.texel as f32).expect("the device answers");
    let colliders = Colliders { maps: Some(layers.maps.clone()), sphere: None };
    let mut simulation = Simulation::new(&gpu().device, &model, &step, colliders).expect("it fits the device");
    for _ in 0..(SECONDS * settings.frame_rate).round() as u32 {
        advance(&mut simulation).expect("it stays finite");
    }
    let ways: Vec<DVec3> = gpu()
        .vec3s(&simulation.frame().positions)
        .iter()
        .zip(&model.positions)
        .map(|(position, start)| position.as_dvec3() - start.as_dvec3())
        .collect();
    let slid = ways.iter().map(|way| -way.dot(uphill)).sum::<f64>() / ways.len() as f64;
    [slid, ways.iter().map(|way| way.dot(normal).abs()).fold(0.0, f64::max)]
}

/// Way [m] of a point that slides with Coulomb friction.
fn sliding(degrees: f64) -> f64 {
    let angle = degrees.to_radians();
    0.5 * 9.81 * (angle.sin() - FRICTION * angle.cos()) * SECONDS * SECONDS
}

#[test]
fn cloth_sticks_below_the_friction_angle() {
    for degrees in [10.0, 20.0, 25.0] {
        let [way, off] = slide(degrees, Friction::Coulomb);
        assert!(way.abs() < 1e-3 && off < 1e-3, "{degrees}°: it slid {way} m and left the plate by {off} m");
    }
}

#[test]
fn cloth_slides_above_the_friction_angle() {
    for degrees in [29.0, 35.0, 45.0] {
        let [way, off] = slide(degrees, Friction::Coulomb);
        let expected = sliding(degrees);
        assert!((way / expected - 1.0).abs() < 0.05, "{degrees}°: it slid {way} m, not {expected} m");
        assert!(off < 1e-3, "{degrees}°: it left the plate by {off} m");
    }
}

/// The papers' law brakes but never holds: it creeps where Coulomb's sticks.
#[test]
fn the_papers_law_creeps() {
    let [way, _] = slide(20.0, Friction::Papers { velocity_kept: 0.8, force_removed: 0.5 });
    assert!(way > 1e-3, "it slid {way} m");
}
