//! What a model must be, on grids, shapes, seams, real garments and random outlines.

mod bending;
mod coarse;
mod fit;
mod garments;
mod long_limits;
mod random_outlines;
mod seams;
mod shapes;
mod sheet;
mod support;
