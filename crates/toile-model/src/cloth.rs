//! The arrays of a cloth, open and sewn: springs, limits, colours, seams.

mod assemble;
mod bending;
mod coarse;
mod colouring;
pub(crate) mod digest;
mod flat_spans;
mod lines;
pub(crate) mod long_limits;
pub(crate) mod model;
mod open;
mod seams;
mod sewn;
mod soften;
mod springs;

pub(crate) use assemble::aim;
