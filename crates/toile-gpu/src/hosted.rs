//! A body that the host skins: its vertices are taken out of the host's own buffers.

use crate::contents::uniform;
use crate::slot::Slot;
use crate::trail::{dispatch, sized};
use crate::{GpuError, Kernels, Program, Surface};
use glam::Vec3;
use toile_kernels::{Kernel, structs};
use wgpu::util::DeviceExt;

/// Bytes of three numbers of a vertex.
const ATTRIBUTE_BYTES: u64 = 12;

/// Where the host has three `f32` of each vertex.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct HostAttribute {
    /// The buffer, of usage `STORAGE`; several attributes may lie in one.
    pub buffer: wgpu::Buffer,
    /// Where the first vertex has them [bytes]; a multiple of 4.
    pub offset: u64,
    /// From one vertex to the next [bytes]; a multiple of 4, at least 12.
    pub stride: u64,
}

impl HostAttribute {
    /// An attribute of vertices that lie `stride` bytes apart, from `offset` on.
    pub fn new(buffer: &wgpu::Buffer, offset: u64, stride: u64) -> Self {
        Self { buffer: buffer.clone(), offset, stride }
    }
}

/// How the host tells the motion of its vertices.
#[derive(Clone, Debug, PartialEq)]
pub enum HostMotion {
    /// By velocities [m/s].
    Velocities(HostAttribute),
    /// By the positions that the vertices had before the last seconds of the host [m].
    LastPositions(HostAttribute),
}

/// The vertices of a body that the host skins, in metres, y up. They are read when commands run, so that a host skins into the same buffers, earlier in the
/// same encoder.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct HostVertices {
    /// Positions [m].
    pub positions: HostAttribute,
    /// Normals, of any length.
    pub normals: HostAttribute,
    /// How they move. Without it a body stands still from one interval of the maps to the next, up to a sixtieth of a second behind.
    pub motion: Option<HostMotion>,
}

impl HostVertices {
    /// Vertices whose motion is not told.
    pub fn new(positions: HostAttribute, normals: HostAttribute) -> Self {
        Self { positions, normals, motion: None }
    }
}

/// What takes the vertices out of the host's buffers.
#[derive(Debug)]
pub(crate) struct Hosted {
    program: Program,
    vertex_count: u32,
    given: Option<Given>,
    /// Positions on their way back, for the box around them.
    report: Slot,
}

/// What the host has given last.
#[derive(Debug)]
struct Given {
    vertices: HostVertices,
    /// The time that they show [s].
    time: f64,
    /// Time since the positions before [s].
    seconds: f64,
}

impl Hosted {
    pub(crate) fn new(kernels: &Kernels, vertex_count: u32) -> Self {
        let report = Slot::new(kernels.device(), "body readback", 16 * u64::from(vertex_count));
        Self { program: kernels.program(Kernel::GatherBody), vertex_count, given: None, report }
    }

    /// Has the next poses be those of the host.
    pub(crate) fn give(
        &mut self,
        device: &wgpu::Device,
        vertices: &HostVertices,
        time: f64,
        seconds: f64,
    ) -> Result<(), GpuError> {
        let motion = vertices.motion.as_ref().map(|motion| match motion {
            HostMotion::Velocities(attribute) | HostMotion::LastPositions(attribute) => attribute,
        });
        let attributes = [(&vertices.positions, "positions"), (&vertices.normals, "normals")];
        for (attribute, name) in attributes.into_iter().chain(motion.map(|motion| (motion, "motion"))) {
            self.check(device, attribute, name)?;
        }
        self.given = Some(Given { vertices: vertices.clone(), time, seconds });
        Ok(())
    }

    fn check(&self, device: &wgpu::Device, attribute: &HostAttribute, name: &str) -> Result<(), GpuError> {
        let HostAttribute { buffer, offset, stride } = attribute;
        assert!(
            offset % 4 == 0 && stride % 4 == 0 && *stride >= ATTRIBUTE_BYTES,
            "the {name} of a body are three f32 each: offset {offset} and stride {stride} are multiples of 4, the stride at least 12"
        );
        assert!(
            buffer.usage().contains(wgpu::BufferUsages::STORAGE),
            "the {name} of a body lie in a buffer of usage STORAGE"
        );
        let end = self.end(attribute);
        assert!(
            end <= buffer.size(),
            "the {name} of {} vertices end at {end} bytes, and their buffer has {}",
            self.vertex_count,
            buffer.size()
        );
        let (start, available) = (window_start(device, attribute), device.limits().max_storage_buffer_binding_size);
        match end - start > available {
            true => {
                Err(GpuError::BufferTooLarge { name: format!("{name} of the body"), needed: end - start, available })
            }
            false => Ok(()),
        }
    }

