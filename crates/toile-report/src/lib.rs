//! Speed against error: the experiments and the page they make.
//!
//! Each [`Experiment`] measures on the device of a [`Lab`](toile_lab::Lab) and gives a [`Section`](page::Section) of text, tables and
//! plots. A run that diverges is data, not an error. The small functions that measure are public, so that the tests keep a small version of
//! every section as assertions.

mod experiment;
pub mod experiments;
pub mod page;

pub use experiment::Experiment;
pub use experiments::EXPERIMENTS;
