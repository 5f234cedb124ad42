//! The buffers of a plan: those that its kernels name, and no other.

use crate::{GpuError, Plan, step_params};
use encase::{ShaderType, StorageBuffer, UniformBuffer, internal::WriteInto};
use glam::{Vec3, Vec4};
use std::collections::BTreeMap;
use toile_kernels::{Binding, Interface, Resource, WORKGROUP_SIZE, structs};
use toile_model::{Model, StepSettings};
use toile_scene::Polish;
use wgpu::util::DeviceExt;

/// Bytes from one entry of a moving uniform to the next: the alignment that every WebGPU device accepts.
pub(crate) const MOVING_UNIFORM_STRIDE: u64 = 256;

/// Bytes from one entry of `sweep_dispatches` to the next: three words for the dispatch, and one that fills the vec4.
pub(crate) const DISPATCH_STRIDE: u64 = 16;

/// Buffers by the global name that the kernels give them.
#[derive(Debug)]
pub(crate) struct Buffers {
    by_name: BTreeMap<String, wgpu::Buffer>,
}

impl Buffers {
    /// Creates and fills the buffers that these bindings name.
    pub(crate) fn new<'a>(
        device: &wgpu::Device,
        model: &Model,
        settings: &StepSettings,
        plan: &Plan,
        bindings: impl Iterator<Item = &'a Binding>,
    ) -> Result<Self, GpuError> {
        let mut by_name = BTreeMap::new();
        let most = device.limits().max_storage_buffer_binding_size;
        for (name, resource) in named(bindings) {
            let contents = contents(name, model, settings, plan);
            let size = contents.size();
            if size > most {
                return Err(GpuError::BufferTooLarge { name: name.to_owned(), needed: size, available: most });
            }
            by_name.insert(name.to_owned(), create(device, name, resource, contents));
        }
        Ok(Self { by_name })
    }

    /// The buffer of a name.
    ///
    /// # Panics
    /// When no kernel of the plan names it.
    pub(crate) fn get(&self, name: &str) -> &wgpu::Buffer {
        self.find(name).unwrap_or_else(|| panic!("no kernel of this plan has a buffer named {name}"))
    }

    /// The buffer of a name, if a kernel of the plan names it.
    pub(crate) fn find(&self, name: &str) -> Option<&wgpu::Buffer> {
        self.by_name.get(name)
    }

    /// Bytes of all buffers.
    pub(crate) fn bytes(&self) -> u64 {
        self.by_name.values().map(wgpu::Buffer::size).sum()
    }

    /// Name and bytes of each buffer.
    pub(crate) fn sizes(&self) -> impl Iterator<Item = (&str, u64)> {
        self.by_name.iter().map(|(name, buffer)| (name.as_str(), buffer.size()))
    }
}

impl Plan {
    /// Name and bytes of each buffer that a solver of this plan creates, by name. It needs no device.
    pub fn buffer_sizes(&self, model: &Model, settings: &StepSettings) -> BTreeMap<String, u64> {
        let bindings: Vec<Binding> =
            self.kernels().into_iter().flat_map(|kernel| Interface::of(kernel).bindings).collect();
        let size = |name: &str| contents(name, model, settings, self).size();
        named(bindings.iter()).into_keys().map(|name| (name.to_owned(), size(name))).collect()
    }
}

/// The buffers among bindings. The box of the maps lives with the maps.
fn named<'a>(bindings: impl Iterator<Item = &'a Binding>) -> BTreeMap<&'a str, Resource> {
    bindings
        .filter(|binding| matches!(binding.resource, Resource::Uniform { .. } | Resource::Storage { .. }))
        .filter(|binding| binding.name != "map_box")
        .map(|binding| (binding.name.as_str(), binding.resource))
        .collect()
}

/// What a buffer holds at the start.
enum Contents {
    Bytes(Vec<u8>),
    Zeros(u64),
}

impl Contents {
    /// Bytes of the buffer. Not less than a vec4: a binding cannot be empty.
    fn size(&self) -> u64 {
        let size = match self {
            Contents::Bytes(bytes) => bytes.len() as u64,
            Contents::Zeros(size) => *size,
        };
        size.max(16)
    }
}

fn create(device: &wgpu::Device, name: &str, resource: Resource, contents: Contents) -> wgpu::Buffer {
    let usage = match resource {
        _ if name == "sweep_dispatches" => wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT,
        Resource::Uniform { .. } => wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        // Positions and normals are drawn by the host and by the maps of a later garment.
        _ => {
            wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::VERTEX
                | wgpu::BufferUsages::COPY_SRC
                | wgpu::BufferUsages::COPY_DST
        }
    };
    let size = contents.size();
    match contents {
        Contents::Bytes(mut bytes) => {
            bytes.resize(size as usize, 0);
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(name), contents: &bytes, usage })
        }
        Contents::Zeros(_) => {
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(name), size, usage, mapped_at_creation: false })
        }
    }
}

