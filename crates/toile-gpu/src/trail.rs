//! How fast a surface on the device moves: from where its vertices were and where they are. W §4.3.

use crate::contents::uniform;
use crate::{Pass, Program};
use toile_kernels::{Kernel, structs};
use wgpu::util::DeviceExt;

/// The velocities of a surface whose positions are a buffer on the device, such as a body or an inner garment.
#[derive(Debug)]
pub struct Trail {
    positions: wgpu::Buffer,
    last_positions: wgpu::Buffer,
    velocities: wgpu::Buffer,
    vertices: wgpu::Buffer,
    vertex_count: u32,
    program: Program,
    group: wgpu::BindGroup,
}

impl Trail {
    /// The trail of `vertex_count` positions, vec4 each, in a buffer of usage `STORAGE | COPY_SRC`. All velocities are zero.
    pub fn new(device: &wgpu::Device, positions: &wgpu::Buffer, vertex_count: u32) -> Self {
        let size = 16 * u64::from(vertex_count);
        let buffer = |label, usage| {
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        use wgpu::BufferUsages as Usage;
        let last_positions = buffer("last_positions", Usage::STORAGE | Usage::COPY_DST);
        let velocities = buffer("surface_velocities", Usage::STORAGE | Usage::VERTEX | Usage::COPY_SRC);
        let vertices = vertices_uniform(device, vertex_count);
        let program = Program::new(device, Kernel::VertexVelocities);
        let group = program.bind(device, |binding| {
            let buffer = match binding.name.as_str() {
                "vertices" => return vertices.as_entire_binding(),
                "last_positions" => &last_positions,
                "surface_positions" => positions,
                "surface_velocities" => &velocities,
                other => panic!("a trail has no {other}"),
            };
            sized(buffer, size)
        });
        Self { positions: positions.clone(), last_positions, velocities, vertices, vertex_count, program, group }
    }

    /// Records that the surface is about to move: where it is now is where it was.
    pub fn record_leaving(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.positions, 0, &self.last_positions, 0, self.last_positions.size());
    }

    /// Records the velocities of a surface that has arrived `seconds` after it left; 0 for one that did not move.
    pub fn record_arrival(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, seconds: f64) {
        let rate = if seconds > 0.0 { (1.0 / seconds) as f32 } else { 0.0 };
        let upload = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("vertices upload"),
            contents: &uniform(&structs::Vertices { count: self.vertex_count, rate }),
            usage: wgpu::BufferUsages::COPY_SRC,
        });
        encoder.copy_buffer_to_buffer(&upload, 0, &self.vertices, 0, upload.size());
        let mut compute = encoder.begin_compute_pass(&Default::default());
        dispatch(&mut compute, &self.program, &self.group, Kernel::VertexVelocities, self.vertex_count);
    }

    /// Velocities [m/s], vec4 each, xyz used.
    pub fn velocities(&self) -> &wgpu::Buffer {
        &self.velocities
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.last_positions.size() + self.velocities.size() + self.vertices.size()
    }
}

/// A uniform that says how many vertices there are.
pub(crate) fn vertices_uniform(device: &wgpu::Device, count: u32) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("vertices"),
        contents: &uniform(&structs::Vertices { count, rate: 0.0 }),
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
    })
}

/// The first bytes of a buffer: wgpu makes vertex buffers a word longer than asked for.
pub(crate) fn sized(buffer: &wgpu::Buffer, size: u64) -> wgpu::BindingResource<'_> {
    wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset: 0, size: wgpu::BufferSize::new(size) })
}

/// Dispatches a kernel over all vertices.
pub(crate) fn dispatch(
    compute: &mut wgpu::ComputePass<'_>,
    program: &Program,
    group: &wgpu::BindGroup,
    kernel: Kernel,
    vertex_count: u32,
) {
    let [x, y] = Pass::over(kernel, vertex_count).workgroups();
    compute.set_pipeline(program.pipeline());
    compute.set_bind_group(0, group, &[]);
    compute.dispatch_workgroups(x, y, 1);
}
