//! `toile dress`.

use crate::args::Dress;
use crate::commands::outfit;
use crate::outcome::Outcome;
use crate::simulate::simulate;
use anyhow::Result;

/// Dresses the outfit that the options name.
pub fn run(arguments: &Dress) -> Result<Outcome> {
    simulate(outfit::read(&arguments.outfit)?, &outfit::fit_options(&arguments.outfit), &arguments.running)
}
