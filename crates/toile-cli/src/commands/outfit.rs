//! The outfit that the options name: body, garments, settings.

use crate::args::Outfit;
use anyhow::{Context, Result};
use glam::DVec3;
use std::path::Path;
use toile::files::{self, BodyOptions};
use toile::scene::{Body, Cloth, Fabric, Friction, Rule, Scene, Settings, VelocityModification};

/// The built-in body and the pose it is dressed in.
const BODY: &[u8] = include_bytes!("../../../../fixtures/bodies/walking_woman.glb");
const BODY_NAME: &str = "walking_woman.glb";
const BODY_CLIP: &str = "apose_to_walk";
/// The built-in garment.
const GARMENT: &str = include_str!("../../../../fixtures/garments/dress.json");

/// Reads the outfit. Warnings go to the standard error output.
pub fn read(outfit: &Outfit) -> Result<Scene> {
    let options = BodyOptions {
        metres_per_unit: outfit.body_units.metres(),
        clip: outfit.clip.clone(),
        time: outfit.time,
    };
    let body = match &outfit.body {
        Some(path) => files::read_body(path, &options)?,
        None => {
            let clip = Some(outfit.clip.clone().unwrap_or_else(|| BODY_CLIP.to_owned()));
            files::parse_body(BODY, BODY_NAME, &BodyOptions { clip, ..options })?
        }
    };
    for warning in &body.warnings {
        eprintln!("warning: {warning}");
    }
    let mut cloths = Vec::new();
    for path in &outfit.garment {
        cloths.push(Cloth::Garment(files::read_garment(path)?));
    }
    if cloths.is_empty() {
        cloths.push(Cloth::Garment(files::parse_garment(GARMENT, "dress")?));
    }
    Ok(Scene {
        name: "outfit".to_owned(),
        cloths,
        bodies: vec![Body::Mesh(body.mesh)],
        settings: settings(fabric(&outfit.fabric)?, outfit.spacing, outfit.texel),
    })
}

fn fabric(name: &str) -> Result<Fabric> {
    match Fabric::preset(name) {
        Some(fabric) => Ok(fabric),
        None => files::read_fabric(Path::new(name)).with_context(|| {
            format!("{name} is neither a fabric preset ({}) nor a fabric file", Fabric::PRESETS.join(", "))
        }),
    }
}

fn settings(fabric: Fabric, spacing: f64, texel: f64) -> Settings {
    Settings {
        fabric,
        velocity_modification: VelocityModification { rule: Rule::Predictive, sweeps: 2 },
        friction: Friction::Coulomb,
        reflection: 0.0,
        gravity: DVec3::new(0.0, -9.81, 0.0),
        spacing,
        texel,
        frame_rate: 60.0,
        safety: 0.9,
    }
}
