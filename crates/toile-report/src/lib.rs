//! Speed against error: the experiments and the page they make.
//!
//! Each [`Experiment`] measures on the device of a [`Lab`] and gives a [`Section`](page::Section) of text, tables and plots. A run
//! that diverges is data, not an error. The small functions that measure are public, so that the tests keep a small version of
//! every section as assertions.

pub mod distance;
mod experiment;
pub mod experiments;
pub mod fixtures;
pub mod kernels;
mod lab;
pub mod network;
pub mod page;

pub use experiment::Experiment;
pub use experiments::EXPERIMENTS;
pub use lab::shapes;
pub use lab::{Gpu, Lab, LabError, Layers, Progress, Random, Run, Scale, StepCost, read_maps, settled};
