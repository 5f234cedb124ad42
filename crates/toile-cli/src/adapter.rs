//! Adapters and devices.

use crate::args::Place;
use anyhow::{Context, Result, bail};

/// The one line to run where there is no adapter.
pub const INSTALL_HINT: &str = "on Debian or Ubuntu `apt-get install -y mesa-vulkan-drivers libvulkan1` brings a Vulkan adapter that works on the CPU; \
     `--backend reference` works without any";

/// A device with its queue and the name of its adapter.
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Name of the adapter.
    pub name: String,
}

/// All adapters that wgpu finds. Not those of GL: it cannot run the kernels.
pub fn all() -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::PRIMARY,
        flags: flags(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY))
}

/// Without the hidden dispatch with which wgpu checks each indirect one: those of a polish have the workgroups of their plan, or none. On D3D12
/// that check also tells kernels how many workgroups there are.
fn flags() -> wgpu::InstanceFlags {
    let default = wgpu::InstanceFlags::default();
    if cfg!(windows) { default } else { default - wgpu::InstanceFlags::VALIDATION_INDIRECT_CALL }
}

/// Opens the adapter that the user named, or the most capable one.
pub fn open(place: &Place) -> Result<Gpu> {
    let mut adapters = all();
    adapters.retain(|adapter| adapter.get_downlevel_capabilities().is_webgpu_compliant());
    if adapters.is_empty() {
        bail!("no adapter was found: {INSTALL_HINT}");
    }
    let names: Vec<String> = adapters.iter().map(|a| a.get_info().name).collect();
    let index = match &place.adapter {
        Some(wanted) => {
            let wanted_lower = wanted.to_lowercase();
            names.iter().position(|name| name.to_lowercase().contains(&wanted_lower)).with_context(|| {
                format!("--adapter {wanted}: no adapter has that in its name; there is: {}", names.join(", "))
            })?
        }
        None => {
            let rank = |adapter: &wgpu::Adapter| match adapter.get_info().device_type {
                wgpu::DeviceType::DiscreteGpu => 0,
                wgpu::DeviceType::IntegratedGpu => 1,
                wgpu::DeviceType::VirtualGpu => 2,
                wgpu::DeviceType::Cpu | wgpu::DeviceType::Other => 3,
            };
            (0..adapters.len()).min_by_key(|i| rank(&adapters[*i])).unwrap_or(0)
        }
    };
    let adapter = &adapters[index];
    let descriptor = wgpu::DeviceDescriptor {
        label: Some("toile"),
        required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
        // Large sheets need more than WebGPU's default buffer sizes where the adapter has them.
        required_limits: adapter.limits(),
        ..Default::default()
    };
    let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
        .with_context(|| format!("the adapter {} gives no device", names[index]))?;
    Ok(Gpu { device, queue, name: names[index].clone() })
}
