//! Validation against known answers.

pub mod cusick;
pub mod elastica;
pub mod friction;
pub mod hanging;
pub mod laws;

use crate::Experiment;
use crate::page::Section;
use toile_lab::{Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "validation", title: "Validation against known answers", minutes: [0.4, 1.2], run };

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let lead = "What is known in closed form, or measured in fabric laboratories, beside what the device gives. Free fall, momentum, the hanging strip \
        and the catenary follow theory to the resolution of the mesh; so does the cantilever, since a fabric has a bending rigidity in N·m. \
        The drape coefficients are those that the presets are fitted by.";
    let mut section = EXPERIMENT.section(lead);
    for part in [laws::blocks, hanging::blocks, elastica::blocks, friction::blocks, cusick::blocks] {
        section.blocks.extend(part(lab)?);
    }
    Ok(section)
}
