//! The program `toile`.

mod adapter;
mod args;
mod bodies;
mod commands;
mod engine;
mod fit;
mod interrupt;
mod look;
mod mesa_layer;
mod metrics;
mod outcome;
mod output;
mod pattern;
mod picture;
mod progress;
mod reference_run;
mod simulate;
mod stdout;
mod walk;
mod worn;

use clap::Parser;
use outcome::Outcome;
use std::process::ExitCode;

/// Exit code of a bad option, a bad file, a run that fails.
const FAILED: u8 = 2;
/// Exit code of a run that is written, where a garment is not on.
const NOT_WORN: u8 = 3;
/// Exit code after ctrl-c: what a shell reports of a program that the signal ends.
const INTERRUPTED: u8 = 130;

fn main() -> ExitCode {
    mesa_layer::silence();
    let arguments = match args::Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => match args::sentence(&error) {
            Some(sentence) => return fail(&sentence),
            None => error.exit(),
        },
    };
    match interrupt::listen().and_then(|()| commands::run(&arguments.command)) {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::NotWorn) => ExitCode::from(NOT_WORN),
        Err(error) if error.is::<interrupt::Interrupted>() => {
            eprintln!("{error}");
            ExitCode::from(INTERRUPTED)
        }
        Err(error) => fail(&format!("{error:#}")),
    }
}

/// Says why on one line, so that a log or a script can take it as it is.
fn fail(sentence: &str) -> ExitCode {
    let words: Vec<&str> = sentence.split_whitespace().collect();
    eprintln!("error: {}", words.join(" "));
    ExitCode::from(FAILED)
}
