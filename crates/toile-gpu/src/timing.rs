//! The time of each pass, by timestamps on the device.

use crate::{GpuError, Pass, Program, readback};
use std::collections::BTreeMap;
use toile_kernels::Kernel;

/// Timestamps that one timer can take.
const QUERY_COUNT: u32 = 4096;

/// Takes timestamps around passes.
#[derive(Debug)]
pub struct Timer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    kernels: Vec<Kernel>,
    copies: Option<[wgpu::Buffer; 2]>,
}

/// What a kernel cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PassTime {
    /// Dispatches.
    pub dispatches: u32,
    /// Time of all of them [ms].
    pub milliseconds: f64,
}

impl Timer {
    /// A timer; `None` when the device does not have the feature `TIMESTAMP_QUERY`.
    pub fn new(device: &wgpu::Device) -> Option<Self> {
        if !device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return None;
        }
        let queries = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("pass times"),
            ty: wgpu::QueryType::Timestamp,
            count: QUERY_COUNT,
        });
        let resolved = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("pass times"),
            size: 8 * u64::from(QUERY_COUNT),
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        Some(Self { queries, resolved, kernels: Vec::new(), copies: None })
    }

    /// Records a pass with a timestamp before and after it. Beyond the timer's capacity it is recorded without.
    pub(crate) fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        kernel: Kernel,
        dispatch: impl FnOnce(&mut wgpu::ComputePass<'_>),
    ) {
        let first = 2 * self.kernels.len() as u32;
        let timestamp_writes = (first + 1 < QUERY_COUNT).then(|| {
            self.kernels.push(kernel);
            wgpu::ComputePassTimestampWrites {
                query_set: &self.queries,
                beginning_of_pass_write_index: Some(first),
                end_of_pass_write_index: Some(first + 1),
            }
        });
        let descriptor = wgpu::ComputePassDescriptor { label: Some(kernel.name()), timestamp_writes };
        dispatch(&mut encoder.begin_compute_pass(&descriptor));
    }

    /// Records a copy of the whole state: the unit in which costs are told.
    pub(crate) fn record_state_copy<'a>(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        particle_count: u32,
        buffer: impl Fn(&str) -> &'a wgpu::Buffer,
    ) {
        let program = Program::new(device, Kernel::StateCopy);
        let copy = |label| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: buffer("positions").size(),
                usage: wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        };
        let copies = self.copies.get_or_insert_with(|| [copy("position copies"), copy("velocity copies")]).clone();
        let group = program.bind(device, |binding| {
            match binding.name.as_str() {
                "position_copies" => &copies[0],
                "velocity_copies" => &copies[1],
                name => buffer(name),
            }
            .as_entire_binding()
        });
        let [x, y] = Pass { kernel: Kernel::StateCopy, items: 0..particle_count, colour: None }.workgroups();
        self.record(encoder, Kernel::StateCopy, |compute| {
            compute.set_pipeline(program.pipeline());
            compute.set_bind_group(0, &group, &[]);
            compute.dispatch_workgroups(x, y, 1);
        });
    }

    /// Waits for the recorded passes, which must have been submitted, and gives the cost of each kernel; starts afresh.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    pub fn read(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<BTreeMap<Kernel, PassTime>, GpuError> {
        let mut encoder = device.create_command_encoder(&Default::default());
        let count = 2 * self.kernels.len() as u32;
        encoder.resolve_query_set(&self.queries, 0..count, &self.resolved, 0);
        queue.submit([encoder.finish()]);
        let bytes = readback::read_buffer(device, queue, &self.resolved)?;
        let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let period = f64::from(queue.get_timestamp_period());
        let mut times: BTreeMap<Kernel, PassTime> = BTreeMap::new();
        for (kernel, pair) in self.kernels.drain(..).zip(ticks.chunks_exact(2)) {
            let time = times.entry(kernel).or_default();
            time.dispatches += 1;
            time.milliseconds += pair[1].saturating_sub(pair[0]) as f64 * period * 1e-6;
        }
        Ok(times)
    }
}
