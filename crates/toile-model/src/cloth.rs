//! The arrays of a cloth, open and sewn: springs, limits, colours, seams.

mod assemble;
mod attachments;
mod bend_lines;
mod bending;
mod check;
mod clusters;
mod colouring;
pub(crate) mod digest;
mod fewer_colours;
mod flat_cloth;
mod flat_spans;
mod levels;
mod lines;
pub(crate) mod model;
mod open;
mod seams;
mod sewn;
mod soften;
mod springs;

pub(crate) use assemble::aim;
