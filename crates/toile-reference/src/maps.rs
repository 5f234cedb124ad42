//! Depth, normal and velocity of a body as two cameras see it, in front and behind. W §4.

mod body_maps;
mod morph_body;
mod render_maps;
mod skin_body;
mod vertex_velocities;

pub use body_maps::BodyMaps;
pub use morph_body::morph_body;
pub use render_maps::{Surface, render_maps, render_maps_in};
pub use skin_body::skin_body;
pub use vertex_velocities::vertex_velocities;
