//! Every kernel through Tint, the WGSL compiler of Chromium: naga takes more than the standard has.

use crate::{command, run, say, target};
use std::env;
use std::path::Path;
use std::process::Stdio;

/// The check and the version of Dawn's bindings for node.
const FOLDER: &str = "tests/tint";

/// Compiles the kernels for the driver of this manifest, or any. Where node or Dawn cannot run it says that they were not compiled.
pub fn check(manifest: Option<&Path>) -> Result<(), String> {
    for program in ["node", "npm"] {
        let found = command(program, &["--version"]).stdout(Stdio::null()).stderr(Stdio::null()).status();
        if !found.is_ok_and(|status| status.success()) {
            say(&format!("NOT RUN: the kernels through Tint, because {program} is not there"));
            return Ok(());
        }
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(FOLDER);
    let kernels = target()?.join("wgsl").display().to_string();
    // The tests built it; to run it by cargo would build what it needs once more, with other features.
    let resolved = target()?.join("debug/examples/resolved").with_extension(env::consts::EXE_EXTENSION);
    run(command(&resolved.display().to_string(), &[&kernels]))?;
    let mut packages = command("npm", &["ci", "--ignore-scripts", "--no-audit", "--no-fund"]);
    packages.current_dir(&folder);
    if let Err(error) = run(packages) {
        say(&format!("NOT RUN: the kernels through Tint, because Dawn's bindings cannot be fetched: {error}"));
        return Ok(());
    }
    let node = |script: &str| {
        let mut node = command("node", &[script, &kernels]);
        node.current_dir(&folder);
        if let Some(manifest) = manifest {
            node.env("VK_DRIVER_FILES", manifest);
        }
        node
    };
    // Dawn is built for newer systems than some that have node.
    if let Err(error) = run(node("adapter.mjs")) {
        say(&format!("NOT RUN: the kernels through Tint, because Dawn does not start here: {error}"));
        return Ok(());
    }
    run(node("check.mjs"))
}
