//! The two commands of the README: they set up what a fresh machine lacks, then do their work.
//!
//! `cargo xtask dress …` is `toile dress …`; `cargo xtask test` checks the format, lints and runs every test.

use std::env;
use std::fs;
use std::process::{Command, ExitCode};

const PACKAGES: [&str; 2] = ["mesa-vulkan-drivers", "libvulkan1"];

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let done = match arguments.split_first() {
        Some((task, rest)) if task == "dress" => dress(rest),
        Some((task, [])) if task == "test" => test(),
        _ => Err("usage: cargo xtask dress [OPTIONS of toile dress] | cargo xtask test".to_owned()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

/// Dresses the built-in body in the built-in dress, or what the options say.
fn dress(options: &[String]) -> Result<(), String> {
    cargo(&["build", "--release", "--package", "toile-cli"])?;
    // The reference needs no adapter.
    if !options.iter().any(|option| option.contains("reference")) {
        ensure_adapter("release")?;
    }
    let mut arguments = vec!["run", "--quiet", "--release", "--package", "toile-cli", "--", "dress"];
    arguments.extend(options.iter().map(String::as_str));
    cargo(&arguments)
}

/// Everything that must hold before a change lands.
fn test() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"])?;
    cargo(&["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"])?;
    cargo(&["build", "--package", "toile-cli"])?;
    ensure_adapter("debug")?;
    cargo(&["test", "--workspace"])
}

/// Installs a Vulkan driver that works on the CPU where there is no adapter and this machine can, or says what to run.
fn ensure_adapter(profile: &str) -> Result<(), String> {
    if has_adapter(profile)? {
        return Ok(());
    }
    println!("no adapter found");
    let manual = format!("apt-get install -y {}", PACKAGES.join(" "));
    let debian = fs::read_to_string("/etc/os-release").is_ok_and(|text| text.contains("debian"));
    if !debian {
        return Err(format!("install a Vulkan driver; on Debian or Ubuntu: {manual}"));
    }
    let prefix: &[&str] = match command("id", &["-u"]).output() {
        Ok(output) if output.stdout.trim_ascii() == b"0" => &[],
        _ => &["sudo", "--non-interactive"],
    };
    let apt = |arguments: &[&str]| {
        let whole: Vec<&str> = prefix.iter().chain(&["apt-get"]).chain(arguments).copied().collect();
        run(command(whole[0], &whole[1..]))
    };
    let mut install = vec!["install", "-y"];
    install.extend(PACKAGES);
    apt(&["update"]).and_then(|()| apt(&install)).map_err(|error| format!("{error}; run as root: {manual}"))?;
    match has_adapter(profile)? {
        true => Ok(()),
        false => Err("a Vulkan driver is installed, but no adapter is found; `toile adapters` lists what there is".to_owned()),
    }
}

/// Whether the program that was just built finds an adapter.
fn has_adapter(profile: &str) -> Result<bool, String> {
    let quiet: &[&str] = if profile == "release" { &["--release"] } else { &[] };
    let mut arguments = vec!["run", "--quiet"];
    arguments.extend(quiet);
    arguments.extend(["--package", "toile-cli", "--", "adapters"]);
    let status = command(&cargo_path(), &arguments).status().map_err(|error| format!("cargo: {error}"))?;
    Ok(status.success())
}

fn cargo(arguments: &[&str]) -> Result<(), String> {
    run(command(&cargo_path(), arguments))
}

fn cargo_path() -> String {
    env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned())
}

fn command(program: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(arguments);
    command
}

fn run(mut command: Command) -> Result<(), String> {
    println!("$ {command:?}");
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{command:?} ended with {status}")),
        Err(error) => Err(format!("{command:?} cannot be run: {error}")),
    }
}
