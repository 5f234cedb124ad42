//! One kernel alone on the device: its resources bound by name, what it writes read back.

use crate::Gpu;
use std::collections::BTreeMap;
use toile::gpu::{BodyMaps, GpuError, Pass};
use toile_kernels::{Interface, Kernel, Resource};
use wgpu::util::DeviceExt;

/// What a kernel is given.
pub trait Inputs {
    /// Bytes of the buffer of a name.
    fn bytes(&self, name: &str) -> Vec<u8>;

    /// The maps, for kernels that look into them.
    fn maps(&self) -> Option<&BodyMaps>;
}

/// A kernel compiled from any WGSL with that kernel's interface: its own, or a sabotaged one.
#[derive(Debug)]
pub struct Compiled {
    kernel: Kernel,
    interface: Interface,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl Compiled {
    /// Compiles WGSL; `None` when it is not valid.
    pub fn new(gpu: &Gpu, kernel: Kernel, source: &str) -> Option<Self> {
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(kernel.name()),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let interface = Interface::of(kernel);
        let entries: Vec<_> = interface.bindings.iter().map(layout_entry).collect();
        // Not the layout that wgpu infers: it leaves out what a kernel names but does not use.
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(kernel.name()),
            entries: &entries,
        });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(kernel.name()),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(kernel.name()),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(kernel.name()),
            compilation_options: Default::default(),
            cache: None,
        });
        let fault = pollster::block_on(scope.pop());
        fault.is_none().then(|| Self { kernel, interface, layout, pipeline })
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
            .interface
            .bindings
            .iter()
            .filter_map(|binding| {
                let kind = match binding.resource {
                    Resource::Uniform { .. } => wgpu::BufferUsages::UNIFORM,
                    Resource::Storage { .. } => wgpu::BufferUsages::STORAGE,
                    Resource::DepthTexture | Resource::FloatTexture => return None,
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
        let view =
            wgpu::TextureViewDescriptor { dimension: Some(wgpu::TextureViewDimension::D2Array), ..Default::default() };
        let map = |name: &str| {
            let maps = inputs.maps().expect("a kernel with textures looks into maps");
            let texture = match name {
                "depth_map" => maps.depth(),
                "normal_map" => maps.normals(),
                "velocity_map" => maps.velocities().expect("maps of moving bodies"),
                other => panic!("the kernels name a texture {other} that the input does not know"),
            };
            texture.create_view(&view)
        };
        let views: BTreeMap<&str, wgpu::TextureView> = self
            .interface
            .bindings
            .iter()
            .filter(|binding| matches!(binding.resource, Resource::DepthTexture | Resource::FloatTexture))
            .map(|binding| (binding.name.as_str(), map(&binding.name)))
            .collect();
        let entries: Vec<_> = self
            .interface
            .bindings
            .iter()
            .map(|binding| wgpu::BindGroupEntry {
                binding: binding.number,
                resource: match views.get(binding.name.as_str()) {
                    Some(view) => wgpu::BindingResource::TextureView(view),
                    None => buffers[binding.name.as_str()].as_entire_binding(),
                },
            })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.kernel.name()),
            layout: &self.layout,
            entries: &entries,
        });
        let [x, y] = Pass::over(self.kernel, items).workgroups();
        gpu.run(|encoder| {
            let mut compute = encoder.begin_compute_pass(&Default::default());
            compute.set_pipeline(&self.pipeline);
            compute.set_bind_group(0, &group, &[]);
            compute.dispatch_workgroups(x, y, 1);
        })?;
        self.interface
            .bindings
            .iter()
            .filter(|binding| matches!(binding.resource, Resource::Storage { written: true, .. }))
            .map(|binding| Ok((binding.name.clone(), gpu.words(&buffers[binding.name.as_str()])?)))
            .collect()
    }
}

fn layout_entry(binding: &toile_kernels::Binding) -> wgpu::BindGroupLayoutEntry {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let texture = |sample_type| wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2Array,
        multisampled: false,
    };
    wgpu::BindGroupLayoutEntry {
        binding: binding.number,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: match binding.resource {
            Resource::Uniform { .. } => buffer(wgpu::BufferBindingType::Uniform),
            Resource::Storage { written, .. } => buffer(wgpu::BufferBindingType::Storage { read_only: !written }),
            Resource::DepthTexture => texture(wgpu::TextureSampleType::Depth),
            Resource::FloatTexture => texture(wgpu::TextureSampleType::Float { filterable: false }),
        },
        count: None,
    }
}
