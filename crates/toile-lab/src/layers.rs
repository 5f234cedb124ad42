//! Bodies as the maps show them, on the device and for the reference.

use crate::Gpu;
use glam::Vec3;
use std::sync::Arc;
use toile::gpu::{BodyMaps, GpuError, Surface, readback};
use toile::model::MapBox;
use toile::scene::Mesh;

/// The maps of some bodies, drawn by the device.
#[derive(Clone, Debug)]
pub struct Layers {
    /// The maps on the device.
    pub maps: Arc<BodyMaps>,
    /// The same texels, read back for the reference, so that sampling them is exact.
    pub read: toile_reference::maps::BodyMaps,
}

impl Layers {
    /// Draws bodies, each with the thickness of the cloth on it [m], with texels of the edge length `texel` [m].
    ///
    /// # Errors
    /// [`GpuError`] when the maps do not fit the device.
    ///
    /// # Panics
    /// When no body has a vertex.
    pub fn draw(gpu: &Gpu, bodies: &[(&Mesh, f32)], texel: f32) -> Result<Self, GpuError> {
        // The box of the reference's maps: around the vertices after they have been moved out.
        let corners: Vec<Vec3> = bodies
            .iter()
            .flat_map(|(mesh, thickness)| mesh.positions.iter().zip(&mesh.normals).map(|(p, n)| *p + *n * *thickness))
            .collect();
        let low = corners.iter().copied().reduce(Vec3::min).expect("a body has a vertex");
        let high = corners.iter().copied().reduce(Vec3::max).expect("a body has a vertex");
        Self::draw_in(gpu, bodies, MapBox::around([low, high], texel))
    }

    /// Draws bodies into maps of a given box.
    ///
    /// # Errors
    /// [`GpuError`] when the maps do not fit the device.
    pub fn draw_in(gpu: &Gpu, bodies: &[(&Mesh, f32)], map_box: MapBox) -> Result<Self, GpuError> {
        let surfaces: Vec<_> =
            bodies.iter().map(|(mesh, thickness)| (Surface::new(&gpu.device, mesh), *thickness)).collect();
        let drawn: Vec<_> = surfaces.iter().map(|(surface, thickness)| (surface, *thickness)).collect();
        Self::draw_surfaces(gpu, &drawn, map_box)
    }

    /// Draws surfaces of the device; maps of moving bodies when they have velocities.
    ///
    /// # Errors
    /// [`GpuError`] when the maps do not fit the device.
    pub fn draw_surfaces(gpu: &Gpu, surfaces: &[(&Surface, f32)], map_box: MapBox) -> Result<Self, GpuError> {
        let moving = surfaces.iter().any(|(surface, _)| surface.velocities.is_some());
        let maps = BodyMaps::new(&gpu.device, map_box, moving)?;
        gpu.run(|encoder| maps.record(&gpu.device, encoder, map_box, surfaces))?;
        let read = read_maps(gpu, &maps, map_box)?;
        Ok(Self { maps: Arc::new(maps), read })
    }
}

/// The texels of maps that show the bodies in `map_box`.
///
/// # Errors
/// [`GpuError::Device`] when the device is lost.
pub fn read_maps(gpu: &Gpu, maps: &BodyMaps, map_box: MapBox) -> Result<toile_reference::maps::BodyMaps, GpuError> {
    Ok(toile_reference::maps::BodyMaps {
        map_box,
        depth: readback::read_depth(&gpu.device, &gpu.queue, maps)?,
        normals: readback::read_normals(&gpu.device, &gpu.queue, maps)?,
        velocities: readback::read_velocities(&gpu.device, &gpu.queue, maps)?,
    })
}
