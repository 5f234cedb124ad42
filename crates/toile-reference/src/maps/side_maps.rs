//! The maps of a body, texel by texel.

use glam::Vec3;
use toile_model::SideBox;

/// The maps of a body. Layer 0 is what the front camera at +z sees, layer 1 what the back camera at −z sees.
///
/// Texel (column, row) has index row·columns + column; row 0 is the top. Every layer has the shape [rows·columns]. W §4.
#[derive(Clone, Debug, PartialEq)]
pub struct SideMaps {
    /// Where the maps stand in the world.
    pub map_box: SideBox,
    /// Distance from the camera's plane, 0 to 1 of the distance of both planes; 1 where there is nothing.
    pub depth: [Vec<f32>; 2],
    /// Unit normals of the surface, facing the camera; zero where there is nothing.
    pub normals: [Vec<Vec3>; 2],
    /// Velocities of the surface [m/s]; `None` for bodies at rest.
    pub velocities: Option<[Vec<Vec3>; 2]>,
}
