//! `toile run`.

use crate::args::Run;
use crate::outcome::Outcome;
use crate::simulate::simulate;
use anyhow::Result;
use toile::files::read_scene;
use toile::model::FitOptions;

/// Runs a scene file.
pub fn run(arguments: &Run) -> Result<Outcome> {
    let file = read_scene(&arguments.scene, &arguments.set)?;
    simulate(&file.scene, file.frames, &file.warnings, &FitOptions::default(), &arguments.running)
}
