//! `toile walk`.

use crate::args::{MotionName, Outfit, ViewName, Walk};
use crate::bodies;
use crate::commands::outfit;
use crate::fit;
use crate::outcome::Outcome;
use crate::picture::View;
use crate::walk;
use anyhow::{Result, bail};
use toile::scene::{Body, Cloth, MovingMesh, Scene, Wind};
use toile_lab::motion::Made;

/// Walks the outfit that the options name.
pub fn run(arguments: &Walk) -> Result<Outcome> {
    let outfit = &arguments.outfit;
    if outfit.time != 0.0 {
        bail!("--time {}: a walk begins with its clip; leave it out", outfit.time);
    }
    let (body, warnings) = match arguments.motion {
        Some(motion) => (made(motion)?, Vec::new()),
        None => outfit::read_moving_body(outfit)?,
    };
    let (garments, of_garments) = outfit::read_garments(outfit)?;
    if !arguments.running.quiet {
        fit::tell_of_files(&warnings);
        fit::tell_of_files(&of_garments);
    }
    let mut settings = outfit::settings(outfit)?;
    settings.frame_rate = arguments.fps;
    settings.wind = arguments.wind.map(Wind::new);
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
    let mut options = outfit::fit_options(outfit);
    options.dress_in = dress_in;
    let mut scene = Scene::new("walk", settings.clone());
    scene.cloths = garments.into_iter().map(Cloth::Garment).collect();
    scene.bodies = vec![Body::Moving(body)];
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
            height: arguments.height,
            views: arguments.view.iter().map(|view| view_of(*view)).collect(),
        },
        &arguments.running,
    )
}

/// The built-in body with a motion that is made for it.
fn made(motion: MotionName) -> Result<MovingMesh> {
    let motion = match motion {
        MotionName::Corner => Made::Corner,
        MotionName::Turning => Made::Turning,
        MotionName::ArmsFolded => Made::ArmsFolded,
        MotionName::Sitting => Made::Sitting,
        MotionName::Pirouette => Made::Pirouette,
    };
    Ok(motion.of(&outfit::walking_woman("walk_loop")?))
}

fn view_of(view: ViewName) -> View {
    match view {
        ViewName::Front => View::Front,
        ViewName::Back => View::Back,
        ViewName::Side => View::Side,
        ViewName::ThreeQuarter => View::ThreeQuarter,
    }
}
