//! `toile walk`.

use crate::args::{Outfit, Walk};
use crate::bodies;
use crate::commands::outfit;
use crate::fit;
use crate::outcome::Outcome;
use crate::walk;
use anyhow::{Result, bail};
use toile::model::FitOptions;
use toile::scene::{Body, Cloth, Scene, Settings, Wind};

/// Walks the outfit that the options name.
pub fn run(arguments: &Walk) -> Result<Outcome> {
    let outfit = &arguments.outfit;
    if outfit.time != 0.0 {
        bail!("--time {}: a walk begins with its clip; leave it out", outfit.time);
    }
    let (body, warnings) = outfit::read_moving_body(outfit)?;
    if !arguments.running.quiet {
        for warning in &warnings {
            eprintln!("warning: {warning}");
        }
    }
    let garments = outfit::read_garments(outfit)?;
    let settings =
        Settings { frame_rate: arguments.fps, wind: arguments.wind.map(Wind::new), ..outfit::settings(outfit)? };
    let dress_in = match &arguments.dress_in {
        Some(clip) => {
            let from = outfit::read_moving_body(&Outfit { clip: Some(clip.clone()), ..outfit.clone() })?.0;
            Some(from)
        }
        None => None,
    };
    let seconds = arguments.seconds.unwrap_or(body.duration());
    let frame_count = (seconds * arguments.fps).round() as u32;
    if frame_count == 0 {
        bail!("a walk of {seconds} s at {} frames per second has no frame: give more --seconds", arguments.fps);
    }
    let options = FitOptions { dress_in, ..outfit::fit_options(outfit) };
    let scene = Scene {
        name: "walk".to_owned(),
        cloths: garments.into_iter().map(Cloth::Garment).collect(),
        bodies: vec![Body::Moving(body)],
        settings: settings.clone(),
    };
    let fit = fit::look(&scene, &options)?;
    let Some(body) = bodies::moving(&fit.scene).next().cloned() else { unreachable!("it was just put there") };
    if !arguments.running.quiet {
        fit::tell(&fit);
    }
    walk::walk(
        &walk::Walk {
            body,
            fit,
            settings,
            frame_count,
            precompute_maps: arguments.precompute_maps,
            resume: arguments.resume,
        },
        &arguments.running,
    )
}
