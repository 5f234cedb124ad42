//! Settings do not change the answer.

use crate::page::Section;
use crate::{Experiment, Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "settings", title: "Settings do not change the answer", minutes: [0.4, 8.0], run };

fn run(_: &mut Lab) -> Result<Section, LabError> {
    Ok(Section::new(&EXPERIMENT, ""))
}
