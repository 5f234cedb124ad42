//! What a host outside of this workspace meets: packages, a browser's target, and the pages of the library.

use crate::{cargo, cargo_path, command, say, target};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// The crates that are published, each after those that it needs.
const CRATES: [&str; 7] =
    ["toile-scene", "toile-files", "toile-model", "toile-kernels", "toile-gpu", "toile", "toile-reference"];

/// The target of browsers.
const WASM: &str = "wasm32-unknown-unknown";

/// What stands in brackets and is no link: units, and names of shapes.
const UNITS: [&str; 19] = [
    "1", "m", "cm", "mm", "m²", "m³", "kg", "s", "ms", "Hz", "rad", "degrees", "J", "N", "Pa", "byte", "bytes",
    "texel", "px",
];

/// Packages every library crate, builds the library without its features and for a browser, and follows the links of its pages.
pub fn check() -> Result<(), String> {
    package()?;
    cargo(&["check", "--package", "toile", "--no-default-features"])?;
    browser()?;
    intra_doc_links()?;
    pages()
}

/// Every file that a crate needs must be in its package. What a package holds is built when it is published.
fn package() -> Result<(), String> {
    let mut arguments = vec!["package", "--quiet", "--no-verify", "--allow-dirty"];
    arguments.extend(CRATES.iter().flat_map(|name| ["--package", name]));
    cargo(&arguments)?;
    // cargo packs what the sources name only when it builds them, so the kernels are looked for here.
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../toile-kernels/wgsl");
    if !folder.join("step/euler.wgsl").exists() {
        return Err(format!("{} is no link to the folder wgsl: check out with core.symlinks", folder.display()));
    }
    Ok(())
}

fn browser() -> Result<(), String> {
    let added = command("rustup", &["target", "add", WASM]).stdout(Stdio::null()).stderr(Stdio::null()).status();
    if !added.is_ok_and(|status| status.success()) {
        say(&format!("NOT RUN: the library for {WASM}, because rustup cannot add it"));
        return Ok(());
    }
    // A host for the web leaves out what waits.
    cargo(&["check", "--package", "toile", "--target", WASM, "--no-default-features", "--features", "files"])?;
    cargo(&["check", "--package", "toile", "--target", WASM])?;
    cargo(&["check", "--package", "toile", "--target", WASM, "--no-default-features", "--example", "web"])
}

/// Units stand in brackets in this documentation, so rustdoc takes them for links and its own lint is off.
fn intra_doc_links() -> Result<(), String> {
    let mut dead = Vec::new();
    for name in CRATES {
        let lint = "rustdoc::broken_intra_doc_links";
        let mut rustdoc = command(&cargo_path(), &["rustdoc", "--package", name, "--lib", "--", "--warn", lint]);
        let output = rustdoc.output().map_err(|error| format!("{rustdoc:?} cannot be run: {error}"))?;
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        if !output.status.success() {
            return Err(format!("{rustdoc:?} ended with {}: {said}", output.status));
        }
        let links = said.lines().filter_map(|line| line.split_once("unresolved link to `")?.1.split('`').next());
        dead.extend(links.filter(|link| !is_measure(link)).map(|link| format!("{name}: [{link}]")));
    }
    if dead.is_empty() { Ok(()) } else { Err(format!("links of the documentation lead nowhere: {}", dead.join(", "))) }
}

/// Whether a word in brackets is a unit, or a count as shapes have it.
fn is_measure(word: &str) -> bool {
    UNITS.contains(&word) || word.ends_with("_count")
}

/// The pages of the library alone: every link must lead to a page that is there.
fn pages() -> Result<(), String> {
    let folder = target()?.join("doc");
    // Pages of other crates would hide what the library's own lack.
    let _ = fs::remove_dir_all(&folder);
    cargo(&["doc", "--quiet", "--no-deps", "--package", "toile"])?;
    let mut pages = Vec::new();
    gather(&folder.join("toile"), &mut pages)?;
    let mut dead = Vec::new();
    for page in &pages {
        let text = fs::read_to_string(page).map_err(|error| format!("{}: {error}", page.display()))?;
        let links = text.split("href=\"").skip(1).filter_map(|rest| rest.split('"').next());
        let elsewhere = |link: &str| link.contains("://") || link.contains('$') || link.starts_with(['#', '?']);
        for link in
            links.filter(|link| !elsewhere(link) && !link.starts_with("data:") && !link.starts_with("javascript:"))
        {
            let path = link.split('#').next().unwrap_or(link);
            // rustdoc links a list of all items from each crate that is shown within another, and writes none.
            let is_there = path.ends_with("all.html") || page.parent().is_some_and(|folder| folder.join(path).exists());
            if !is_there {
                dead.push(format!("{}: {link}", page.display()));
            }
        }
    }
    say(&format!("{} pages of the library, {} dead links", pages.len(), dead.len()));
    if dead.is_empty() { Ok(()) } else { Err(format!("pages that are not there: {}", dead.join(", "))) }
}

fn gather(folder: &Path, pages: &mut Vec<PathBuf>) -> Result<(), String> {
    for entry in fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))? {
        let path = entry.map_err(|error| error.to_string())?.path();
        if path.is_dir() {
            gather(&path, pages)?;
        } else if path.extension().is_some_and(|ending| ending == "html") {
            pages.push(path);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::is_measure;

    #[test]
    fn a_unit_is_no_link_and_a_path_is_one() {
        assert!(["m", "Pa", "particle_count"].iter().all(|word| is_measure(word)));
        assert!(["Model", "Simulation::advance", "toile_gpu::Kernel"].iter().all(|word| !is_measure(word)));
    }
}
