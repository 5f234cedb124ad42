//! A small buffer that comes back to the CPU without stalling: it maps itself when the commands that fill it are done.

use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

const FREE: u8 = 0;
const PENDING: u8 = 1;
const READY: u8 = 2;

/// A buffer on its way to the CPU, or free for the next.
#[derive(Debug)]
pub(crate) struct Slot {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
}

/// The claim of recorded commands on their slot. The slot is free again when nothing can come any more: the mapping failed, or the host
/// dropped the encoder without submitting it.
struct Claim(Arc<AtomicU8>);

impl Drop for Claim {
    fn drop(&mut self) {
        let _ = self.0.compare_exchange(PENDING, FREE, Ordering::AcqRel, Ordering::Relaxed);
    }
}

impl Slot {
    pub(crate) fn new(device: &wgpu::Device, label: &str, size: u64) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, state: Arc::new(AtomicU8::new(FREE)) }
    }

    /// Whether nothing is under way and nothing waits to be taken.
    pub(crate) fn is_free(&self) -> bool {
        self.state.load(Ordering::Acquire) == FREE
    }

    /// Records what fills the slot; it maps itself once the encoder's commands are done.
    pub(crate) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        fill: impl FnOnce(&mut wgpu::CommandEncoder, &wgpu::Buffer),
    ) {
        self.state.store(PENDING, Ordering::Release);
        fill(encoder, &self.buffer);
        let claim = Claim(self.state.clone());
        encoder.map_buffer_on_submit(&self.buffer, wgpu::MapMode::Read, .., move |result| {
            if result.is_ok() {
                claim.0.store(READY, Ordering::Release);
            }
        });
    }

    /// Makes something of the bytes, if they have arrived, and frees the slot.
    pub(crate) fn take<T>(&self, read: impl FnOnce(&[u8]) -> Option<T>) -> Option<T> {
        if self.state.load(Ordering::Acquire) != READY {
            return None;
        }
        let taken = self.buffer.get_mapped_range(..).ok().and_then(|view| read(&view));
        self.buffer.unmap();
        self.state.store(FREE, Ordering::Release);
        taken
    }
}

/// A copy of a whole buffer on its way to the CPU.
#[derive(Debug)]
pub struct Arrival(Slot);

impl Arrival {
    /// Records the copy of a buffer of usage `COPY_SRC` into the caller's encoder.
    pub fn of(device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, buffer: &wgpu::Buffer) -> Self {
        let slot = Slot::new(device, "arrival", buffer.size());
        slot.record(encoder, |encoder, target| encoder.copy_buffer_to_buffer(buffer, 0, target, 0, buffer.size()));
        Self(slot)
    }

    /// The bytes, once, when they have arrived. Nothing waits.
    pub fn take(&self) -> Option<Vec<u8>> {
        self.0.take(|bytes| Some(bytes.to_vec()))
    }

    /// Whether the bytes can never arrive: they were taken, the copy failed, or its encoder was dropped.
    pub fn is_over(&self) -> bool {
        self.0.is_free()
    }
}
