//! What a model must be, on grids, shapes, seams, real garments and random outlines.

mod bending;
mod crossed;
mod dressing;
mod fit;
mod garments;
mod letting_out;
mod levels;
mod random_outlines;
mod seams;
mod shapes;
mod sheet;
mod sound;
mod support;
