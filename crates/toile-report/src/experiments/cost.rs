//! Cost against size.

use crate::page::Section;
use crate::{Experiment, Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment { name: "cost", title: "Cost against size", minutes: [0.3, 3.0], run };

fn run(_: &mut Lab) -> Result<Section, LabError> {
    Ok(Section::new(&EXPERIMENT, ""))
}
