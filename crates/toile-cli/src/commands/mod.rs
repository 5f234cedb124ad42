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
use anyhow::Result;

/// Does what the user typed.
pub fn run(command: &Command) -> Result<()> {
    match command {
        Command::Dress(arguments) => dress::run(arguments),
        Command::Walk(arguments) => walk::run(arguments),
        Command::Rules(arguments) => rules::run(arguments),
        Command::Run(arguments) => run::run(arguments),
        Command::Plan(arguments) => plan::run(arguments),
        Command::Report(arguments) => report::run(arguments),
        Command::Adapters(arguments) => adapters::run(arguments),
    }
}
