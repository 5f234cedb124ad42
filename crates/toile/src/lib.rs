//! Cloth simulation on the GPU: every step runs as WGSL compute passes.
//!
//! A scene becomes a [`Simulation`] on the host's device. It records into the host's encoder and gives back buffers of positions,
//! normals and indices. It never submits, never waits and never maps a buffer in the frame loop.

mod boxes;
mod checkpoint;
mod clock;
mod cloth;
mod control;
mod controlled;
mod dressed;
mod error;
mod fitting;
mod frame;
mod hosted_body;
mod kept_maps;
mod layer;
mod outfit;
mod pins;
mod pose;
mod put_on;
mod simulation;
mod stage;
mod state;
mod strain;
mod told;
#[cfg(feature = "native-wait")]
mod verdicts;

pub use glam;
pub use wgpu;

pub use checkpoint::Checkpoint;
pub use clock::Advance;
pub use cloth::{Cloth, Colliders};
pub use control::Control;
pub use error::Error;
pub use frame::Frame;
pub use outfit::Teleport;
pub use simulation::{Simulation, Worn};
pub use stage::Stage;
pub use strain::Strain;
#[cfg(feature = "files")]
#[doc(inline)]
pub use toile_files as files;
#[doc(inline)]
pub use toile_gpu as gpu;
#[doc(inline)]
pub use toile_model as model;
#[doc(inline)]
pub use toile_scene as scene;

/// Compiles the example of the README.
#[cfg(all(doctest, feature = "files"))]
#[doc = include_str!("../../../README.md")]
struct Readme;

/// Compiles the examples of the page for hosts.
#[cfg(all(doctest, feature = "files"))]
#[doc = include_str!("../../../docs/hosting.md")]
struct Hosting;
