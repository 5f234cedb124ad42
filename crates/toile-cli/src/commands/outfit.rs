//! The outfit that the options name: body, garments, settings.

use crate::args::Outfit;
use anyhow::{Context, Result};
use std::path::Path;
use toile::files::{self, BodyOptions, SceneFile};
use toile::scene::{Body, Cloth, Fabric, Scene, Settings, VelocityModification};

/// The built-in body and the pose it is dressed in.
const BODY: &[u8] = include_bytes!("../../../../fixtures/bodies/walking_woman.glb");
const BODY_NAME: &str = "walking_woman.glb";
const BODY_CLIP: &str = "apose_to_walk";
/// The built-in garment.
const GARMENT: &str = include_str!("../../../../fixtures/garments/dress.json");
/// A garment is pulled at by gravity, seams and body at once: one sweep leaves more of the stretch.
const SWEEPS: u32 = 4;

/// Reads the outfit as a scene. It runs until the garments are at rest, so it has no frames.
pub fn read(outfit: &Outfit) -> Result<SceneFile> {
    let options =
        BodyOptions { metres_per_unit: outfit.body_units.metres(), clip: outfit.clip.clone(), time: outfit.time };
    let body = match &outfit.body {
        Some(path) => files::read_body(path, &options)?,
        None => {
            let clip = Some(outfit.clip.clone().unwrap_or_else(|| BODY_CLIP.to_owned()));
            files::parse_body(BODY, BODY_NAME, &BodyOptions { clip, metres_per_unit: 1.0, ..options })?
        }
    };
    let mut cloths = Vec::new();
    for path in &outfit.garment {
        cloths.push(Cloth::Garment(files::read_garment(path)?));
    }
    if cloths.is_empty() {
        cloths.push(Cloth::Garment(files::parse_garment(GARMENT, "dress")?));
    }
    let default = Settings::new(fabric(&outfit.fabric)?);
    let scene = Scene {
        name: "outfit".to_owned(),
        cloths,
        bodies: vec![Body::Mesh(body.mesh)],
        settings: Settings {
            velocity_modification: VelocityModification { sweeps: SWEEPS, ..default.velocity_modification },
            spacing: outfit.spacing,
            texel: outfit.texel,
            ..default
        },
    };
    Ok(SceneFile { scene, frames: 0, warnings: body.warnings })
}

fn fabric(name: &str) -> Result<Fabric> {
    match Fabric::preset(name) {
        Some(fabric) => Ok(fabric),
        None => files::read_fabric(Path::new(name)).with_context(|| {
            format!("--fabric {name} is neither a preset ({}) nor a fabric file", Fabric::PRESETS.join(", "))
        }),
    }
}
