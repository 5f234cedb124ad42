//! What a model must be, on grids, shapes, seams, real garments and random outlines.

mod garments;
mod random_outlines;
mod seams;
mod shapes;
mod sheet;
mod support;
