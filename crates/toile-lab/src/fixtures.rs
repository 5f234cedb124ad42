//! The fixtures, read as the program reads them.

use std::path::PathBuf;
use toile::files::{BodyOptions, read_body, read_garment, read_moving_body, read_scene};
use toile::glam::Vec3;
use toile::model::{Arrays, Model};
use toile::scene::{Body, Cloth, Fabric, Garment, Mesh, MovingMesh, Scene, Settings, Shape};

/// Names of the scenes in `fixtures/scenes`.
pub const SCENES: [&str; 3] = ["hang", "ball", "moving-ball"];

/// Names of the garments in `fixtures/garments`.
pub const GARMENTS: [&str; 5] = ["dress", "shirt_sleeveless", "shirt_sleeves", "skirt", "trousers"];

/// A path below `fixtures`.
pub fn fixture(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(path)
}

/// A scene by name, with some keys set.
pub fn scene(name: &str, overrides: &[(&str, &str)]) -> Scene {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    let file = read_scene(&fixture(&format!("scenes/{name}.toml")), &overrides);
    file.unwrap_or_else(|error| panic!("{error}")).scene
}

/// A particle of 1 kg that nothing joins, for steps that hang on no spring.
pub fn free_particle() -> Model {
    Model::new(Arrays::of_particles(vec![Vec3::ZERO], vec![1.0])).expect("a particle is a model")
}

/// The model of the sheet of a scene.
///
/// # Panics
/// When the scene has none.
pub fn sheet_model(scene: &Scene) -> Model {
    let [Cloth::Sheet(sheet)] = scene.cloths.as_slice() else { panic!("{} has one sheet", scene.name) };
    Model::from_sheet(sheet, &scene.settings)
}

/// The shapes of a scene.
pub fn shapes(scene: &Scene) -> Vec<Shape> {
    let shape = |body: &Body| match body {
        Body::Shape(shape) => Some(shape.clone()),
        Body::Mesh(_) | Body::Moving(_) => None,
    };
    scene.bodies.iter().filter_map(shape).collect()
}

/// A garment by name.
pub fn garment(name: &str) -> Garment {
    read_garment(&fixture(&format!("garments/{name}.json"))).unwrap_or_else(|error| panic!("{error}")).garment
}

/// The built-in body in the pose that it is dressed in.
pub fn body() -> Mesh {
    let mut options = BodyOptions::default();
    options.clip = Some("apose_to_walk".to_owned());
    read_body(&fixture("bodies/walking_woman.glb"), &options).unwrap_or_else(|error| panic!("{error}")).mesh
}

/// The built-in body with one of its clips.
pub fn woman(clip: &str) -> MovingMesh {
    let mut options = BodyOptions::default();
    options.clip = Some(clip.to_owned());
    read_moving_body(&fixture("bodies/walking_woman.glb"), &options).unwrap_or_else(|error| panic!("{error}")).body
}

/// Settings of a garment in cotton at a spacing [m], as the program dresses it.
pub fn settings(spacing: f64) -> Settings {
    let default = Settings::new(Fabric::preset("cotton").expect("cotton is a preset"));
    let mut settings = default;
    settings.spacing = spacing;
    settings
}

/// Settings of the sheets of `fixtures/scenes`.
pub fn sheet_settings() -> Settings {
    scene("hang", &[]).settings
}
