//! The maps of the bodies, of either kind: drawn on the GPU, never leaving it in a run. W §4.

mod layer_maps;
mod side_maps;
mod surface;

pub(crate) use side_maps::SidePipeline;
pub use surface::Surface;
pub(crate) use surface::padded;

use crate::limits::check_limits;
use crate::{GpuError, Kernels};
use layer_maps::LayerMaps;
use side_maps::SideMaps;
use thiserror::Error;
use toile_model::MapBox;
use toile_scene::MapKind;

/// Layers for each texel of area that a surface has: one that lies across all three axes is met by √3 columns.
const LAYERS_PER_TEXEL: f64 = 1.74;
/// Layers that are always there, for what rounding adds on small surfaces.
const LAYERS_MIN: u64 = 4096;

/// What maps must hold.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct MapSpace {
    /// How they see bodies.
    pub kind: MapKind,
    /// Where they stand; its size stays.
    pub map_box: MapBox,
    /// Whether anything in them moves.
    pub moving: bool,
    /// Largest area of all surfaces together [m²]; the papers' maps do not ask for it.
    pub area: f64,
}

impl MapSpace {
    /// Maps of bodies at rest, whose surfaces have this area together [m²].
    pub fn new(kind: MapKind, map_box: MapBox, area: f64) -> Self {
        Self { kind, map_box, moving: false, area }
    }

    /// Most layers of the layered maps.
    pub(crate) fn crossing_capacity(&self) -> u64 {
        let texel = f64::from(self.map_box.texel);
        LAYERS_MIN + (LAYERS_PER_TEXEL * self.area / (texel * texel)).ceil() as u64
    }

    /// Bytes of maps over it. It needs no device.
    pub fn bytes(&self) -> u64 {
        match self.kind {
            MapKind::Sides => SideMaps::bytes_over(&self.map_box, self.moving),
            MapKind::Layers => LayerMaps::bytes_over(self),
        }
    }
}

/// What did not fit into layered maps: the bodies have holes there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Error)]
#[error(
    "the maps lost {lost_crossings} crossings of their columns, {dropped_triangles} triangles that are not finite or more than \
     4000 texels away, and {crowded_columns} columns with more than 32 surfaces one behind the other; use a larger texel"
)]
#[non_exhaustive]
pub struct MapsFault {
    /// Crossings beyond the capacity.
    pub lost_crossings: u64,
    /// Triangles with a vertex too far away or without a place.
    pub dropped_triangles: u32,
    /// Columns with more crossings than can be told apart.
    pub crowded_columns: u32,
}

/// The maps of everything that a cloth collides with.
#[derive(Debug)]
pub struct BodyMaps {
    space: MapSpace,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Sides(Box<SideMaps>),
    Layers(Box<LayerMaps>),
}

impl BodyMaps {
    /// Empty maps; `kernels` is a device, or the pipelines that others on it use.
    ///
    /// # Errors
    /// [`GpuError::MapTooLarge`] and [`GpuError::BufferTooLarge`] when they do not fit the device, [`GpuError::LimitTooLow`] when the device has
    /// less than their passes need.
    pub fn new(kernels: impl Into<Kernels>, space: &MapSpace) -> Result<Self, GpuError> {
        let kernels = kernels.into();
        check_limits(kernels.device())?;
        let kind = match space.kind {
            MapKind::Sides => Kind::Sides(Box::new(SideMaps::new(&kernels, space.map_box, space.moving)?)),
            MapKind::Layers => Kind::Layers(Box::new(LayerMaps::new(&kernels, space)?)),
        };
        Ok(Self { space: space.clone(), kind })
    }

    /// Empty layered maps that are drawn and sorted by WGSL that is changed to see a test fail. What is not valid is an error of the device's
    /// error scope.
    ///
    /// # Errors
    /// As [`BodyMaps::new`].
    pub fn of_sources(device: &wgpu::Device, space: &MapSpace, sources: [&str; 2]) -> Result<Self, GpuError> {
        let maps = LayerMaps::of_sources(device, space, sources)?;
        Ok(Self { space: space.clone(), kind: Kind::Layers(Box::new(maps)) })
    }

