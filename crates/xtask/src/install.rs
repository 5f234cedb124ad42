//! What a fresh machine lacks, by the packages of Debian and Ubuntu.

use crate::{command, run};
use std::fs;
use std::process::Stdio;

/// Installs packages as root, or with sudo where it asks nothing; `false` where there is no Debian or Ubuntu.
pub fn install(packages: &[&str]) -> Result<bool, String> {
    if !fs::read_to_string("/etc/os-release").is_ok_and(|text| text.contains("debian")) {
        return Ok(false);
    }
    let root = matches!(command("id", &["-u"]).output(), Ok(output) if output.stdout.trim_ascii() == b"0");
    let apt = |arguments: &[&str]| {
        let words = if root { vec!["apt-get"] } else { vec!["sudo", "--non-interactive", "apt-get"] };
        let words = [&words, arguments].concat();
        let mut command = command(words[0], &words[1..]);
        command.env("DEBIAN_FRONTEND", "noninteractive").stdin(Stdio::null());
        run(command)
    };
    apt(&["update"])
        .and_then(|()| apt(&[&["install", "--yes", "--no-install-recommends"], packages].concat()))
        .map_err(|error| format!("{error}; run as root: {}", by_hand(packages)))?;
    Ok(true)
}

/// What does the same by hand.
pub fn by_hand(packages: &[&str]) -> String {
    format!("apt-get update && apt-get install -y {}", packages.join(" "))
}
