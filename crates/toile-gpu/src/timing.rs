//! The time of each pass, for measuring only: every pass is submitted and waited for on its own.

use crate::{GpuError, readback};
use std::time::Instant;

/// Empty passes whose fastest is what a submission costs by itself.
const EMPTY_PASSES: usize = 20;

/// Takes the time of single passes.
///
/// It takes timestamps on the device. Where the device has none, or is a CPU, it takes the wall clock around submission and
/// wait, less what an empty pass takes: software Vulkan writes its timestamps from a thread that does not wait for compute
/// passes, so that they tell the time of something else.
#[derive(Debug)]
pub struct Timer {
    clock: Clock,
}

#[derive(Debug)]
enum Clock {
    Timestamps { queries: wgpu::QuerySet, resolved: wgpu::Buffer },
    Wall { empty_milliseconds: f64 },
}

/// What a kernel cost.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct PassTime {
    /// Dispatches.
    pub dispatches: u32,
    /// Time of all of them [ms].
    pub milliseconds: f64,
}

impl Timer {
    /// A timer for a device. Waits for it.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Self, GpuError> {
        let software = device.adapter_info().device_type == wgpu::DeviceType::Cpu;
        if !software && device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            return Ok(Self { clock: Self::timestamps(device) });
        }
        let wall = Self { clock: Clock::Wall { empty_milliseconds: 0.0 } };
        let empty: Result<Vec<f64>, GpuError> =
            (0..EMPTY_PASSES).map(|_| wall.milliseconds(device, queue, |_| {})).collect();
        let empty_milliseconds = empty?.into_iter().fold(f64::INFINITY, f64::min);
        Ok(Self { clock: Clock::Wall { empty_milliseconds } })
    }

    fn timestamps(device: &wgpu::Device) -> Clock {
        let queries = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("pass time"),
            ty: wgpu::QueryType::Timestamp,
            count: 2,
        });
        let resolved = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("pass time"),
            size: 16,
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        Clock::Timestamps { queries, resolved }
    }

    /// Does a pass and says how long it took [ms].
    pub(crate) fn milliseconds(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        dispatch: impl FnOnce(&mut wgpu::ComputePass<'_>),
    ) -> Result<f64, GpuError> {
        let mut encoder = device.create_command_encoder(&Default::default());
        let timestamp_writes = match &self.clock {
            Clock::Timestamps { queries, .. } => Some(wgpu::ComputePassTimestampWrites {
                query_set: queries,
                beginning_of_pass_write_index: Some(0),
                end_of_pass_write_index: Some(1),
            }),
            Clock::Wall { .. } => None,
        };
        dispatch(&mut encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: None, timestamp_writes }));
        match &self.clock {
            Clock::Timestamps { queries, resolved } => {
                encoder.resolve_query_set(queries, 0..2, resolved, 0);
                queue.submit([encoder.finish()]);
                let bytes = readback::read_buffer(device, queue, resolved)?;
                let ticks: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
                let period = f64::from(queue.get_timestamp_period());
                Ok(ticks[1].saturating_sub(ticks[0]) as f64 * period * 1e-6)
            }
            Clock::Wall { empty_milliseconds } => {
                let commands = encoder.finish();
                let start = Instant::now();
                queue.submit([commands]);
                device
                    .poll(wgpu::PollType::wait_indefinitely())
                    .map_err(|error| GpuError::Device(error.to_string()))?;
                Ok((1e3 * start.elapsed().as_secs_f64() - empty_milliseconds).max(0.0))
            }
        }
    }
}
