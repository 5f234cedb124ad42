//! Depth, normal and velocity of bodies: as two cameras see them, in front and behind (W §4), and in layers along three axes.

mod body_maps;
mod draw_layers;
mod gather_body;
mod layer_maps;
mod morph_body;
mod render_sides;
mod side_maps;
mod skin_body;
mod vertex_velocities;

pub use body_maps::BodyMaps;
pub use draw_layers::{DrawnLayers, draw_layers};
pub use gather_body::{Attribute, HostMotion, gather_body};
pub use layer_maps::{Column, LayerMaps};
pub use morph_body::morph_body;
pub use render_sides::{Surface, render_sides, render_sides_in};
pub use side_maps::SideMaps;
pub use skin_body::skin_body;
pub use vertex_velocities::vertex_velocities;
