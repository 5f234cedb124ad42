//! Bodies as the maps show them, on the device and for the reference.

use crate::Gpu;
use glam::Vec3;
use std::sync::Arc;
use toile::gpu::{BodyMaps, GpuError, MapSpace, Surface, readback};
use toile::model::{MapBox, SideBox};
use toile::scene::{MapKind, Mesh};
use toile_reference::maps::{self, Column, LayerMaps, SideMaps};

/// The maps of some bodies, drawn by the device.
#[derive(Clone, Debug)]
pub struct DrawnMaps {
    /// The maps on the device.
    pub maps: Arc<BodyMaps>,
    /// The same texels, read back for the reference, so that sampling them is exact.
    pub read: maps::BodyMaps,
}

impl DrawnMaps {
    /// Draws bodies, each with the thickness of the cloth on it [m], with texels of the edge length `texel` [m].
    ///
    /// # Errors
    /// [`GpuError`] when the maps do not fit the device.
    ///
    /// # Panics
    /// When no body has a vertex.
    pub fn draw(gpu: &Gpu, kind: MapKind, bodies: &[(&Mesh, f32)], texel: f32) -> Result<Self, GpuError> {
        // The box of the reference's maps: around the vertices after they have been moved out.
        let corners: Vec<Vec3> = bodies
            .iter()
            .flat_map(|(mesh, thickness)| mesh.positions.iter().zip(&mesh.normals).map(|(p, n)| *p + *n * *thickness))
            .collect();
        let low = corners.iter().copied().reduce(Vec3::min).expect("a body has a vertex");
        let high = corners.iter().copied().reduce(Vec3::max).expect("a body has a vertex");
        Self::draw_in(gpu, kind, bodies, MapBox::around([low, high], texel))
    }

    /// Draws bodies into maps of a given box.
    ///
    /// # Errors
    /// [`GpuError`] when the maps do not fit the device.
    pub fn draw_in(gpu: &Gpu, kind: MapKind, bodies: &[(&Mesh, f32)], map_box: MapBox) -> Result<Self, GpuError> {
        let surface = |mesh: &Mesh| Surface::new(&gpu.device, mesh, map_box.texel);
        let surfaces: Vec<_> = bodies.iter().map(|(mesh, thickness)| (surface(mesh), *thickness)).collect();
        let drawn: Vec<_> = surfaces.iter().map(|(surface, thickness)| (surface, *thickness)).collect();
        let area = bodies.iter().map(|(mesh, _)| mesh.area()).sum();
        Self::draw_surfaces(gpu, &drawn, &MapSpace::new(kind, map_box, area))
    }

    /// Draws surfaces of the device.
    ///
    /// # Errors
    /// [`GpuError`] when the maps do not fit the device.
    pub fn draw_surfaces(gpu: &Gpu, surfaces: &[(&Surface, f32)], space: &MapSpace) -> Result<Self, GpuError> {
        Self::draw_into(gpu, BodyMaps::new(&gpu.device, space)?, surfaces)
    }

    /// Draws surfaces of the device into maps.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    pub fn draw_into(gpu: &Gpu, maps: BodyMaps, surfaces: &[(&Surface, f32)]) -> Result<Self, GpuError> {
        let map_box = maps.space().map_box;
        gpu.run(|encoder| maps.record(&gpu.device, encoder, map_box, surfaces))?;
        let read = read_maps(gpu, &maps, map_box)?;
        Ok(Self { maps: Arc::new(maps), read })
    }

    /// The texels of the papers' maps.
    ///
    /// # Panics
    /// When the maps are layered.
    pub fn sides(&self) -> &SideMaps {
        match &self.read {
            maps::BodyMaps::Sides(sides) => sides,
            maps::BodyMaps::Layers(_) => panic!("these maps are layered"),
        }
    }

    /// The texels of layered maps.
    ///
    /// # Panics
    /// When the maps are the papers'.
    pub fn layers(&self) -> &LayerMaps {
        match &self.read {
            maps::BodyMaps::Layers(layers) => layers,
            maps::BodyMaps::Sides(_) => panic!("these maps are the papers'"),
        }
    }
}

/// The texels of maps that show the bodies in `map_box`.
///
/// # Errors
/// [`GpuError::Device`] when the device is lost.
pub fn read_maps(gpu: &Gpu, maps: &BodyMaps, map_box: MapBox) -> Result<maps::BodyMaps, GpuError> {
    let (device, queue) = (&gpu.device, &gpu.queue);
    Ok(match maps.space().kind {
        MapKind::Sides => maps::BodyMaps::Sides(SideMaps {
            map_box: SideBox::of(&map_box),
            depth: readback::read_depth(device, queue, maps)?,
            normals: readback::read_normals(device, queue, maps)?,
            velocities: readback::read_velocities(device, queue, maps)?,
        }),
        MapKind::Layers => {
            let columns = readback::read_columns(device, queue, maps)?;
            let layers = readback::read_layers(device, queue, maps, &columns)?;
            let mut read = LayerMaps {
                map_box,
                columns: Vec::with_capacity(columns.len()),
                depths: Vec::with_capacity(layers.len()),
                normals: Vec::with_capacity(layers.len()),
                velocities: maps.is_moving().then(Vec::new),
            };
            // The device lays the columns one after the other as they come; here they stand in order.
            for [first, end_count, sheet_count] in columns {
                let seen = &layers[first as usize..(first + end_count + sheet_count) as usize];
                let first = if seen.is_empty() { 0 } else { read.depths.len() as u32 };
                read.columns.push(Column { first, end_count, sheet_count });
                read.depths.extend(seen.iter().map(|layer| layer.depth));
                read.normals.extend(seen.iter().map(|layer| layer.normal));
                if let Some(velocities) = &mut read.velocities {
                    velocities.extend(seen.iter().map(|layer| layer.velocity));
                }
            }
            maps::BodyMaps::Layers(read)
        }
    })
}
