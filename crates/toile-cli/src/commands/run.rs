//! `toile run`.

use crate::args::Run;
use crate::commands::dress::simulate;
use anyhow::Result;
use toile::files::read_scene;

/// Runs a scene file.
pub fn run(arguments: &Run) -> Result<()> {
    let file = read_scene(&arguments.scene, &arguments.set)?;
    for warning in &file.warnings {
        eprintln!("warning: {warning}");
    }
    simulate(&file.scene, file.frames, &arguments.running)
}
