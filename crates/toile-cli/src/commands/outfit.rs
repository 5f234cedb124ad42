//! The outfit that the options name: body, garments, settings.

use crate::args::Outfit;
use anyhow::{Result, bail};
use std::path::Path;
use toile::files::{self, BodyOptions, Fault, SceneFile};
use toile::model::FitOptions;
use toile::scene::{Body, Cloth, Fabric, Garment, MovingMesh, Scene, Settings, VelocityModification};

/// The built-in body and the pose it is dressed in.
const BODY: &[u8] = include_bytes!("../../../../fixtures/bodies/walking_woman.glb");
const BODY_NAME: &str = "walking_woman.glb";
const BODY_CLIP: &str = "apose_to_walk";
/// The built-in garment.
const GARMENT: &str = include_str!("../../../../fixtures/garments/dress.json");

/// Reads the outfit as a scene. It runs until the garments are at rest, so it has no frames.
pub fn read(outfit: &Outfit) -> Result<SceneFile> {
    let options = options(outfit);
    let body = match &outfit.body {
        Some(path) => files::read_body(path, &options)?,
        None => {
            let clip = Some(outfit.clip.clone().unwrap_or_else(|| BODY_CLIP.to_owned()));
            files::parse_body(BODY, BODY_NAME, &BodyOptions { clip, metres_per_unit: 1.0, ..options })?
        }
    };
    let (garments, mut warnings) = read_garments(outfit)?;
    warnings.splice(..0, body.warnings);
    let scene = Scene {
        name: "outfit".to_owned(),
        cloths: garments.into_iter().map(Cloth::Garment).collect(),
        bodies: vec![Body::Mesh(body.mesh)],
        settings: settings(outfit)?,
    };
    Ok(SceneFile { scene, frames: 0, warnings })
}

/// Reads the body of the outfit with its motion, and what is unusual about it.
pub fn read_moving_body(outfit: &Outfit) -> Result<(MovingMesh, Vec<String>)> {
    let options = options(outfit);
    let file = match &outfit.body {
        Some(path) => files::read_moving_body(path, &options)?,
        None => {
            let clip = Some(outfit.clip.clone().unwrap_or_else(|| BODY_CLIP.to_owned()));
            files::parse_moving_body(BODY, BODY_NAME, &BodyOptions { clip, metres_per_unit: 1.0, ..options })?
        }
    };
    Ok((file.body, file.warnings))
}

/// The built-in body with one of its clips.
pub fn walking_woman(clip: &str) -> Result<MovingMesh> {
    let options = BodyOptions { clip: Some(clip.to_owned()), ..BodyOptions::default() };
    Ok(files::parse_moving_body(BODY, BODY_NAME, &options)?.body)
}

/// Reads the garments of the outfit, inner ones first, and what is unusual about them.
pub fn read_garments(outfit: &Outfit) -> Result<(Vec<Garment>, Vec<String>)> {
    if outfit.garments.files.is_empty() {
        return Ok((vec![files::parse_garment(GARMENT, "dress")?.garment], Vec::new()));
    }
    let (mut garments, mut warnings) = (Vec::new(), Vec::new());
    for (path, own) in &outfit.garments.files {
        let fabric = own.as_deref().map(fabric).transpose()?;
        let file = files::read_garment(path)?;
        warnings.extend(file.warnings.iter().map(|warning| format!("{}: {warning}", path.display())));
        garments.push(Garment { fabric, ..file.garment });
    }
    Ok((garments, warnings))
}

/// How the outfit is simulated.
pub fn settings(outfit: &Outfit) -> Result<Settings> {
    let default = Settings::new(fabric(&outfit.garments.fabric)?);
    let velocity_modification = VelocityModification { polish: outfit.polish, ..default.velocity_modification };
    Ok(Settings { velocity_modification, spacing: outfit.spacing, texel: outfit.texel, ..default })
}

/// What the user says of how the body stands.
pub fn fit_options(outfit: &Outfit) -> FitOptions {
    FitOptions { up: outfit.up, facing: outfit.facing, dress_in: None }
}

fn options(outfit: &Outfit) -> BodyOptions {
    BodyOptions { metres_per_unit: outfit.body_units.metres(), clip: outfit.clip.clone(), time: outfit.time }
}

fn fabric(name: &str) -> Result<Fabric> {
    if let Some(fabric) = Fabric::preset(name) {
        return Ok(fabric);
    }
    let path = Path::new(name);
    if path.extension().is_none() && !path.exists() {
        let known = Fabric::PRESETS.map(String::from).to_vec();
        let fault = Fault::Unknown { what: "fabric", name: name.to_owned(), known };
        bail!("--fabric {name}: {fault}; a TOML file may take its place");
    }
    Ok(files::read_fabric(path)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Arguments, Command};
    use clap::Parser;

    fn fabrics(typed: &[&str]) -> Vec<String> {
        let fixture = |word: &str| match word.strip_suffix(".json") {
            Some(_) => format!("{}/../../fixtures/garments/{word}", env!("CARGO_MANIFEST_DIR")),
            None => word.to_owned(),
        };
        let words = ["toile", "dress"].iter().chain(typed).map(|word| fixture(word));
        let Command::Dress(dress) = Arguments::try_parse_from(words).expect("it is clear").command else {
            panic!("it was dress")
        };
        let scene = read(&dress.outfit).expect("it can be read").scene;
        scene.fabrics().map(|fabric| fabric.name.clone()).collect()
    }

    #[test]
    fn each_garment_is_made_of_the_fabric_that_follows_it() {
        assert_eq!(fabrics(&[]), ["cotton"]);
        assert_eq!(fabrics(&["--fabric", "wool"]), ["wool"]);
        let [skirt, shirt] = ["skirt.json", "shirt_sleeves.json"];
        assert_eq!(fabrics(&["--garment", skirt, "--garment", shirt, "--fabric", "wool"]), ["wool", "wool"]);
        let both = ["--garment", skirt, "--fabric", "wool", "--garment", shirt, "--fabric", "silk"];
        assert_eq!(fabrics(&both), ["wool", "silk"]);
        assert_eq!(fabrics(&both[..6]), ["wool", "cotton"]);
    }
}
