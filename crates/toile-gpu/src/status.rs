//! The status of past frames, read without stalling: a few small buffers that map themselves when their frame is done.

use crate::slot::Slot;
use encase::{ShaderType, StorageBuffer};
use std::sync::{Mutex, MutexGuard, PoisonError};
use toile_kernels::structs;
use toile_model::Status;

/// Frames whose status can be under way at once. A frame that finds no free slot is not reported.
const SLOT_COUNT: usize = 8;

/// Reads the status of past frames without stalling.
#[derive(Debug)]
pub(crate) struct StatusReader {
    /// With what each reports.
    slots: Vec<(Slot, Reported)>,
    /// How often the solver was set to another state.
    epoch: u32,
    latest: Mutex<Option<Status>>,
}

/// What a slot reports.
#[derive(Clone, Copy, Debug, Default)]
struct Reported {
    step: u64,
    /// What was reported before the solver was set to another state says nothing of this one.
    epoch: u32,
}

impl StatusReader {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let size = polish_place() + structs::PolishState::min_size().get();
        let slot = |_| (Slot::new(device, "status readback", size), Reported::default());
        Self { slots: (0..SLOT_COUNT).map(slot).collect(), epoch: 0, latest: Mutex::default() }
    }

    /// Records the copy of the status buffer, and of the state of a polish if there is one, after step `step`.
    pub(crate) fn record(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        status: &wgpu::Buffer,
        polish_state: Option<&wgpu::Buffer>,
        step: u64,
    ) {
        drop(self.collect());
        let Some((slot, reported)) = self.slots.iter_mut().find(|(slot, _)| slot.is_free()) else { return };
        *reported = Reported { step, epoch: self.epoch };
        slot.record(encoder, |encoder, target| {
            encoder.copy_buffer_to_buffer(status, 0, target, 0, polish_place());
            if let Some(state) = polish_state {
                encoder.copy_buffer_to_buffer(state, 0, target, polish_place(), state.size());
            }
        });
    }

    /// The newest status that has arrived.
    pub(crate) fn latest(&self) -> Option<Status> {
        *self.collect()
    }

    /// What was reported of the state that a fresh solver goes on from.
    pub(crate) fn resume(&mut self, status: Option<Status>) {
        self.epoch += 1;
        self.latest = Mutex::new(status);
    }

    /// Takes what has arrived.
    fn collect(&self) -> MutexGuard<'_, Option<Status>> {
        // What a thread that panicked left there is a status all the same.
        let mut newest = self.latest.lock().unwrap_or_else(PoisonError::into_inner);
        for (slot, Reported { step, epoch }) in &self.slots {
            if let Some(status) = slot.take(|bytes| decode(bytes, *step))
                && *epoch == self.epoch
                && newest.is_none_or(|latest| status.step >= latest.step)
            {
                *newest = Some(status);
            }
        }
        newest
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
