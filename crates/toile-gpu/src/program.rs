//! A kernel on a device: its pipeline, and resources bound to it by name.

use std::sync::Arc;
use toile_kernels::{Binding, Interface, Kernel, Resource, Role, buffer_row};

/// A kernel on a device. Everything it binds comes from the WGSL, by global name.
#[derive(Clone, Debug)]
pub struct Program {
    interface: Arc<Interface>,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl Program {
    /// Compiles a kernel.
    pub fn new(device: &wgpu::Device, kernel: Kernel) -> Self {
        Self::cached(device, kernel, None)
    }

    /// Compiles a kernel, or takes it from a cache.
    pub(crate) fn cached(device: &wgpu::Device, kernel: Kernel, cache: Option<&wgpu::PipelineCache>) -> Self {
        let constants = constants(kernel, device.adapter_info().device_type);
        Self::make(device, kernel, &kernel.source(), constants, cache)
    }

    /// Compiles any WGSL with the interface of a kernel: its own, or one that is changed to see a test fail. WGSL that is not valid is an error
    /// of the device's error scope. `constants` are those that it has otherwise than it says.
    pub fn of_source(device: &wgpu::Device, kernel: Kernel, source: &str, constants: &[(&str, f64)]) -> Self {
        Self::make(device, kernel, source, constants, None)
    }

    fn make(
        device: &wgpu::Device,
        kernel: Kernel,
        source: &str,
        constants: &[(&str, f64)],
        cache: Option<&wgpu::PipelineCache>,
    ) -> Self {
        let interface = Arc::new(Interface::of(kernel));
        let label = Some(kernel.name());
        let entries: Vec<_> = interface.bindings.iter().map(layout_entry).collect();
        // Not the layout that wgpu infers: it leaves out what changed WGSL names but does not use.
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries: &entries });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label,
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some(kernel.name()),
            compilation_options: wgpu::PipelineCompilationOptions {
                // Kernels write the memory of a workgroup before they read it.
                zero_initialize_workgroup_memory: false,
                constants,
            },
            cache,
        });
        Self { interface, layout, pipeline }
    }

    /// What the kernel binds.
    pub fn interface(&self) -> &Interface {
        &self.interface
    }

    /// The compiled pipeline.
    pub fn pipeline(&self) -> &wgpu::ComputePipeline {
        &self.pipeline
    }

    /// What decides the dynamic offset of a dispatch; `None` for kernels that take none.
    pub fn offset_role(&self) -> Option<Role> {
        let entries = self.interface.bindings.iter().find(|binding| binding.has_entries());
        entries.map(|binding| buffer_row(&binding.name).role)
    }

    /// Binds resources by name.
    pub fn bind<'a>(
        &self,
        device: &wgpu::Device,
        mut resource: impl FnMut(&Binding) -> wgpu::BindingResource<'a>,
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = self
            .interface
            .bindings
            .iter()
            .map(|binding| wgpu::BindGroupEntry { binding: binding.number, resource: resource(binding) })
            .collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&self.interface.entry),
            layout: &self.layout,
            entries: &entries,
        })
    }
}

/// What a kernel has otherwise than its WGSL says on a kind of device.
fn constants(kernel: Kernel, device_type: wgpu::DeviceType) -> &'static [(&'static str, f64)] {
    // A driver on the CPU runs the lanes of a workgroup one vector after the other, and changes between them at each barrier.
    if device_type == wgpu::DeviceType::Cpu { kernel.row().cpu_constants } else { &[] }
}

fn layout_entry(binding: &Binding) -> wgpu::BindGroupLayoutEntry {
    let buffer =
        |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: binding.has_entries(), min_binding_size: None };
    let texture =
        |sample_type, view_dimension| wgpu::BindingType::Texture { sample_type, view_dimension, multisampled: false };
    let layered = wgpu::TextureViewDimension::D2Array;
    let flat = wgpu::TextureViewDimension::D2;
    let floats = wgpu::TextureSampleType::Float { filterable: false };
    wgpu::BindGroupLayoutEntry {
        binding: binding.number,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: match binding.resource {
            Resource::Uniform { .. } => buffer(wgpu::BufferBindingType::Uniform),
            Resource::Storage { written, .. } => buffer(wgpu::BufferBindingType::Storage { read_only: !written }),
            Resource::DepthTexture => texture(wgpu::TextureSampleType::Depth, layered),
            Resource::FloatTexture => texture(floats, layered),
            Resource::FlatTexture { whole: false } => texture(floats, flat),
            Resource::FlatTexture { whole: true } => texture(wgpu::TextureSampleType::Uint, flat),
            Resource::WrittenTexture { whole } => wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                format: if whole { wgpu::TextureFormat::Rg32Uint } else { wgpu::TextureFormat::Rgba32Float },
                view_dimension: flat,
            },
        },
        count: None,
    }
}
