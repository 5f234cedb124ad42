//! Work-precision: which error costs how much.

mod elongation;
mod maps;
mod poses;
mod position;
mod refinement;

pub use elongation::{Limited, Limiting, limited};
pub use maps::{Coding, MapError, Offset, Probing, Shell, map_error, velocity_error};
pub use poses::{BallTold, Surroundings, Told, poses, told, told_of_ball};
pub use position::{Scene, rest_error};
pub use refinement::shape_errors;

use crate::Experiment;
use crate::page::{Block, Section};
use toile_lab::{Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "precision", title: "Work-precision: which error costs how much", minutes: [0.5, 4.5], run };

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let lead = "What an error costs, in the four places where it comes from: limits that end before they converge, the length of the step, \
                the spacing of the mesh, and the texels of the body's maps. A point further left is cheaper, further down more exact; a \
                user picks the cheapest one whose error is small enough.";
    let mut section = EXPERIMENT.section(lead);
    let text = |words: &str| Block::Text(words.to_owned());
    section
        .blocks
        .push(text("Limits: how far springs are stretched beyond the threshold, by rule, sweeps, step and spacing."));
    section.blocks.extend(elongation::blocks(lab, [0.0, 0.4])?);
    section.blocks.push(text(
        "Step: where the sheet is, against the same springs in f64 with a step so short that the answer has converged. Symplectic Euler \
         has order 1: half the step, half the error, until the rounding of f32 is larger.",
    ));
    section.blocks.extend(position::blocks(lab, [0.4, 0.65])?);
    section.blocks.push(text(
        "Mesh: where the cloth rests, as the spacing shrinks. The springs keep their stiffness at every spacing; for bend springs that \
         means less stiffness of the cloth against bending, so this error need not shrink with the square of the spacing.",
    ));
    section.blocks.extend(refinement::blocks(lab, [0.65, 0.85])?);
    section.blocks.push(text(
        "The papers' two maps: what the cloth sees of the body, against its exact mesh. A point in contact is led out along the normal by the distance that \
         the maps tell; what is left of its depth is one error, a point that moves although it should not the other. Two cameras do not see \
         everything: armpits, the inside of the legs and folds of the body are told apart. Along normals the vertices of the mesh are moved, \
         which makes the exact offset only where the mesh is smooth; so the depth that is left does not vanish with the texel.",
    ));
    section.blocks.extend(maps::blocks(lab, [0.85, 0.93])?);
    section.blocks.push(text(
        "Layers: two cameras along z tell of a body neither the limbs that others hide nor the sides that turn away. Layers along three axes, the default, do; \
         texels as fine as one likes repair nothing in two maps.",
    ));
    section.blocks.extend(poses::blocks(lab, [0.93, 1.0])?);
    Ok(section)
}
