//! The device of the tests. Without an adapter they fail and say what to install; they are never skipped.

use std::ops::Deref;
use std::sync::OnceLock;
use toile_lab::{INSTALL_HINT, Lab, Scale};

/// A device with its queue, for tests: whatever it does not answer fails them. It has the limits of WebGPU, so that a test
/// fails where a browser would.
#[derive(Clone, Debug)]
pub struct Gpu(toile_lab::Gpu);

impl Deref for Gpu {
    type Target = toile_lab::Gpu;

    fn deref(&self) -> &toile_lab::Gpu {
        &self.0
    }
}

/// The device of this test process: a driver on the CPU where there is one.
///
/// # Panics
/// When there is no adapter or it gives no device.
pub fn gpu() -> &'static Gpu {
    static GPU: OnceLock<Gpu> = OnceLock::new();
    GPU.get_or_init(|| {
        pollster::block_on(open(wgpu::Backends::all())).unwrap_or_else(|fault| panic!("{fault}: {INSTALL_HINT}"))
    })
}

/// The device of this test alone. One that waits for its commands has their answers too, which on a shared device another thread may be
/// handing over just then; and whole journeys on one device would wait for one another.
///
/// # Panics
/// When there is no adapter or it gives no device.
pub fn own_gpu() -> &'static Gpu {
    thread_local! {
        static GPU: &'static Gpu =
            Box::leak(Box::new(Gpu::open(wgpu::Backends::all()).unwrap_or_else(|fault| panic!("{fault}"))));
    }
    GPU.with(|gpu| *gpu)
}

impl Gpu {
    /// Opens an adapter of these backends.
    ///
    /// # Errors
    /// When there is none, with what wgpu says and what to install.
    pub fn open(backends: wgpu::Backends) -> Result<Self, String> {
        pollster::block_on(open(backends)).map_err(|fault| format!("{fault}: {INSTALL_HINT}"))
    }

    /// Submits what `record` records and waits until it is done.
    pub fn run(&self, record: impl FnOnce(&mut wgpu::CommandEncoder)) {
        self.0.run(record).expect("the device answers");
    }

    /// Reads a buffer back as 32-bit words.
    pub fn words(&self, buffer: &wgpu::Buffer) -> Vec<u32> {
        self.0.words(buffer).expect("the device answers")
    }

    /// Reads a buffer of vec4 back: xyz and w of each.
    pub fn vec4s(&self, buffer: &wgpu::Buffer) -> Vec<glam::Vec4> {
        self.0.vec4s(buffer).expect("the device answers")
    }

    /// Reads the xyz of a buffer of vec4 back.
    pub fn vec3s(&self, buffer: &wgpu::Buffer) -> Vec<glam::Vec3> {
        self.0.vec3s(buffer).expect("the device answers")
    }
}

/// A quick lab on the device of this test process.
pub fn lab() -> Lab {
    let gpu = gpu();
    Lab::new(gpu.device.clone(), gpu.queue.clone(), gpu.adapter.clone(), Scale::Quick, 1)
}

/// Whether an adapter is a driver on the CPU. It does one operation after the other, as the reference does; a GPU may contract and
/// reorder them, as WGSL allows, and then gives other bits.
fn is_software(adapter: &wgpu::Adapter) -> bool {
    adapter.get_info().device_type == wgpu::DeviceType::Cpu
        && adapter.get_downlevel_capabilities().is_webgpu_compliant()
}

async fn open(backends: wgpu::Backends) -> Result<Gpu, String> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapters = instance.enumerate_adapters(backends).await;
    let adapter = match adapters.into_iter().find(is_software) {
        Some(adapter) => adapter,
        None => instance.request_adapter(&Default::default()).await.map_err(|error| error.to_string())?,
    };
    let descriptor = wgpu::DeviceDescriptor { label: Some("toile tests"), ..Default::default() };
    let (device, queue) = adapter.request_device(&descriptor).await.map_err(|error| error.to_string())?;
    Ok(Gpu(toile_lab::Gpu { device, queue, adapter: adapter.get_info().name }))
}
