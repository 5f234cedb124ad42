//! What the program does.

mod adapters;
mod dress;
mod outfit;
mod plan;
mod report;
mod rules;
mod run;
mod walk;

use crate::args::Command;
use crate::outcome::Outcome;
use anyhow::Result;

/// Does what the user typed.
pub fn run(command: &Command) -> Result<Outcome> {
    match command {
        Command::Dress(arguments) => return dress::run(arguments),
        Command::Walk(arguments) => return walk::run(arguments),
        Command::Run(arguments) => return run::run(arguments),
        Command::Rules(arguments) => rules::run(arguments),
        Command::Plan(arguments) => plan::run(arguments),
        Command::Report(arguments) => report::run(arguments),
        Command::Adapters(arguments) => adapters::run(arguments),
    }?;
    Ok(Outcome::Done)
}
