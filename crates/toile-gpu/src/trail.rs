//! How fast a surface on the device moves: from where its vertices were and where they are. W §4.3.

use crate::contents::uniform;
use crate::{Kernels, Pass, Program};
use toile_kernels::{Kernel, structs};
use wgpu::util::DeviceExt;

/// The velocities of a surface whose positions are a buffer on the device, such as a body or an inner garment.
#[derive(Debug)]
pub struct Trail {
    positions: wgpu::Buffer,
    last_positions: wgpu::Buffer,
    velocities: wgpu::Buffer,
    vertex_count: u32,
    program: Program,
    /// What the last arrival was recorded with: hosts move a surface at an even pace.
    last: Pace,
}

/// The vertices at a pace, which never changes: commands that are recorded already keep theirs.
#[derive(Debug)]
struct Pace {
    rate: f32,
    group: wgpu::BindGroup,
}

impl Trail {
    /// The trail of `vertex_count` positions, vec4 each, in a buffer of usage `STORAGE | COPY_SRC`. All velocities are zero.
    pub fn new(kernels: impl Into<Kernels>, positions: &wgpu::Buffer, vertex_count: u32) -> Self {
        let kernels = kernels.into();
        let device = kernels.device();
        let size = 16 * u64::from(vertex_count);
        let buffer = |label, usage| {
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        use wgpu::BufferUsages as Usage;
        let last_positions = buffer("last_positions", Usage::STORAGE | Usage::COPY_DST);
        let velocities = buffer("surface_velocities", Usage::STORAGE | Usage::VERTEX | Usage::COPY_SRC);
        let program = kernels.program(Kernel::VertexVelocities);
        let last = Pace::new(device, &program, [positions, &last_positions, &velocities], vertex_count, 0.0);
        Self { positions: positions.clone(), last_positions, velocities, vertex_count, program, last }
    }

    /// Records that the surface is about to move: where it is now is where it was.
    pub fn record_leaving(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.copy_buffer_to_buffer(&self.positions, 0, &self.last_positions, 0, self.last_positions.size());
    }

    /// Records the velocities of a surface that has arrived `seconds` after it left; 0 for one that did not move.
    pub fn record_arrival(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, seconds: f64) {
        let rate = if seconds > 0.0 { (1.0 / seconds) as f32 } else { 0.0 };
        if rate != self.last.rate {
            let buffers = [&self.positions, &self.last_positions, &self.velocities];
            self.last = Pace::new(device, &self.program, buffers, self.vertex_count, rate);
        }
        let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("velocities of a surface"),
            timestamp_writes: None,
        });
        dispatch(&mut compute, &self.program, &self.last.group, Kernel::VertexVelocities, self.vertex_count);
    }

    /// Velocities [m/s], vec4 each, xyz used.
    pub fn velocities(&self) -> &wgpu::Buffer {
        &self.velocities
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.last_positions.size() + self.velocities.size() + VERTICES_BYTES
    }
}

impl Pace {
    /// The vertices of a surface whose positions, last positions and velocities are these buffers.
    fn new(device: &wgpu::Device, program: &Program, buffers: [&wgpu::Buffer; 3], count: u32, rate: f32) -> Self {
        let [positions, last_positions, velocities] = buffers;
        let vertices = vertices_uniform(device, count, rate);
        let group = program.bind(device, |binding| {
            let buffer = match binding.name.as_str() {
                "vertices" => return vertices.as_entire_binding(),
                "last_positions" => last_positions,
                "surface_positions" => positions,
                "surface_velocities" => velocities,
                other => panic!("a trail has no {other}"),
            };
            sized(buffer, 16 * u64::from(count))
        });
        Self { rate, group }
    }
}

/// Bytes of the vertices' uniform.
const VERTICES_BYTES: u64 = 8;

/// A uniform that says how many vertices there are, and how many times they move in a second.
pub(crate) fn vertices_uniform(device: &wgpu::Device, count: u32, rate: f32) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("vertices"),
        contents: &uniform(&structs::Vertices { count, rate }),
        usage: wgpu::BufferUsages::UNIFORM,
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
