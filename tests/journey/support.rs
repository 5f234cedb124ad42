//! Scenes that run, and a host that drives them.

use glam::{DQuat, DVec3, Vec3};
use toile::files::{BodyOptions, read_moving_body};
use toile::{Advance, Simulation};
use toile_lab::fixtures::{fixture, garment, scene, settings};
use toile_scene::{Body, Cloth, Mesh, MovingMesh, RigidKey, Scene};
pub use toile_workspace::own_gpu as gpu;

/// Edge length of a texel of the maps [m]: these tests ask what happens, not how exactly.
const TEXEL: f64 = 0.02;

/// Garments at 6 cm on the built-in woman, who walks by a clip.
pub fn walking(garments: &[&str], clip: &str) -> Scene {
    let mut settings = settings(0.06);
    settings.texel = TEXEL;
    let mut scene = Scene::new("walk", settings);
    scene.cloths = garments.iter().map(|name| Cloth::Garment(garment(name))).collect();
    scene.bodies = vec![Body::Moving(woman(clip))];
    scene
}

/// A garment at 6 cm on the built-in woman who stands still, her size across times `girth` [1].
pub fn standing(garment: &str, girth: f32) -> (Scene, Mesh) {
    let mut scene = walking(&[garment], "apose_to_walk");
    let Body::Moving(moving) = &scene.bodies[0] else { panic!("she walks") };
    let mut mesh = moving.mesh.clone();
    mesh.positions.iter_mut().for_each(|p| *p *= glam::vec3(girth, 1.0, girth));
    scene.bodies = vec![Body::Mesh(mesh.clone())];
    (scene, mesh)
}

/// The built-in woman with a clip.
pub fn woman(clip: &str) -> MovingMesh {
    let mut options = BodyOptions::default();
    options.clip = Some(clip.to_owned());
    let path = fixture("bodies/walking_woman.glb");
    read_moving_body(&path, &options).unwrap_or_else(|error| panic!("{error}")).body
}

/// Sheets of 16 × 16 particles, one over the other, that fall on a ball which rolls along x at 1 m/s.
pub fn rolling(sheet_count: usize) -> Scene {
    let mut ball = scene("ball", &[("n", "16"), ("sheet.0.corner", "[-0.5, 0.256, 0.5]")]);
    let Cloth::Sheet(sheet) = ball.cloths.remove(0) else { panic!("it has a sheet") };
    for index in 0..sheet_count {
        let mut sheet = sheet.clone();
        sheet.name = format!("sheet {index}");
        sheet.corner += DVec3::Y * 0.02 * index as f64;
        ball.cloths.push(Cloth::Sheet(sheet));
    }
    let key = |time: f64| RigidKey {
        time,
        translation: DVec3::new(time, 0.1 * time, 0.0),
        rotation: DQuat::from_rotation_z(-2.0 * time),
    };
    let moving = MovingMesh::rigid(Mesh::sphere(Vec3::ZERO, 0.25, 48), vec![key(0.0), key(0.5), key(1.0)]);
    ball.bodies = vec![Body::Moving(moving)];
    ball.settings.texel = TEXEL;
    ball
}

/// A scene at its start.
pub fn start(scene: &Scene) -> Simulation {
    Simulation::new(&gpu().device, scene).unwrap_or_else(|error| panic!("{error}"))
}

/// Goes on by some seconds and waits, also for what the cloths report.
pub fn advance(simulation: &mut Simulation, seconds: f64) -> Advance {
    let mut advance = Advance::default();
    gpu().run(|encoder| advance = simulation.advance(encoder, seconds).unwrap_or_else(|error| panic!("{error}")));
    // Nothing is told of a cloth at its start; what is wrong is told by the next call.
    let is_told = |cloth: &toile::Cloth| match cloth.status() {
        Ok(told) => told.map_or(0, |status| status.step) == cloth.step(),
        Err(_) => true,
    };
    assert!(simulation.cloths().all(|worn| is_told(worn.cloth)), "the device is done, and a status is missing");
    advance
}

/// Words of the positions of all cloths.
pub fn positions(simulation: &Simulation) -> Vec<Vec<u32>> {
    simulation.cloths().map(|worn| gpu().words(&worn.cloth.frame().positions)).collect()
}
