//! The outfit that the options name: body, garments, settings.

use crate::args::Outfit;
use anyhow::{Result, bail};
use std::path::Path;
use toile::files::{self, BodyOptions, Fault};
use toile::model::FitOptions;
use toile::scene::{Body, Cloth, Fabric, Garment, MovingMesh, Scene, Settings};

/// The built-in body and the pose it is dressed in.
const BODY: &[u8] = include_bytes!("../../../../fixtures/bodies/walking_woman.glb");
const BODY_NAME: &str = "walking_woman.glb";
const BODY_CLIP: &str = "apose_to_walk";
/// The built-in garment.
const GARMENT: &str = include_str!("../../../../fixtures/garments/dress.json");

/// Reads the outfit as a scene, and what is unusual about its files.
pub fn read(outfit: &Outfit) -> Result<(Scene, Vec<String>)> {
    let options = options(outfit);
    let body = match &outfit.body {
        Some(path) => files::read_body(path, &options)?,
        None => files::parse_body(BODY, BODY_NAME, &options)?,
    };
    let (garments, mut warnings) = read_garments(outfit)?;
    warnings.splice(..0, body.warnings);
    let mut scene = Scene::new("outfit", settings(outfit)?);
    scene.cloths = garments.into_iter().map(Cloth::Garment).collect();
    scene.bodies = vec![Body::Mesh(body.mesh)];
    Ok((scene, warnings))
}

/// Reads the body of the outfit with its motion, and what is unusual about it.
pub fn read_moving_body(outfit: &Outfit) -> Result<(MovingMesh, Vec<String>)> {
    let options = options(outfit);
    let file = match &outfit.body {
        Some(path) => files::read_moving_body(path, &options)?,
        None => files::parse_moving_body(BODY, BODY_NAME, &options)?,
    };
    Ok((file.body, file.warnings))
}

/// The built-in body with one of its clips.
pub fn walking_woman(clip: &str) -> Result<MovingMesh> {
    let mut options = BodyOptions::default();
    options.clip = Some(clip.to_owned());
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
        let mut garment = file.garment;
        garment.fabric = fabric;
        garments.push(garment);
    }
    Ok((garments, warnings))
}

/// How the outfit is simulated.
pub fn settings(outfit: &Outfit) -> Result<Settings> {
    let mut settings = Settings::new(fabric(&outfit.garments.fabric)?);
    settings.velocity_modification.polish = outfit.polish;
    settings.spacing = outfit.spacing;
    settings.texel = outfit.texel;
    Ok(settings)
}

/// What the user says of how the body stands.
pub fn fit_options(outfit: &Outfit) -> FitOptions {
    let mut options = FitOptions::default();
    options.up = outfit.up;
    options.facing = outfit.facing;
    options
}

/// How the body is read. The built-in one is in metres, and stands in a clip in any case.
fn options(outfit: &Outfit) -> BodyOptions {
    let mut options = BodyOptions::default();
    options.time = outfit.time;
    options.clip.clone_from(&outfit.clip);
    match outfit.body {
        Some(_) => options.metres_per_unit = outfit.body_units.metres(),
        None => options.clip = options.clip.or_else(|| Some(BODY_CLIP.to_owned())),
    }
    options
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
        let scene = read(&dress.outfit).expect("it can be read").0;
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
