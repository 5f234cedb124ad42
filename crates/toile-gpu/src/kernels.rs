//! The pipelines of a device: each made once, for all that runs on it.

use crate::Program;
use crate::maps::SidePipeline;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};
use toile_kernels::{Kernel, TABLE};

/// The pipelines of a device, each made once: when it is first needed, or all at once by [`Kernels::make_all`]. Cheap to clone; whoever is given the same handle shares
/// them. What takes `impl Into<Kernels>` also takes a device, and then makes pipelines of its own.
#[derive(Clone, Debug)]
pub struct Kernels {
    shared: Arc<Shared>,
}

#[derive(Debug)]
struct Shared {
    device: wgpu::Device,
    cache: Option<wgpu::PipelineCache>,
    /// In the order of the kernel table.
    programs: Vec<OnceLock<Program>>,
    /// Those that draw the papers' maps, of bodies at rest and of those that move.
    sides: [OnceLock<SidePipeline>; 2],
}

impl Kernels {
    /// The pipelines of a device; none is made yet.
    pub fn new(device: &wgpu::Device) -> Self {
        Self::make(device, None)
    }

    /// The same, made with a cache that the host keeps from one start to the next where the device has
    /// `wgpu::Features::PIPELINE_CACHE`.
    pub fn with_cache(device: &wgpu::Device, cache: wgpu::PipelineCache) -> Self {
        Self::make(device, Some(cache))
    }

    fn make(device: &wgpu::Device, cache: Option<wgpu::PipelineCache>) -> Self {
        let programs = TABLE.iter().map(|_| OnceLock::new()).collect();
        Self { shared: Arc::new(Shared { device: device.clone(), cache, programs, sides: Default::default() }) }
    }

    /// Makes every pipeline that is not there yet, side by side on all cores; in a browser one after the other. It waits until they are made:
    /// a host that draws meanwhile calls it on a thread of its own.
    pub fn make_all(&self) {
        let jobs = TABLE.len() + self.shared.sides.len();
        let next = AtomicUsize::new(0);
        let work = || {
            loop {
                match next.fetch_add(1, Ordering::Relaxed) {
                    job if job < TABLE.len() => drop(self.program(TABLE[job].kernel)),
                    job if job < jobs => drop(self.sides(job > TABLE.len())),
                    _ => break,
                }
            }
        };
        if cfg!(target_arch = "wasm32") {
            return work();
        }
        let threads = std::thread::available_parallelism().map_or(1, usize::from).min(jobs);
        std::thread::scope(|scope| {
            (1..threads).for_each(|_| drop(scope.spawn(work)));
            work();
        });
    }

    /// How many pipelines are made.
    pub fn made_count(&self) -> usize {
        let programs = self.shared.programs.iter().filter(|program| program.get().is_some()).count();
        programs + self.shared.sides.iter().filter(|sides| sides.get().is_some()).count()
    }

    /// The device that they are of.
    pub fn device(&self) -> &wgpu::Device {
        &self.shared.device
    }

    /// The pipeline of a kernel.
    pub(crate) fn program(&self, kernel: Kernel) -> Program {
        let Shared { device, cache, programs, .. } = &*self.shared;
        // The rows of the table stand in the order of the kernels.
        programs[kernel as usize].get_or_init(|| Program::cached(device, kernel, cache.as_ref())).clone()
    }

    /// What draws the papers' maps of bodies at rest, or of those that move.
    pub(crate) fn sides(&self, moving: bool) -> SidePipeline {
        let Shared { device, cache, sides, .. } = &*self.shared;
        sides[usize::from(moving)].get_or_init(|| SidePipeline::new(device, moving, cache.as_ref())).clone()
    }
}

impl From<&Kernels> for Kernels {
    fn from(kernels: &Kernels) -> Self {
        kernels.clone()
    }
}

impl From<&wgpu::Device> for Kernels {
    fn from(device: &wgpu::Device) -> Self {
        Self::new(device)
    }
}
