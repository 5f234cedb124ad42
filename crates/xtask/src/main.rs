//! The commands of the repository: they set up what a fresh machine lacks, then do their work.
//!
//! `cargo xtask dress …` is `toile dress …`; `cargo xtask test` checks the format, lints, checks what is published, builds the documentation,
//! runs every test, runs parity on a second driver and compiles the kernels with a second compiler. CI runs the same.
//! `cargo xtask films` makes the films of the documentation, those that are named or all.

mod films;
mod install;
mod published;
mod second_driver;
mod tint;

use install::install;
use std::env;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

/// A Vulkan driver that works on the CPU, and the library that finds it.
const PACKAGES: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let done = match arguments.split_first() {
        Some((task, rest)) if task == "dress" => dress(rest),
        Some((task, [])) if task == "test" => test(),
        Some((task, names)) if task == "films" => films(names),
        _ => Err("usage: cargo xtask dress [OPTIONS of toile dress] | cargo xtask test | cargo xtask films [NAMES]"
            .to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            say(&format!("error: {message}"));
            ExitCode::FAILURE
        }
    }
}

/// Tells what is done, beside what the commands themselves print. Nobody may listen any more.
fn say(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// Dresses the built-in body in the built-in dress, or what the options say.
fn dress(options: &[String]) -> Result<(), String> {
    let toile = built_for_use()?;
    // The reference needs no adapter, and help needs nothing.
    if !options.iter().any(|option| option.contains("reference") || option == "--help" || option == "-h") {
        ensure_adapter(&toile, "")?;
    }
    let mut command = Command::new(toile);
    command.arg("dress").args(options);
    run(command)
}

/// Makes the films of the documentation.
fn films(names: &[String]) -> Result<(), String> {
    films::make(&built_for_use()?, names)
}

/// The program, built with all optimisation.
fn built_for_use() -> Result<PathBuf, String> {
    let toile = built("release")?;
    if !toile.exists() {
        say("the first build compiles about 200 crates: several minutes on two cores, and seconds from then on");
    }
    cargo(&["build", "--release", "--package", "toile-cli"])?;
    Ok(toile)
}

/// Everything that must hold before a change lands. Lints and documentation share one build of the dependencies, the tests
/// and the program another; each is built for the whole workspace, because a part of it would ask for other features.
fn test() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"])?;
    cargo(&["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"])?;
    let mut documentation = command(&cargo_path(), &["doc", "--workspace", "--no-deps", "--document-private-items"]);
    documentation.env("RUSTDOCFLAGS", "--deny warnings");
    published::check()?;
    run(documentation)?;
    cargo(&["test", "--workspace", "--no-run"])?;
    // The tests compare bits, which a GPU may round otherwise.
    let toile = built("debug")?;
    if let Err(message) = ensure_adapter(&toile, "· Cpu ·") {
        ensure_adapter(&toile, "")?;
        say(&format!("the tests run on a GPU, where the bits of some may differ: {message}"));
    }
    // The tests run side by side already: threads of the CPU driver's own would only wait for one another.
    let mut tests = command(&cargo_path(), &["test", "--workspace"]);
    tests.env("LP_NUM_THREADS", "0");
    run(tests)?;
    let driver = second_driver::parity()?;
    tint::check(driver.as_deref())
}

/// The program that cargo built beside this one.
fn built(profile: &str) -> Result<PathBuf, String> {
    Ok(target()?.join(profile).join("toile").with_extension(env::consts::EXE_EXTENSION))
}

/// The folder that cargo builds into.
fn target() -> Result<PathBuf, String> {
    let own = env::current_exe().map_err(|error| format!("where this program lies is not known: {error}"))?;
    Ok(own.ancestors().nth(2).ok_or("this program does not lie in a target folder")?.to_owned())
}

/// Installs a Vulkan driver that works on the CPU where there is no adapter of a kind and this machine can, or says what to run.
fn ensure_adapter(toile: &Path, kind: &str) -> Result<(), String> {
    if has_adapter(toile, kind)? {
        return Ok(());
    }
    say("no such adapter found: a Vulkan driver that works on the CPU is installed");
    if !install(&PACKAGES)? {
        return Err(format!("install a Vulkan driver; on Debian or Ubuntu: {}", install::by_hand(&PACKAGES)));
    }
    match has_adapter(toile, kind)? {
        true => Ok(()),
        false => Err("a Vulkan driver is installed, but no adapter is found; `toile adapters` says why".to_owned()),
    }
}

/// Whether the program finds an adapter that it can use, and one of a kind is listed; it says what it finds.
fn has_adapter(toile: &Path, kind: &str) -> Result<bool, String> {
    let mut command = command(&toile.display().to_string(), &["adapters"]);
    say(&format!("$ {command:?}"));
    match command.stderr(Stdio::null()).output() {
        Ok(output) => {
            let listed = String::from_utf8_lossy(&output.stdout).into_owned();
            say(listed.trim_end());
            Ok(output.status.success() && listed.contains(kind))
        }
        Err(error) => Err(format!("{} cannot be run: {error}", toile.display())),
    }
}

fn cargo(arguments: &[&str]) -> Result<(), String> {
    run(command(&cargo_path(), arguments))
}

/// The cargo that runs this program.
fn cargo_path() -> String {
    env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned())
}

fn command(program: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments);
    command
}

/// Runs a command after saying which.
fn run(mut command: Command) -> Result<(), String> {
    say(&format!("$ {command:?}"));
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{command:?} ended with {status}")),
        Err(error) => Err(format!("{command:?} cannot be run: {error}")),
    }
}
