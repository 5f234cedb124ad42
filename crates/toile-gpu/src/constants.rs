//! The constant buffers of a device, each made once for all cloths for which it holds the same.

use std::collections::HashMap;
use std::hash::{BuildHasher, RandomState};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use wgpu::util::DeviceExt;

/// Constant buffers by what they hold. They are known as long as a cloth has them.
#[derive(Debug, Default)]
pub(crate) struct Constants {
    digests: RandomState,
    known: Mutex<HashMap<Key, Weak<wgpu::Buffer>>>,
}

/// What tells a buffer from others. Two that differ have the same digest with a chance of one in 10^19, as two models of a saved state do.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Key {
    name: &'static str,
    usage: wgpu::BufferUsages,
    size: usize,
    digest: u64,
}

impl Constants {
    /// The buffer of these contents: that of another cloth, or a new one.
    ///
    /// # Panics
    /// When the usage would let a copy write it.
    pub(crate) fn buffer(
        &self,
        device: &wgpu::Device,
        name: &'static str,
        contents: &[u8],
        usage: wgpu::BufferUsages,
    ) -> Arc<wgpu::Buffer> {
        assert!(!usage.contains(wgpu::BufferUsages::COPY_DST), "{name} is constant: cloths share it");
        let key = Key { name, usage, size: contents.len(), digest: self.digests.hash_one(contents) };
        let mut known = self.known();
        if let Some(buffer) = known.get(&key).and_then(Weak::upgrade) {
            return buffer;
        }
        known.retain(|_, buffer| buffer.strong_count() > 0);
        let descriptor = wgpu::util::BufferInitDescriptor { label: Some(name), contents, usage };
        let buffer = Arc::new(device.create_buffer_init(&descriptor));
        known.insert(key, Arc::downgrade(&buffer));
        buffer
    }

    /// Bytes of all that a cloth has, each buffer once.
    pub(crate) fn bytes(&self) -> u64 {
        self.known().values().filter_map(Weak::upgrade).map(|buffer| buffer.size()).sum()
    }

    fn known(&self) -> MutexGuard<'_, HashMap<Key, Weak<wgpu::Buffer>>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
