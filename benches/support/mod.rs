//! What the benches share: a device, and what a step costs on it.

use toile::Cloth;
use toile_lab::INSTALL_HINT;
use toile_lab::StepCost;

/// A device with the limits of its adapter: large sheets need more than the defaults.
pub struct Bench {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
}

impl Bench {
    /// Opens the best adapter and prints its name.
    ///
    /// # Panics
    /// When there is none, or it gives no device.
    pub fn open() -> Self {
        pollster::block_on(async {
            let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle().with_env());
            let options = wgpu::RequestAdapterOptions {
                power_preference: wgpu::PowerPreference::HighPerformance,
                ..Default::default()
            };
            let adapter = instance.request_adapter(&options).await.expect(INSTALL_HINT);
            println!("{}", adapter.get_info().name);
            let descriptor = wgpu::DeviceDescriptor {
                label: Some("toile benches"),
                required_features: adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
                required_limits: adapter.limits(),
                ..Default::default()
            };
            let (device, queue) = adapter.request_device(&descriptor).await.expect("the adapter gives a device");
            Self { device, queue }
        })
    }

    /// What a step of a simulation costs.
    pub fn step_cost(&self, cloth: &mut Cloth, steps: usize) -> StepCost {
        StepCost::of(&self.device, &self.queue, cloth, steps).expect("the device answers")
    }
}
