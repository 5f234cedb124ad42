//! Shared by the tests and benches: a device, fixtures, simulations driven to the end of a frame. What the report needs too is in
//! `toile-report`.

mod compute;
mod drive;
mod fixtures;
mod gpu;

pub use compute::Compute;
pub use drive::{advance, arrived, finish_frame};
pub use fixtures::{GARMENTS, SCENES, body, fixture, garment, scene, settings, shapes, sheet_model, sheet_settings};
pub use gpu::{Gpu, INSTALL_HINT, gpu, lab};
pub use toile_lab::kernels::{Difference, first_difference, vec3_words};
pub use toile_report::shapes::without_triangles;
pub use toile_report::{Layers, Random, read_maps};
