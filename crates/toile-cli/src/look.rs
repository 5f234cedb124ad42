//! A cloth as it is now, on the device or in the reference.

use crate::adapter::Gpu;
use anyhow::Result;
use glam::Vec3;
use toile::Cloth;
use toile::gpu::readback;
use toile::model::{Model, Status, StepSettings};

/// A cloth as it is now.
pub struct Look<'a> {
    /// Name of the garment or sheet.
    pub name: &'a str,
    /// What is simulated.
    pub model: &'a Model,
    /// The numbers of its steps.
    pub settings: StepSettings,
    /// What it reported last.
    pub status: Status,
}

/// Positions, normals and contacts of a cloth.
#[derive(Clone, Debug, Default)]
pub struct State {
    /// Positions [m], shape [particle_count].
    pub positions: Vec<Vec3>,
    /// Unit normals, shape [particle_count].
    pub normals: Vec<Vec3>,
    /// Which particles are in contact by the maps, shape [particle_count]; empty without a body.
    pub touching: Vec<bool>,
}

impl State {
    /// Reads a cloth back.
    pub fn of(gpu: &Gpu, cloth: &Cloth) -> Result<Self> {
        let read = |buffer: &wgpu::Buffer| readback::read_vec4s(&gpu.device, &gpu.queue, buffer);
        let vectors = |buffer: &wgpu::Buffer| -> Result<Vec<Vec3>> {
            Ok(read(buffer)?.into_iter().map(|value| value.truncate()).collect())
        };
        let touching = match cloth.contacts() {
            Some(buffer) => read(buffer)?.chunks_exact(2).map(|contact| contact[0].w > 0.0).collect(),
            None => Vec::new(),
        };
        let frame = cloth.frame();
        Ok(Self { positions: vectors(&frame.positions)?, normals: vectors(&frame.normals)?, touching })
    }
}
