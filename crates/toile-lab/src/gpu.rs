//! A device with its queue, and what is uploaded to it and read back from it, all of it blocking.

use glam::{Vec3, Vec4};
use toile::gpu::{GpuError, readback};
use wgpu::util::DeviceExt;

/// What to do where there is no adapter.
pub const INSTALL_HINT: &str = "the GPU tests need a Vulkan adapter; on Debian or Ubuntu \
    `apt-get install -y mesa-vulkan-drivers libvulkan1` brings one that works on the CPU";

/// A device with its queue.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Name of its adapter.
    pub adapter: String,
}

impl Gpu {
    /// Submits what `record` records and waits until it is done.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    pub fn run(&self, record: impl FnOnce(&mut wgpu::CommandEncoder)) -> Result<(), GpuError> {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        record(&mut encoder);
        let submission_index = Some(self.queue.submit([encoder.finish()]));
        let lost = |error: wgpu::PollError| GpuError::Device(error.to_string());
        // For this alone: other threads may have submitted more since.
        self.device.poll(wgpu::PollType::Wait { submission_index, timeout: None }).map_err(lost)?;
        Ok(())
    }

    /// A buffer with these contents.
    pub fn upload(&self, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
    }

    /// Reads a buffer back as 32-bit words.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    pub fn words(&self, buffer: &wgpu::Buffer) -> Result<Vec<u32>, GpuError> {
        let bytes = readback::read_buffer(&self.device, &self.queue, buffer)?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }

    /// Reads a buffer of vec4 back: xyz and w of each.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    pub fn vec4s(&self, buffer: &wgpu::Buffer) -> Result<Vec<Vec4>, GpuError> {
        readback::read_vec4s(&self.device, &self.queue, buffer)
    }

    /// Reads the xyz of a buffer of vec4 back.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    pub fn vec3s(&self, buffer: &wgpu::Buffer) -> Result<Vec<Vec3>, GpuError> {
        Ok(self.vec4s(buffer)?.into_iter().map(Vec4::truncate).collect())
    }
}
