//! The state of a solver, kept on the device.

use crate::Solver;

/// The state of a solver, kept on the device.
#[derive(Debug)]
pub struct Mark {
    buffers: Vec<(&'static str, wgpu::Buffer)>,
    step: u64,
}

impl Solver {
    /// Records a copy of the state.
    pub fn record_mark(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) -> Mark {
        let copy = |(name, buffer): (&'static str, &wgpu::Buffer)| {
            let copy = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(name),
                size: buffer.size(),
                usage: wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            encoder.copy_buffer_to_buffer(buffer, 0, &copy, 0, buffer.size());
            (name, copy)
        };
        Mark { buffers: self.state().map(copy).collect(), step: self.step() }
    }

    /// Records that the solver goes on from a mark of its own.
    ///
    /// # Panics
    /// When the mark is that of another cloth.
    pub fn record_reset(&mut self, encoder: &mut wgpu::CommandEncoder, mark: &Mark) {
        for (name, buffer) in self.state() {
            match mark.buffers.iter().find(|(known, _)| *known == name) {
                Some((_, kept)) => {
                    assert_eq!(kept.size(), buffer.size(), "a mark is that of the same cloth");
                    encoder.copy_buffer_to_buffer(kept, 0, buffer, 0, buffer.size());
                }
                // It has come with passes that the cloth had not then: nothing was in it.
                None => encoder.clear_buffer(buffer, 0, None),
            }
        }
        self.resume(mark.step, None);
    }
}
