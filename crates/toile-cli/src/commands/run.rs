//! `toile run`.

use crate::args::Run;
use crate::outcome::Outcome;
use crate::simulate::simulate;
use anyhow::Result;
use toile::files::read_scene;
use toile::model::FitOptions;

/// Runs a scene file.
pub fn run(arguments: &Run) -> Result<Outcome> {
    simulate(read_scene(&arguments.scene, &arguments.set)?, &FitOptions::default(), &arguments.running)
}
