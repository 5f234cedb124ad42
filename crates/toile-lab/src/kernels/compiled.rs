//! One kernel alone on the device: its resources bound by name, what it writes read back.

use crate::Gpu;
use std::collections::BTreeMap;
use toile::gpu::{BodyMaps, GpuError, Pass, Program};
use toile_kernels::{Kernel, Resource};
use wgpu::util::DeviceExt;

/// What a kernel is given.
pub trait Inputs {
    /// Bytes of the buffer of a name.
    fn bytes(&self, name: &str) -> Vec<u8>;

    /// The maps that have the texture of a name, for kernels that look into them.
    fn maps(&self, name: &str) -> Option<&BodyMaps>;
}

/// A kernel compiled from any WGSL with that kernel's interface: its own, or a sabotaged one.
#[derive(Debug)]
pub struct Compiled {
    kernel: Kernel,
    program: Program,
}

impl Compiled {
    /// Compiles WGSL; `None` when it is not valid.
    pub fn new(gpu: &Gpu, kernel: Kernel, source: &str) -> Option<Self> {
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let program = Program::of_source(&gpu.device, kernel, source, &[]);
        let fault = pollster::block_on(scope.pop());
        fault.is_none().then(|| Self { kernel, program })
    }

    /// Runs the kernel on `items` items and gives the words of each buffer that it may write.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    ///
    /// # Panics
    /// When the kernel looks into maps and there are none.
    pub fn run(&self, gpu: &Gpu, items: u32, inputs: &impl Inputs) -> Result<BTreeMap<String, Vec<u32>>, GpuError> {
        let buffers: BTreeMap<&str, wgpu::Buffer> = self
            .program
            .interface()
            .bindings
            .iter()
            .filter_map(|binding| {
                let kind = match binding.resource {
                    Resource::Uniform { .. } => wgpu::BufferUsages::UNIFORM,
                    Resource::Storage { .. } => wgpu::BufferUsages::STORAGE,
                    _ => return None,
                };
                let mut contents = inputs.bytes(&binding.name);
                if contents.is_empty() {
                    // A binding cannot be empty; no item of it is ever read.
                    contents.resize(64, 0);
                }
                let buffer = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                    label: Some(&binding.name),
                    contents: &contents,
                    usage: kind | wgpu::BufferUsages::COPY_SRC,
                });
                Some((binding.name.as_str(), buffer))
            })
            .collect();
        let map = |name: &str| {
            let maps = inputs.maps(name).expect("a kernel with textures looks into maps");
            let texture = match name {
                "side_depths" | "layer_depths" => maps.depths(),
                "side_normals" | "layer_normals" => maps.normals(),
                "side_velocities" | "layer_velocities" => maps.velocities().expect("maps of moving bodies"),
                "layer_columns" => maps.columns().expect("layered maps"),
                other => panic!("the kernels name a texture {other} that the input does not know"),
            };
            let layered = texture.depth_or_array_layers() > 1;
            let dimension = if layered { wgpu::TextureViewDimension::D2Array } else { wgpu::TextureViewDimension::D2 };
            texture.create_view(&wgpu::TextureViewDescriptor { dimension: Some(dimension), ..Default::default() })
        };
        let views: BTreeMap<&str, wgpu::TextureView> = self
            .program
            .interface()
            .bindings
            .iter()
            .filter(|binding| !matches!(binding.resource, Resource::Uniform { .. } | Resource::Storage { .. }))
            .map(|binding| (binding.name.as_str(), map(&binding.name)))
            .collect();
        let group = self.program.bind(&gpu.device, |binding| match views.get(binding.name.as_str()) {
            Some(view) => wgpu::BindingResource::TextureView(view),
            None => buffers[binding.name.as_str()].as_entire_binding(),
        });
        let offsets: &[u32] = if self.program.offset_role().is_some() { &[0] } else { &[] };
        let [x, y] = Pass::over(self.kernel, items).workgroups();
        gpu.run(|encoder| {
            let mut compute = encoder.begin_compute_pass(&Default::default());
            compute.set_pipeline(self.program.pipeline());
            compute.set_bind_group(0, &group, offsets);
            compute.dispatch_workgroups(x, y, 1);
        })?;
        self.program
            .interface()
            .bindings
            .iter()
            .filter(|binding| matches!(binding.resource, Resource::Storage { written: true, .. }))
            .map(|binding| Ok((binding.name.clone(), gpu.words(&buffers[binding.name.as_str()])?)))
            .collect()
    }
}