/// What the buffer of a name holds at the start.
fn contents(name: &str, model: &Model, settings: &StepSettings, plan: &Plan) -> Contents {
    let particles = u64::from(model.particle_count());
    let quads = u64::from(model.quad_count());
    match name {
        "step" => uniform(&structs::StepParams {
            particle_count: model.particle_count(),
            quad_count: model.quad_count(),
            limit_count: model.limits.len() as u32,
            ..step_params(settings)
        }),
        "span" => Contents::Bytes(spans(plan)),
        "ball" | "lag" => Contents::Zeros(u64::from(settings.steps_per_frame) * MOVING_UNIFORM_STRIDE),
        "positions" => {
            Contents::Bytes(vec4s(model.positions.iter().zip(&model.inverse_masses).map(|(p, w)| p.extend(*w))))
        }
        "velocities" => Contents::Bytes(vec4s(model.masses.iter().map(|m| Vec3::ZERO.extend(*m)))),
        "forces" | "normals" | "position_copies" | "velocity_copies" => Contents::Zeros(16 * particles),
        "link_offsets" => words(&model.links.offsets),
        "link_others" => words(&model.links.values.iter().map(|l| l.other).collect::<Vec<_>>()),
        "link_springs" => {
            let spring =
                |l: &toile_model::Link| structs::LinkSpring { rest_length: l.rest_length, stiffness: l.stiffness };
            array(model.links.values.iter().map(spring).collect())
        }
        "limits" => {
            let limit = |l: &toile_model::Limit| structs::Limit {
                first: l.ends[0],
                second: l.ends[1],
                rest_length: l.rest_length,
                max_length: l.max_length,
            };
            array(model.limits.iter().map(limit).collect())
        }
        // Whole vec4, as contacts are: what a simulation goes on from is read and written by these.
        "limit_impulses" => Contents::Zeros(4 * (model.limits.len() as u64).next_multiple_of(4)),
        "strands" => {
            let strand = |s: &toile_model::Strand| structs::Strand {
                first: s.particles.start,
                count: s.particles.end - s.particles.start,
                lengths: s.lengths,
                level_count: s.level_count,
            };
            array(model.strands.iter().map(strand).collect())
        }
        "strand_particles" => words(&model.strand_particles),
        "strand_lengths" => Contents::Bytes(bytemuck::cast_slice(&model.strand_lengths).to_vec()),
        "attachment_offsets" => words(&model.attachments.offsets),
        "attachments" => {
            let attachment = |a: &toile_model::Attachment| structs::Attachment { pin: a.pin, max_length: a.max_length };
            array(model.attachments.values.iter().map(attachment).collect())
        }
        "seam_pairs" => {
            let pair = |s: &toile_model::SeamPair| structs::SeamPair {
                first: s.ends[0],
                second: s.ends[1],
                closing_speed: s.closing_speed,
            };
            array(model.seam_pairs.iter().map(pair).collect())
        }
        "holds" => {
            let hold = |h: &toile_model::Hold| structs::Hold {
                first: h.particles.start,
                count: h.particles.end - h.particles.start,
                height: h.height,
            };
            array(model.holds.iter().map(hold).collect())
        }
        "held_particles" => words(&model.held_particles),
        "quads" => Contents::Bytes(bytemuck::cast_slice(&model.quads).to_vec()),
        "particle_quad_offsets" => words(&model.particle_quads.offsets),
        "particle_quads" => words(&model.particle_quads.values),
        "quad_winds" => Contents::Zeros(16 * quads),
        "midpoints" => zeroed::<structs::Midpoint>(quads),
        "probes" => zeroed::<structs::Probe>(particles + quads),
        "contacts" => zeroed::<structs::Contact>(particles),
        "polish" => {
            let Polish { target, sweeps } = settings.polish.expect("its kernels are planned for a polish");
            uniform(&structs::Polish { target_elongation: target as f32, sweeps })
        }
        "polish_state" => zeroed::<structs::PolishState>(1),
        "sweep_workgroups" => {
            let granted = plan.granted().map(|pass| pass.workgroups());
            words(&granted.flat_map(|[x, y]| [x, y, 1, 0]).collect::<Vec<_>>())
        }
        "sweep_dispatches" => Contents::Zeros(DISPATCH_STRIDE * plan.granted().count() as u64),
        "status" => zeroed::<structs::Status>(1),
        "energy_partials" => Contents::Zeros(4 * particles.div_ceil(u64::from(WORKGROUP_SIZE))),
        other => panic!("the kernels name a buffer {other} that has no contents here"),
    }
}

fn spans(plan: &Plan) -> Vec<u8> {
    let mut bytes = Vec::new();
    for span in &plan.spans {
        bytes.extend(uniform_bytes(span));
        bytes.resize(bytes.len().next_multiple_of(MOVING_UNIFORM_STRIDE as usize), 0);
    }
    bytes
}

fn vec4s(values: impl Iterator<Item = Vec4>) -> Vec<u8> {
    bytemuck::cast_slice(&values.collect::<Vec<_>>()).to_vec()
}

fn words(values: &[u32]) -> Contents {
    Contents::Bytes(bytemuck::cast_slice(values).to_vec())
}

fn uniform<T: ShaderType + WriteInto>(value: &T) -> Contents {
    Contents::Bytes(uniform_bytes(value))
}

/// The bytes of a struct as a uniform buffer holds them.
pub(crate) fn uniform_bytes<T: ShaderType + WriteInto>(value: &T) -> Vec<u8> {
    let mut buffer = UniformBuffer::new(Vec::new());
    buffer.write(value).expect("a vector grows to what is written");
    buffer.into_inner()
}

fn array<T>(values: Vec<T>) -> Contents
where
    Vec<T>: ShaderType + WriteInto,
{
    let mut buffer = StorageBuffer::new(Vec::new());
    buffer.write(&values).expect("a vector grows to what is written");
    Contents::Bytes(buffer.into_inner())
}

fn zeroed<T: ShaderType>(count: u64) -> Contents {
    Contents::Zeros(T::min_size().get() * count)
}
