//! The CPU answer of every kernel, file for file, the exact distance to a mesh, and collision in
//! object space as a baseline.
//!
//! [`Reference`] lives the life of the GPU simulation: built from a model, stepped, read. Every kernel is also one plain
//! function in [`step`] or [`frame`]. The order of operations is part of the answer: all arithmetic is f32, unfused and left
//! to right, so that a GPU that rounds correctly gives the same bits. Nothing here sees WGSL or a GPU struct.

#![expect(clippy::neg_cmp_op_on_partial_ord, reason = "guards are written so that NaN fails them")]

mod contact;
mod digest;
mod exact_distance;
pub mod frame;
pub mod limits;
pub mod maps;
mod object_space;
mod particles;
mod reference;
pub mod step;

pub use contact::{Contact, Probe};
pub use exact_distance::{ExactDistance, PenetrationSummary};
pub use object_space::ObjectSpace;
pub use particles::{Lag, Midpoints, Nodes, Particles};
pub use reference::{Colliders, Reference};
