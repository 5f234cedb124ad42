//! What a renderer draws.

use toile_gpu::Surface;

/// What a renderer draws: buffers on the device that hold the state at the end of the last recorded frame.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Frame {
    /// Positions [m], vec4 each, xyz used, w the inverse mass [1/kg]; usage `VERTEX | STORAGE | COPY_SRC | COPY_DST`.
    pub positions: wgpu::Buffer,
    /// Unit normals out of the cloth, vec4 each, xyz used; zero before the first frame. Usage `VERTEX | STORAGE | COPY_SRC | COPY_DST`.
    pub normals: wgpu::Buffer,
    /// Particle indices (u32), three per triangle, counter-clockwise seen from outside; usage `INDEX | STORAGE | COPY_SRC`. Cloths of equal models share
    /// it, so a host only reads it.
    pub indices: wgpu::Buffer,
    /// Number of particles.
    pub particle_count: u32,
    /// Number of indices.
    pub index_count: u32,
}

impl Frame {
    /// The cloth as something that a later cloth collides with, at rest.
    pub fn surface(&self, device: &wgpu::Device) -> Surface {
        Surface::of_cloth(device, [&self.positions, &self.normals, &self.indices], self.index_count)
    }
}
