//! A scene turned into immutable arrays: meshing, springs, sewing, limits, colouring.
//!
//! [`Model`] is what the solvers (GPU and reference) read. It is built once on the CPU and never changes.

mod assemble;
mod bending;
mod colouring;
mod csr;
mod digest;
mod dressing;
mod elements;
mod error;
mod fan;
mod flat_mesh;
mod geometry;
mod inside;
mod lattice;
mod lines;
mod long_limits;
mod map_frame;
mod model;
mod needs;
mod open;
mod outline;
mod rectangle;
mod rim;
mod seams;
mod sewn;
mod smoothing;
mod soften;
mod springs;
mod status;
mod step;
mod union_find;

pub use csr::Csr;
pub use digest::digest_of;
pub use dressing::{Dressing, DressingError, DressingStage};
pub use error::ModelError;
pub use inside::Inside;
pub use long_limits::{STRAND_PARTICLES_MAX, path_chord};
pub use map_frame::MapFrame;
pub use model::{
    Attachment, Hold, Limit, Link, Merge, Model, NO_CORNER, PanelMesh, SeamPair, Spring, SpringKind, Strand,
};
pub use needs::{Maps, Needs};
pub use status::Status;
pub use step::StepSettings;
