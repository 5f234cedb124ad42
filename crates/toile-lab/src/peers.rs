//! Other programs on the scenes of a sheet, measured as toile is: each gives the ends of its frames and their times, and one function judges them.

mod course;
mod nvcloth;
mod stiff;
mod trial;

pub use course::{Course, CourseError, Figures};
pub use nvcloth::{Constraint, NvClothScheme, NvClothSettings, Phase, Tether};
pub use stiff::stiff_middle;
pub use trial::{Sphere, Trial};
