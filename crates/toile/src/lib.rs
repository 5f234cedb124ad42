//! Cloth simulation on the GPU: every step runs as WGSL compute passes.
//!
//! The host gives a device, a queue and a command encoder; [`Cloth`] records into the encoder and gives back buffers of
//! positions, normals and indices. It never submits, never waits and never maps a buffer in the frame loop.

mod cloth;
mod error;
mod frame;
mod outfit;
mod strain;

pub use cloth::{Cloth, Colliders};
pub use error::Error;
pub use frame::Frame;
pub use outfit::{MovingFrame, Outfit};
pub use strain::Strain;
pub use toile_files as files;
pub use toile_gpu as gpu;
pub use toile_model as model;
pub use toile_scene as scene;

/// Compiles the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
