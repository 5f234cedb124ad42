//! `toile walk`.

use crate::args::Walk;
use crate::commands::outfit;
use crate::walk;
use anyhow::{Result, bail};
use toile::scene::{Settings, Wind};

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
    let seconds = arguments.seconds.unwrap_or(body.duration());
    let frame_count = (seconds * arguments.fps).round() as u32;
    if frame_count == 0 {
        bail!("a walk of {seconds} s at {} frames per second has no frame: give more --seconds", arguments.fps);
    }
    walk::walk(
        &walk::Walk {
            body,
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
                "{outfit:?} {seconds} s {} fps, wind {:?}, maps kept: {}",
                arguments.fps, arguments.wind, arguments.precompute_maps
            ),
        },
        &arguments.running,
    )
}
