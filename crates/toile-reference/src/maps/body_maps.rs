//! The maps of bodies, of either kind.

use super::render_sides::box_around;
use super::{LayerMaps, SideMaps, Surface, draw_layers, render_sides_in};
use toile_model::MapBox;
use toile_scene::MapKind;

/// The maps of bodies.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyMaps {
    /// The papers' maps.
    Sides(SideMaps),
    /// Layered maps.
    Layers(LayerMaps),
}

impl BodyMaps {
    /// Draws all surfaces into a box.
    pub fn draw(kind: MapKind, surfaces: &[Surface], map_box: MapBox) -> Self {
        match kind {
            MapKind::Sides => Self::Sides(render_sides_in(surfaces, map_box)),
            MapKind::Layers => Self::Layers(draw_layers(surfaces, map_box).maps),
        }
    }

    /// Draws all surfaces into the box around them, with texels of the edge length `texel` [m].
    ///
    /// # Panics
    /// When no surface has a vertex.
    pub fn around(kind: MapKind, surfaces: &[Surface], texel: f32) -> Self {
        Self::draw(kind, surfaces, box_around(surfaces, texel))
    }

    /// Whether they have velocities.
    pub fn is_moving(&self) -> bool {
        match self {
            Self::Sides(maps) => maps.velocities.is_some(),
            Self::Layers(maps) => maps.velocities.is_some(),
        }
    }
}
