//! The environment that Taichi runs in: made when asked, never by itself, in the folder of what is built.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What it holds, with versions.
const PACKAGES: &str = include_str!("taichi.txt");
/// How to come by it.
const HINT: &str = "`cargo bench --bench peers -- --make-environments` makes its environment";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("peers").join("taichi")
}

/// Says which packages an environment was made with. It is written last: what was broken off is none.
fn mark() -> PathBuf {
    folder().join("packages.txt")
}

fn program() -> PathBuf {
    folder().join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" })
}

/// The Python of the environment.
///
/// # Errors
/// What to do, when there is none or it has other versions.
pub fn python() -> Result<PathBuf, String> {
    match fs::read_to_string(mark()) {
        Ok(packages) if packages == PACKAGES && program().exists() => Ok(program()),
        Ok(_) => Err(format!("its environment has other versions; {HINT}")),
        Err(_) => Err(HINT.to_owned()),
    }
}

/// Makes the environment anew.
///
/// # Errors
/// What failed and what to do, in a line.
pub fn make() -> Result<(), String> {
    let folder = folder();
    let python = if cfg!(windows) { "python" } else { "python3" };
    run(
        // It empties the folder, mark and all, once Python has been found.
        Command::new(python).args(["-m", "venv", "--clear"]).arg(&folder),
        "install Python 3.8 to 3.13 with its module venv, first on the path",
    )?;
    let packages: Vec<&str> = PACKAGES.lines().collect();
    run(
        Command::new(program()).args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]).args(packages),
        "see that the package index can be reached and has these versions for this Python",
    )?;
    fs::write(mark(), PACKAGES).map_err(|error| format!("{} cannot be written: {error}", mark().display()))?;
    println!("made {}", folder.display());
    Ok(())
}

fn run(command: &mut Command, advice: &str) -> Result<(), String> {
    let told = format!("{command:?}");
    let output = command.output().map_err(|error| format!("{told} cannot run ({error}): {advice}"))?;
    if output.status.success() {
        return Ok(());
    }
    let words = String::from_utf8_lossy(if output.stderr.is_empty() { &output.stdout } else { &output.stderr });
    let last = words.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("it says nothing").to_owned();
    Err(format!("{told} failed ({last}): {advice}"))
}
