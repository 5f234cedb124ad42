//! What the program does.

mod adapters;
mod dress;
mod outfit;
mod plan;
mod run;

use crate::args::Command;
use anyhow::Result;

/// Does what the user typed.
pub fn run(command: &Command) -> Result<()> {
    match command {
        Command::Dress(arguments) => dress::run(arguments),
        Command::Run(arguments) => run::run(arguments),
        Command::Plan(arguments) => plan::run(arguments),
        Command::Adapters(arguments) => adapters::run(arguments),
    }
}
