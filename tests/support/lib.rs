//! What only tests need: a device whose silence fails them, any small WGSL on it, and simulations driven to the end of a frame.

mod compute;
mod drive;
mod gpu;

pub use compute::Compute;
pub use drive::{advance, arrived, finish_frame};
pub use gpu::{Gpu, gpu, lab, own_gpu};
