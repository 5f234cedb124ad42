//! Any small WGSL on the device: read-only storage buffers in, one buffer of words out.

use crate::Gpu;
use wgpu::util::DeviceExt;

/// A compute pipeline of a test's own WGSL.
#[derive(Debug)]
pub struct Compute {
    pipeline: wgpu::ComputePipeline,
}

impl Compute {
    /// Compiles WGSL with this entry point.
    ///
    /// # Panics
    /// When it is not valid.
    pub fn new(gpu: &Gpu, entry: &str, source: &str) -> Self {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(entry),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: None,
            module: &module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            cache: None,
        });
        Self { pipeline }
    }

    /// Dispatches `workgroups` with `inputs` at bindings 0, 1, … and gives the words of an output of so many bytes behind them.
    pub fn run(&self, gpu: &Gpu, workgroups: u32, inputs: &[Vec<u8>], output_bytes: usize) -> Vec<u32> {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let output = vec![0; output_bytes];
        let buffers: Vec<wgpu::Buffer> = inputs
            .iter()
            .chain([&output])
            .map(|contents| {
                gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
            })
            .collect();
        let entries: Vec<_> = buffers
            .iter()
            .zip(0..)
            .map(|(buffer, binding)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        gpu.run(|encoder| {
            let mut compute = encoder.begin_compute_pass(&Default::default());
            compute.set_pipeline(&self.pipeline);
            compute.set_bind_group(0, &group, &[]);
            compute.dispatch_workgroups(workgroups, 1, 1);
        });
        gpu.words(&buffers[inputs.len()])
    }
}
