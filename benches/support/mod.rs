//! What the benches share: a device, and the median cost of each kernel.

use std::collections::BTreeMap;
use toile::Simulation;
use toile::gpu::Timer;
use toile_workspace::INSTALL_HINT;

/// A device with the limits of its adapter: large sheets need more than the defaults.
pub struct Bench {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
}

/// What one step costs.
pub struct StepCost {
    /// Name, dispatches per step and time [ms] of each kernel, in the order of the algorithm.
    pub kernels: Vec<(&'static str, u32, f64)>,
    /// Time of a copy of the whole state [ms].
    pub state_copy: f64,
}

impl Bench {
    /// Opens the best adapter and prints its name.
    ///
    /// # Panics
    /// When there is none, or it gives no device.
    pub fn open() -> Self {
        pollster::block_on(async {
            let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
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

    /// The median over some steps, after one that warms up.
    pub fn step_cost(&self, simulation: &mut Simulation, steps: usize) -> StepCost {
        let timer = Timer::new(&self.device, &self.queue).expect("the device answers");
        let mut samples: BTreeMap<_, Vec<f64>> = BTreeMap::new();
        let mut dispatches = BTreeMap::new();
        for step in 0..=steps {
            let times = simulation.time_step(&self.device, &self.queue, &timer).expect("the device answers");
            for (kernel, time) in times {
                dispatches.insert(kernel, time.dispatches);
                if step > 0 {
                    samples.entry(kernel).or_default().push(time.milliseconds);
                }
            }
        }
        let all = samples.into_iter().map(|(kernel, times)| (kernel.name(), dispatches[&kernel], median(times)));
        let (copies, kernels): (Vec<_>, Vec<_>) = all.partition(|(name, ..)| *name == "state_copy");
        StepCost { kernels, state_copy: copies[0].2 }
    }
}

impl StepCost {
    /// Time of a step [ms].
    pub fn step(&self) -> f64 {
        self.kernels.iter().map(|(_, _, ms)| ms).sum()
    }
}

/// The middle value.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