    /// Where the last vertex ends in the buffer [bytes].
    fn end(&self, attribute: &HostAttribute) -> u64 {
        attribute.offset + attribute.stride * u64::from(self.vertex_count.max(1) - 1) + ATTRIBUTE_BYTES
    }

    /// Records the vertices as they will be at a time [s]; until the host has given any they stay where they are.
    pub(crate) fn record(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        surface: &Surface,
        time: f64,
    ) {
        let Some(Given { vertices, time: shown, seconds }) = &self.given else { return };
        let ahead = time - shown;
        let (motion, is_last, ahead) = match &vertices.motion {
            Some(HostMotion::Velocities(velocities)) => (velocities, 0, ahead),
            Some(HostMotion::LastPositions(last)) if *seconds > 0.0 => (last, 1, ahead / seconds),
            Some(HostMotion::LastPositions(_)) | None => (&vertices.positions, 0, 0.0),
        };
        let first = |attribute: &HostAttribute| ((attribute.offset - window_start(device, attribute)) / 4) as u32;
        let stride = |attribute: &HostAttribute| (attribute.stride / 4) as u32;
        let gather = structs::Gather {
            count: self.vertex_count,
            first_position: first(&vertices.positions),
            position_stride: stride(&vertices.positions),
            first_normal: first(&vertices.normals),
            normal_stride: stride(&vertices.normals),
            first_motion: first(motion),
            motion_stride: stride(motion),
            is_last,
            ahead: ahead as f32,
        };
        let gather = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("gather"),
            contents: &uniform(&gather),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let window = |attribute| {
            let offset = window_start(device, attribute);
            let size = wgpu::BufferSize::new(self.end(attribute) - offset);
            wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer: &attribute.buffer, offset, size })
        };
        let size = 16 * u64::from(self.vertex_count);
        let group = self.program.bind(device, |binding| match binding.name.as_str() {
            "gather" => gather.as_entire_binding(),
            "host_positions" => window(&vertices.positions),
            "host_normals" => window(&vertices.normals),
            "host_motions" => window(motion),
            "body_positions" => sized(&surface.positions, size),
            "body_normals" => sized(&surface.normals, size),
            other => panic!("a body that the host skins has no {other}"),
        });
        let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some("a body that the host skins"),
            timestamp_writes: None,
        });
        dispatch(&mut compute, &self.program, &group, Kernel::GatherBody, self.vertex_count);
    }

    /// Asks for the box around the vertices as they are now; whether nothing else is under way.
    pub(crate) fn record_bounds(&self, encoder: &mut wgpu::CommandEncoder, surface: &Surface) -> bool {
        let is_free = self.report.is_free();
        if is_free {
            self.report.record(encoder, |encoder, target| {
                encoder.copy_buffer_to_buffer(&surface.positions, 0, target, 0, target.size());
            });
        }
        is_free
    }

    /// The smallest and largest corner of what was asked for, once, when it has arrived [m].
    pub(crate) fn take_bounds(&self) -> Option<[Vec3; 2]> {
        self.report.take(|bytes| {
            let words: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(bytes);
            let places = || words.iter().map(|[x, y, z, _]| Vec3::new(*x, *y, *z)).filter(|place| place.is_finite());
            Some([places().reduce(Vec3::min)?, places().reduce(Vec3::max)?])
        })
    }

    /// Bytes on the device.
    pub(crate) fn bytes(&self) -> u64 {
        16 * u64::from(self.vertex_count)
    }
}

/// Where the binding of an attribute begins: a device binds from whole multiples of some bytes on.
fn window_start(device: &wgpu::Device, attribute: &HostAttribute) -> u64 {
    let alignment = u64::from(device.limits().min_storage_buffer_offset_alignment);
    attribute.offset / alignment * alignment
}
