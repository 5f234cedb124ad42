//! `toile dress`.

use crate::args::Dress;
use crate::commands::outfit;
use crate::outcome::Outcome;
use crate::simulate::simulate;
use anyhow::Result;

/// Dresses the outfit that the options name.
pub fn run(arguments: &Dress) -> Result<Outcome> {
    let (scene, warnings) = outfit::read(&arguments.outfit)?;
    // It runs until the garments are at rest, so it has no frames.
    simulate(&scene, 0, &warnings, &outfit::fit_options(&arguments.outfit), &arguments.running)
}
