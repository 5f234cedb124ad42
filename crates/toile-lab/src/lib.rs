//! Harness and measures that tests, benches and the report share.
//!
//! A [`Lab`] gives an experiment its device, [`Run`] drives a cloth on it, and [`kernels`] runs each kernel alone beside its reference.
//! What is measured stays with those who measure.

mod distance;
mod drawn_maps;
pub mod fixtures;
mod gpu;
pub mod kernels;
mod lab;
mod largest;
pub mod motion;
mod network;
pub mod peers;
mod random;
mod run;
pub mod scenes;
mod settle;
pub mod shapes;
mod walked;
mod with;

pub use distance::Distance;
pub use drawn_maps::{DrawnMaps, read_maps};
pub use gpu::{Gpu, INSTALL_HINT};
pub use lab::{Lab, LabError, Progress, Scale};
pub use largest::max_and_p99;
pub use network::Network;
pub use random::Random;
pub use run::{Run, StepCost};
pub use settle::settled;
pub use walked::{Worst, middles, turned};
pub use with::with;
