//! The buffers of a plan: those that its kernels name, and no other.

use crate::contents::{constant, encoded, lag, uniform, words};
use crate::{GpuError, Kernels, Plan};
use std::collections::BTreeMap;
use std::sync::Arc;
use toile_kernels::{Binding, Interface, Per, Resource, Role, WORKGROUP_SIZE, buffer_row};
use toile_model::{Model, ShapeStep, StepSettings};
use toile_scene::Shape;
use wgpu::util::DeviceExt;

/// Bytes of which each entry of a buffer with entries is a multiple: the alignment that every WebGPU device accepts.
const ENTRY_ALIGNMENT: u64 = 256;

/// What the buffers of a cloth are made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start<'a> {
    pub(crate) model: &'a Model,
    pub(crate) settings: &'a StepSettings,
    pub(crate) plan: &'a Plan,
    pub(crate) shapes: &'a [Shape],
    /// Whether shapes are sampled after maps.
    pub(crate) after_maps: bool,
}

/// Buffers by the global name that the kernels give them.
#[derive(Debug)]
pub(crate) struct Buffers {
    by_name: BTreeMap<&'static str, Made>,
}

#[derive(Debug)]
struct Made {
    /// Of a constant role: that of other cloths, too.
    buffer: Arc<wgpu::Buffer>,
    role: Role,
    /// Bytes that a dispatch sees, and from one entry to the next.
    seen: u64,
    stride: u64,
}

impl Buffers {
    /// Creates and fills the buffers that these bindings name; constant ones are shared.
    pub(crate) fn new<'a>(
        kernels: &Kernels,
        start: Start<'_>,
        bindings: impl Iterator<Item = &'a Binding>,
    ) -> Result<Self, GpuError> {
        let mut by_name = BTreeMap::new();
        let most = kernels.device().limits().max_storage_buffer_binding_size;
        for (name, resource) in named(bindings) {
            let contents = Contents::of(name, resource, start);
            let needed = contents.size();
            if needed > most {
                return Err(GpuError::BufferTooLarge { name: name.to_owned(), needed, available: most });
            }
            by_name.insert(name, contents.make(kernels, name, resource));
        }
        Ok(Self { by_name })
    }

    /// Takes the constant buffers of another model in the place of these, which stay as they are for whoever shares them.
    ///
    /// # Panics
    /// When one has another size.
    pub(crate) fn take_constants<'a>(
        &mut self,
        kernels: &Kernels,
        start: Start<'_>,
        bindings: impl Iterator<Item = &'a Binding>,
    ) {
        for (name, resource) in named(bindings).into_iter().filter(|(name, _)| buffer_row(name).role.is_constant()) {
            let contents = Contents::of(name, resource, start);
            let made = self.by_name.get_mut(name).expect("a plan keeps its buffers");
            assert_eq!(contents.seen, made.seen, "{name} has another size: the model is one of another cloth");
            *made = contents.make(kernels, name, resource);
        }
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
        self.by_name.get(name).map(|made| &*made.buffer)
    }

    /// What a kernel binds of the buffer of a name: all of it, or one entry.
    pub(crate) fn binding(&self, name: &str) -> wgpu::BindingResource<'_> {
        let made = self.by_name.get(name).unwrap_or_else(|| panic!("no kernel of this plan has a buffer named {name}"));
        // Not "the rest of the buffer": wgpu makes vertex buffers a word longer than asked for, and arrayLength
        // would count that word, which nobody cleared.
        let size = wgpu::BufferSize::new(made.seen);
        wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer: &made.buffer, offset: 0, size })
    }

    /// Bytes from one entry to the next of the buffer with this role; 0 where there is none.
    pub(crate) fn stride(&self, role: Role) -> u32 {
        self.of_role(role).next().map_or(0, |(_, made)| made.stride as u32)
    }

    /// The buffers of a role, in the order of their names.
    pub(crate) fn of(&self, role: Role) -> impl Iterator<Item = (&'static str, &wgpu::Buffer)> {
        self.of_role(role).map(|(name, made)| (name, &*made.buffer))
    }

    fn of_role(&self, role: Role) -> impl Iterator<Item = (&'static str, &Made)> {
        self.by_name.iter().filter(move |(_, made)| made.role == role).map(|(name, made)| (*name, made))
    }

    /// Those that cloths share.
    pub(crate) fn shared(&self) -> impl Iterator<Item = &wgpu::Buffer> {
        self.by_name.values().filter(|made| made.role.is_constant()).map(|made| &*made.buffer)
    }

    /// Bytes of all buffers.
    pub(crate) fn bytes(&self) -> u64 {
        self.by_name.values().map(|made| made.buffer.size()).sum()
    }

    /// Name and bytes of each buffer.
    pub(crate) fn sizes(&self) -> impl Iterator<Item = (&str, u64)> {
        self.by_name.iter().map(|(name, made)| (*name, made.buffer.size()))
    }
}

