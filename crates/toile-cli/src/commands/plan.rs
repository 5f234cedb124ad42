//! `toile plan`.

use crate::args::PlanOf;
use anyhow::Result;

/// Prints the passes of a scene.
pub fn run(_arguments: &PlanOf) -> Result<()> {
    Ok(())
}
