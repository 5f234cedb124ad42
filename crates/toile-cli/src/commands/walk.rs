//! `toile walk`.

use crate::args::{Outfit, Walk};
use crate::commands::outfit;
use crate::walk;
use anyhow::{Result, bail};
use toile::scene::{MovingMesh, Settings, Wind};

/// Time in which a dressed body goes over to the first pose of its walk [s].
const DRESSING_SECONDS: f64 = 1.0;

/// Walks the outfit that the options name.
pub fn run(arguments: &Walk) -> Result<()> {
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
    let dressing = arguments.dress_in.as_ref().map(|clip| dressing(outfit, clip, &body)).transpose()?;
    let seconds = arguments.seconds.unwrap_or(body.duration());
    let frame_count = (seconds * arguments.fps).round() as u32;
    if frame_count == 0 {
        bail!("a walk of {seconds} s at {} frames per second has no frame: give more --seconds", arguments.fps);
    }
    walk::walk(
        &walk::Walk {
            body,
            dressing,
            garments: outfit::read_garments(outfit)?,
            settings: Settings {
                frame_rate: arguments.fps,
                wind: arguments.wind.map(Wind::new),
                ..outfit::settings(outfit)?
            },
            frame_count,
            precompute_maps: arguments.precompute_maps,
            resume: arguments.resume,
            identity: format!(
                "{outfit:?} {seconds} s {} fps, dressed in {:?}, wind {:?}, maps kept: {}",
                arguments.fps, arguments.dress_in, arguments.wind, arguments.precompute_maps
            ),
        },
        &arguments.running,
    )
}

/// The way of the body from the first pose of a clip, in which it is dressed, to the start of the walk.
fn dressing(outfit: &Outfit, clip: &str, body: &MovingMesh) -> Result<MovingMesh> {
    let from = outfit::read_moving_body(&Outfit { clip: Some(clip.to_owned()), ..outfit.clone() })?.0;
    match MovingMesh::transition(&from, body, DRESSING_SECONDS) {
        Some(way) => Ok(way),
        None => bail!("--dress-in {clip}: it moves other joints than --clip; choose a clip of the same body"),
    }
}