impl Plan {
    /// Name and bytes of each buffer that a solver of this plan creates among these shapes, by name. It needs no device.
    pub fn buffer_sizes(&self, model: &Model, settings: &StepSettings, shapes: &[Shape]) -> BTreeMap<String, u64> {
        let bindings: Vec<Binding> =
            self.kernels().into_iter().flat_map(|kernel| Interface::of(kernel).bindings).collect();
        let start = Start { model, settings, plan: self, shapes, after_maps: false };
        let size = |(name, resource): (&'static str, _)| (name.to_owned(), Contents::of(name, resource, start).size());
        named(bindings.iter()).into_iter().map(size).collect()
    }
}

/// The shapes of a step, as an entry of their buffer.
pub(crate) fn shape_entry(shapes: &[Shape], step: u64, settings: &StepSettings) -> Vec<u8> {
    encoded(&shapes.iter().map(|shape| ShapeStep::of(shape, step, settings)).collect::<Vec<_>>())
}

/// Entries one after the other, each at its alignment.
pub(crate) fn aligned(entries: impl IntoIterator<Item = Vec<u8>>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for entry in entries {
        bytes.extend(entry);
        bytes.resize(bytes.len().next_multiple_of(ENTRY_ALIGNMENT as usize), 0);
    }
    bytes
}

/// The buffers among bindings, but those that others bring.
fn named<'a>(bindings: impl Iterator<Item = &'a Binding>) -> BTreeMap<&'static str, Resource> {
    bindings
        .filter(|binding| matches!(binding.resource, Resource::Uniform { .. } | Resource::Storage { .. }))
        .map(|binding| (buffer_row(&binding.name), binding.resource))
        .filter(|(row, _)| row.role != Role::Brought)
        .map(|(row, resource)| (row.name, resource))
        .collect()
}

/// What a buffer holds at the start.
struct Contents {
    role: Role,
    /// `None` is zeros.
    bytes: Option<Vec<u8>>,
    /// Bytes that a dispatch sees.
    seen: u64,
    /// Bytes of all entries.
    all: u64,
}

impl Contents {
    fn of(name: &'static str, resource: Resource, start: Start<'_>) -> Self {
        let row = buffer_row(name);
        let Start { model, settings, plan, shapes, after_maps } = start;
        let stride = u64::from(resource.stride());
        let entries = |seen: u64, entries: Vec<Vec<u8>>| {
            let bytes = aligned(entries);
            Self { role: row.role, seen, all: bytes.len() as u64, bytes: Some(bytes) }
        };
        match row.role {
            Role::PerSpan => return entries(stride, plan.spans.iter().map(uniform).collect()),
            Role::PerStepLeft => {
                return entries(stride, (0..settings.steps_per_frame).map(|left| lag(left, settings)).collect());
            }
            Role::PerStep => {
                let entry = shape_entry(shapes, 0, settings);
                return entries(stride * shapes.len() as u64, vec![entry; settings.steps_per_frame as usize]);
            }
            _ => {}
        }
        let particles = u64::from(model.particle_count());
        let count = match row.per {
            Per::Cloth => 1,
            Per::Particle => particles,
            Per::Quad => u64::from(model.quad_count()),
            Per::Point => particles + u64::from(model.quad_count()),
            Per::Limit => model.limits.len() as u64,
            Per::Node => particles + model.coarse_particles.len() as u64,
            Per::Workgroup => particles.div_ceil(u64::from(WORKGROUP_SIZE)),
            Per::GrantedPass => plan.granted().count() as u64,
            Per::Listed => 0,
        };
        let bytes = if name == "sweep_workgroups" {
            let granted = plan.granted().map(|pass| pass.workgroups());
            Some(words(&granted.flat_map(|[x, y]| [x, y, 1, 0]).collect::<Vec<_>>()))
        } else {
            constant(name, model, settings, after_maps)
        };
        let size = match &bytes {
            Some(bytes) => bytes.len() as u64,
            None => {
                assert!(!row.role.is_constant(), "the constant buffer {name} has contents");
                // The state is read and written in whole vec4.
                (stride * count).next_multiple_of(if row.role == Role::State { 16 } else { 4 })
            }
        };
        // Not less than a vec4: a binding cannot be empty.
        let size = size.max(16);
        Self { role: row.role, bytes, seen: size, all: size }
    }

    fn size(&self) -> u64 {
        self.all.max(16)
    }

    fn make(self, kernels: &Kernels, name: &'static str, resource: Resource) -> Made {
        use wgpu::BufferUsages as Usage;
        let kind = match resource {
            Resource::Uniform { .. } => Usage::UNIFORM,
            _ => Usage::STORAGE,
        };
        let usage = match self.role {
            Role::Dispatches => Usage::INDIRECT,
            // No copy can write what cloths share.
            Role::Constant | Role::PerSpan | Role::PerStepLeft => Usage::empty(),
            Role::Numbers | Role::PerStep => Usage::COPY_DST,
            // Positions and normals are drawn by the host and by the maps of a later garment.
            Role::State | Role::Output | Role::Scratch | Role::Brought => {
                Usage::VERTEX | Usage::COPY_SRC | Usage::COPY_DST
            }
        } | kind;
        let (size, role, seen) = (self.size(), self.role, self.seen);
        let stride = seen.next_multiple_of(ENTRY_ALIGNMENT);
        let (device, label) = (kernels.device(), Some(name));
        let buffer = match self.bytes {
            Some(mut bytes) => {
                bytes.resize(size as usize, 0);
                if role.is_constant() {
                    kernels.constant(name, &bytes, usage)
                } else {
                    let descriptor = wgpu::util::BufferInitDescriptor { label, contents: &bytes, usage };
                    Arc::new(device.create_buffer_init(&descriptor))
                }
            }
            None => {
                let descriptor = wgpu::BufferDescriptor { label, size, usage, mapped_at_creation: false };
                Arc::new(device.create_buffer(&descriptor))
            }
        };
        Made { buffer, role, seen, stride }
    }
}
