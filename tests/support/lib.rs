//! Shared by the tests and benches: a device, fixtures, seeded numbers, comparisons of bits, kernels run alone.

mod bits;
mod compute;
mod drive;
mod fixtures;
mod gpu;
mod layers;
mod random;
mod run;
mod shapes;

pub use bits::{Difference, first_difference, vec3_words};
pub use compute::Compute;
pub use drive::{advance, arrived, finish_frame};
pub use fixtures::{GARMENTS, SCENES, body, fixture, garment, scene, settings, sheet_settings};
pub use gpu::{Gpu, INSTALL_HINT, gpu};
pub use layers::{Layers, read_maps};
pub use random::Random;
pub use run::{Compiled, Inputs};
pub use shapes::{box_mesh, uv_sphere, without_triangles};
