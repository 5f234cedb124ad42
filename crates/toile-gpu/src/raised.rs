//! A surface on the device, a little way out along its normals: a thick cloth as a thinner one over it sees it.

use crate::contents::uniform;
use crate::trail::{dispatch, sized};
use crate::{Kernels, Program};
use toile_kernels::{Kernel, structs};
use wgpu::util::DeviceExt;

/// Positions and unit normals of a surface that is raised along its normals.
#[derive(Debug)]
pub struct Raised {
    positions: wgpu::Buffer,
    normals: wgpu::Buffer,
    vertex_count: u32,
    program: Program,
    group: wgpu::BindGroup,
}

impl Raised {
    /// The surface of `vertex_count` positions and normals, vec4 each, in buffers of usage `STORAGE`, by a way [m].
    pub fn new(
        kernels: impl Into<Kernels>,
        [positions, normals]: [&wgpu::Buffer; 2],
        vertex_count: u32,
        way: f32,
    ) -> Self {
        let kernels = kernels.into();
        let device = kernels.device();
        let size = 16 * u64::from(vertex_count);
        let buffer = |label| {
            let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_SRC;
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let raised = [buffer("raised positions"), buffer("raised normals")];
        // Its vertices go along their normals, as those of a body go ahead by their velocities.
        let gather = structs::Gather {
            count: vertex_count,
            position_stride: 4,
            normal_stride: 4,
            motion_stride: 4,
            ahead: way,
            ..structs::Gather::default()
        };
        let gather = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("gather"),
            contents: &uniform(&gather),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let program = kernels.program(Kernel::GatherBody);
        let group = program.bind(device, |binding| match binding.name.as_str() {
            "gather" => gather.as_entire_binding(),
            "host_positions" => sized(positions, size),
            "host_normals" | "host_motions" => sized(normals, size),
            "body_positions" => sized(&raised[0], size),
            "body_normals" => sized(&raised[1], size),
            other => panic!("a raised surface has no {other}"),
        });
        let [positions, normals] = raised;
        Self { positions, normals, vertex_count, program, group }
    }

    /// Records where it is now.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("a raised surface"),
            timestamp_writes: None,
        });
        dispatch(&mut compute, &self.program, &self.group, Kernel::GatherBody, self.vertex_count);
    }

    /// Positions [m], vec4 each, xyz used.
    pub fn positions(&self) -> &wgpu::Buffer {
        &self.positions
    }

    /// Unit normals, vec4 each, xyz used.
    pub fn normals(&self) -> &wgpu::Buffer {
        &self.normals
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        self.positions.size() + self.normals.size()
    }
}
