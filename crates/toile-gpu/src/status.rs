//! The status of past frames, read without stalling: a few small buffers that map themselves when their frame is done.

use encase::{ShaderType, StorageBuffer};
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};
use toile_kernels::structs;
use toile_model::Status;

/// Frames whose status can be under way at once. A frame that finds no free slot is not reported.
const SLOT_COUNT: usize = 8;

const FREE: u8 = 0;
const PENDING: u8 = 1;
const READY: u8 = 2;

#[derive(Debug)]
struct Slot {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
    step: u64,
}

/// The claim of a frame on its slot. The slot is free again when no status can come any more: the mapping failed, or the host dropped
/// the encoder without submitting it.
struct Claim(Arc<AtomicU8>);

impl Drop for Claim {
    fn drop(&mut self) {
        let _ = self.0.compare_exchange(PENDING, FREE, Ordering::AcqRel, Ordering::Relaxed);
    }
}

/// Reads the status of past frames without stalling.
#[derive(Debug)]
pub(crate) struct StatusReader {
    slots: Vec<Slot>,
    latest: Option<Status>,
}

impl StatusReader {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let size = polish_place() + structs::PolishState::min_size().get();
        let slot = |_| Slot {
            buffer: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("status readback"),
                size,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            state: Arc::new(AtomicU8::new(FREE)),
            step: 0,
        };
        Self { slots: (0..SLOT_COUNT).map(slot).collect(), latest: None }
    }

    /// Records the copy of the status buffer, and of the state of a polish if there is one, after step `step`; it maps itself once the
    /// encoder's commands are done.
    pub(crate) fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        status: &wgpu::Buffer,
        polish_state: Option<&wgpu::Buffer>,
        step: u64,
    ) {
        self.collect();
        let Some(slot) = self.slots.iter_mut().find(|s| s.state.load(Ordering::Acquire) == FREE) else { return };
        slot.step = step;
        slot.state.store(PENDING, Ordering::Release);
        encoder.copy_buffer_to_buffer(status, 0, &slot.buffer, 0, polish_place());
        if let Some(state) = polish_state {
            encoder.copy_buffer_to_buffer(state, 0, &slot.buffer, polish_place(), state.size());
        }
        let claim = Claim(slot.state.clone());
        encoder.map_buffer_on_submit(&slot.buffer, wgpu::MapMode::Read, .., move |result| {
            if result.is_ok() {
                claim.0.store(READY, Ordering::Release);
            }
        });
    }

    /// The newest status that has arrived.
    pub(crate) fn latest(&mut self) -> Option<Status> {
        self.collect();
        self.latest
    }

    fn collect(&mut self) {
        for slot in &mut self.slots {
            if slot.state.load(Ordering::Acquire) != READY {
                continue;
            }
            if let Ok(view) = slot.buffer.get_mapped_range(..)
                && let Some(status) = decode(&view, slot.step)
                && self.latest.is_none_or(|latest| status.step >= latest.step)
            {
                self.latest = Some(status);
            }
            slot.buffer.unmap();
            slot.state.store(FREE, Ordering::Release);
        }
    }
}

/// Where the state of a polish lies in a slot [byte]: after the status. Without a polish it stays zero.
fn polish_place() -> u64 {
    structs::Status::min_size().get()
}

fn decode(slot: &[u8], step: u64) -> Option<Status> {
    let (status, polish) = slot.split_at(polish_place() as usize);
    let (mut raw, mut polished) = (structs::Status::default(), structs::PolishState::default());
    StorageBuffer::new(status).read(&mut raw).ok()?;
    StorageBuffer::new(polish).read(&mut polished).ok()?;
    Some(Status {
        step,
        non_finite_count: raw.non_finite_count,
        first_non_finite: (raw.non_finite_count > 0).then(|| u32::MAX - raw.first_non_finite),
        speed_max: f32::from_bits(raw.speed_max),
        kinetic_energy: raw.kinetic_energy,
        elongation_max: f32::from_bits(raw.elongation_max),
        over_long_count: raw.over_long_count,
        longest_limit: (raw.longest_limit > 0).then(|| u32::MAX - raw.longest_limit),
        seam_gap_max: f32::from_bits(raw.seam_gap_max),
        further_sweeps: polished.further_sweeps,
        missed_steps: polished.missed_steps,
    })
}
