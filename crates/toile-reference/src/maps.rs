//! Depth, normal and velocity of a body as two cameras see it, in front and behind. W §4.

mod morph_body;
mod render_maps;
mod skin_body;
mod vertex_velocities;

use glam::Vec3;
use toile_model::MapBox;

pub use morph_body::morph_body;
pub use render_maps::{Surface, render_maps, render_maps_in};
pub use skin_body::skin_body;
pub use vertex_velocities::vertex_velocities;

/// The maps of a body. Layer 0 is what the front camera at +z sees, layer 1 what the back camera at −z sees.
///
/// Texel (column, row) has index row·columns + column; row 0 is the top. Every layer has the shape [rows·columns]. W §4.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyMaps {
    /// Where the maps stand in the world.
    pub map_box: MapBox,
    /// Distance from the camera's plane, 0 to 1 of the distance of both planes; 1 where there is nothing.
    pub depth: [Vec<f32>; 2],
    /// Unit normals of the surface, facing the camera; zero where there is nothing.
    pub normals: [Vec<Vec3>; 2],
    /// Velocities of the surface [m/s]; `None` for bodies at rest.
    pub velocities: Option<[Vec<Vec3>; 2]>,
}
