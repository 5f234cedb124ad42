//! What each term costs and buys.

use crate::page::Section;
use crate::{Experiment, Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "terms", title: "What each term costs and buys", minutes: [0.4, 6.0], run };

fn run(_: &mut Lab) -> Result<Section, LabError> {
    Ok(Section::new(&EXPERIMENT, ""))
}
