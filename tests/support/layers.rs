//! Bodies as the maps show them, on the device and for the reference.

use crate::Gpu;
use glam::Vec3;
use std::sync::Arc;
use toile_gpu::{BodyMaps, Surface, readback};
use toile_model::MapFrame;
use toile_scene::Mesh;

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
    pub fn draw(gpu: &Gpu, bodies: &[(&Mesh, f32)], texel: f32) -> Self {
        // The frame of the reference's maps: around the vertices after they have been moved out.
        let corners: Vec<Vec3> = bodies
            .iter()
            .flat_map(|(mesh, thickness)| mesh.positions.iter().zip(&mesh.normals).map(|(p, n)| *p + *n * *thickness))
            .collect();
        let low = corners.iter().copied().reduce(Vec3::min).expect("a body has a vertex");
        let high = corners.iter().copied().reduce(Vec3::max).expect("a body has a vertex");
        Self::draw_in(gpu, bodies, MapFrame::around([low, high], texel))
    }

    /// Draws bodies into maps of a given frame.
    pub fn draw_in(gpu: &Gpu, bodies: &[(&Mesh, f32)], frame: MapFrame) -> Self {
        let surfaces: Vec<_> =
            bodies.iter().map(|(mesh, thickness)| (Surface::new(&gpu.device, mesh), *thickness)).collect();
        let drawn: Vec<_> = surfaces.iter().map(|(surface, thickness)| (surface, *thickness)).collect();
        Self::draw_surfaces(gpu, &drawn, frame)
    }

    /// Draws surfaces of the device; maps of moving bodies when they have velocities.
    pub fn draw_surfaces(gpu: &Gpu, surfaces: &[(&Surface, f32)], frame: MapFrame) -> Self {
        let moving = surfaces.iter().any(|(surface, _)| surface.velocities.is_some());
        let maps = BodyMaps::new(&gpu.device, frame, moving).unwrap_or_else(|error| panic!("{error}"));
        gpu.run(|encoder| maps.record(&gpu.device, encoder, frame, surfaces));
        let read = read_maps(gpu, &maps, frame);
        Self { maps: Arc::new(maps), read }
    }
}

/// The texels of maps that show the bodies in `frame`.
pub fn read_maps(gpu: &Gpu, maps: &BodyMaps, frame: MapFrame) -> toile_reference::maps::BodyMaps {
    toile_reference::maps::BodyMaps {
        frame,
        depth: readback::read_depth(&gpu.device, &gpu.queue, maps).expect("the device answers"),
        normals: readback::read_normals(&gpu.device, &gpu.queue, maps).expect("the device answers"),
        velocities: readback::read_velocities(&gpu.device, &gpu.queue, maps).expect("the device answers"),
    }
}
