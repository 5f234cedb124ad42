//! Parity once more, on SwiftShader: what one driver rounds, orders or leaves out as the reference does, another may not.

use crate::{cargo_path, command, install::install, run, say};
use std::path::{Path, PathBuf};

/// Where Debian's package `chromium` puts the driver's manifest.
const MANIFEST: &str = "/usr/lib/chromium/vk_swiftshader_icd.json";

/// Part of the adapter's name; the tests fail when they run on another.
const ADAPTER: &str = "SwiftShader";

/// Runs the tests of parity on the driver, and gives its manifest. Where the driver cannot be had it says that they were not run.
pub fn parity() -> Result<Option<PathBuf>, String> {
    let manifest = Path::new(MANIFEST);
    if !manifest.is_file() {
        say("no second driver found: SwiftShader is installed, which comes with Debian's chromium");
        if !install(&["chromium"])? || !manifest.is_file() {
            say(&format!("NOT RUN: parity on {ADAPTER}, because {MANIFEST} cannot be had on this system"));
            return Ok(None);
        }
    }
    // The saboteurs ask whether the tests see what is wrong, which hangs on no driver.
    let arguments = ["test", "--workspace", "--test", "parity", "--", "--include-ignored", "--skip", "saboteur::"];
    let mut tests = command(&cargo_path(), &arguments);
    tests.env("VK_DRIVER_FILES", manifest).env("TOILE_TEST_ADAPTER", ADAPTER);
    run(tests)?;
    Ok(Some(manifest.to_owned()))
}