    /// Records the drawing of all surfaces into a box. The papers' maps move each out along its normals by the thickness beside it [m]; where points
    /// meet layered maps, the thickness of the cloth is taken off.
    ///
    /// # Panics
    /// When the box has another size than these maps, or a surface in maps of moving bodies has no velocities.
    pub fn record(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        map_box: MapBox,
        surfaces: &[(&Surface, f32)],
    ) {
        match &self.kind {
            Kind::Sides(maps) => maps.record(device, encoder, map_box, surfaces),
            Kind::Layers(maps) => maps.record(device, encoder, map_box, surfaces.iter().map(|(surface, _)| *surface)),
        }
    }

    /// Records the drawing of more surfaces over what the maps show already.
    ///
    /// # Panics
    /// When a surface in maps of moving bodies has no velocities.
    pub fn record_over(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, surfaces: &[(&Surface, f32)]) {
        match &self.kind {
            Kind::Sides(maps) => maps.record_over(device, encoder, surfaces),
            Kind::Layers(maps) => maps.record_over(device, encoder, surfaces.iter().map(|(surface, _)| *surface)),
        }
    }

    /// Records a copy of maps of the same size and kind, which show the bodies in `map_box`.
    ///
    /// # Panics
    /// When the other maps are of another size or kind, or only one of both shows velocities.
    pub fn record_copy(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        other: &BodyMaps,
        map_box: MapBox,
    ) {
        match (&self.kind, &other.kind) {
            (Kind::Sides(maps), Kind::Sides(other)) => maps.record_copy(device, encoder, other, map_box),
            (Kind::Layers(maps), Kind::Layers(other)) => maps.record_copy(device, encoder, other, map_box),
            _ => panic!("maps are copied into maps of the same kind"),
        }
    }

    /// What they hold.
    pub fn space(&self) -> &MapSpace {
        &self.space
    }

    /// Whether the maps show velocities.
    pub fn is_moving(&self) -> bool {
        self.space.moving
    }

    /// What did not fit the last time that the maps reported, without waiting; `None` where all did, or before that.
    pub fn fault(&self) -> Option<MapsFault> {
        match &self.kind {
            Kind::Sides(_) => None,
            Kind::Layers(maps) => maps.fault(),
        }
    }

    /// The depth map. Of the papers' maps: `Depth32Float`, two layers; 0 at the camera's plane, 1 at the other camera's plane or where nothing is
    /// seen. Of layered maps: `Rg32Uint`, a list of 2048 to a row: the bits of the depth [m], and the place of normal and velocity in
    /// their lists.
    pub fn depths(&self) -> &wgpu::Texture {
        match &self.kind {
            Kind::Sides(maps) => maps.depths(),
            Kind::Layers(maps) => maps.depths(),
        }
    }

    /// The normal map, `Rgba32Float`; xyz is the unit normal. The papers' maps have two layers, in which it faces the camera; layered maps a list
    /// of 2048 to a row, in which it leads out of the body.
    pub fn normals(&self) -> &wgpu::Texture {
        match &self.kind {
            Kind::Sides(maps) => maps.normals(),
            Kind::Layers(maps) => maps.normals(),
        }
    }

    /// The velocity map, `Rgba32Float`, shaped as the normal map; xyz is the velocity [m/s]. `None` for bodies at rest.
    pub fn velocities(&self) -> Option<&wgpu::Texture> {
        match &self.kind {
            Kind::Sides(maps) => maps.velocities(),
            Kind::Layers(maps) => maps.velocities(),
        }
    }

    /// The columns of layered maps, `Rg32Uint`, a list of 2048 to a row: the place of the first layer, and ends of bodies | sheets << 16. The
    /// map along x comes first, and over each map its first extent runs fastest: y of that along x, z of that along y, x of that along z.
    /// `None` for the papers' maps.
    pub fn columns(&self) -> Option<&wgpu::Texture> {
        match &self.kind {
            Kind::Sides(_) => None,
            Kind::Layers(maps) => Some(maps.columns()),
        }
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.space.bytes()
    }

    /// The resource that the kernels know by this name, if it is one of the maps.
    pub(crate) fn resource(&self, name: &str) -> Option<wgpu::BindingResource<'_>> {
        match &self.kind {
            Kind::Sides(maps) => maps.resource(name),
            Kind::Layers(maps) => maps.resource(name),
        }
    }
}
