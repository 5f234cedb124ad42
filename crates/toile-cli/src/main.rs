//! The program `toile`.

mod adapter;
mod args;
mod commands;
mod engine;
mod metrics;
mod output;
mod picture;
mod progress;
mod worn;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = args::Arguments::parse();
    match commands::run(&arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}
