//! Work-precision: what an error costs.

use crate::page::Section;
use crate::{Experiment, Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "precision", title: "Work-precision: what an error costs", minutes: [1.0, 25.0], run };

fn run(_: &mut Lab) -> Result<Section, LabError> {
    Ok(Section::new(&EXPERIMENT, ""))
}
