//! Every kernel alone: seeded input that leads into all its branches, what the reference makes of it, and the kernel run on the device.

mod answer;
mod bits;
mod compiled;
mod input;
mod seeded;
mod seeded_bodies;
mod seeded_levels;

pub use answer::answer;
pub use bits::{Difference, first_difference, ulps, vec3_words};
pub use compiled::{Compiled, Inputs};
pub use input::{Input, Posed};
pub use seeded::{Seeds, VARIANTS, Variant};
