//! What all that runs on a device shares: its pipelines and constant buffers, each made once.

use crate::all_made::AllMade;
use crate::constants::Constants;
use crate::maps::SidePipeline;
use crate::{GpuError, Program};
#[cfg(not(target_arch = "wasm32"))]
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};
use toile_kernels::{Kernel, TABLE};

/// The pipelines of a device, each made once: when it is first needed, or all at once by [`Kernels::all_made`]. Cheap to clone; whoever is given the same handle shares
/// them. What takes `impl Into<Kernels>` also takes a device, and then makes pipelines of its own.
///
/// Cloths of the same handle also share the buffers that nothing writes, wherever these hold the same: springs, limits, colours, triangles.
/// Cloths of equal models have only their state for themselves.
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
    constants: Constants,
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
        let (device, sides, constants) = (device.clone(), Default::default(), Constants::default());
        Self { shared: Arc::new(Shared { device, cache, programs, sides, constants }) }
    }

    /// Makes every pipeline that is not there yet, side by side on all cores; in a browser one after the other. It waits until they are made:
    /// a host that draws meanwhile calls it on a thread of its own.
    ///
    /// A pipeline that the device refuses is an error of its own, which it tells as any other.
    #[cfg(feature = "native-wait")]
    pub fn make_all(&self) {
        #[cfg(not(target_arch = "wasm32"))]
        self.make_side_by_side(&|job| self.make_one(job));
        #[cfg(target_arch = "wasm32")]
        (0..self.job_count()).for_each(|job| self.make_one(job));
    }

    /// Has every pipeline made that is not there yet, and gives the future of it. Natively threads of its own make them, from now on; in a browser they are
    /// asked for now, and the browser makes them. It never blocks, and needs no executor of a certain kind.
    ///
    /// The future gives [`GpuError::Pipeline`] where the device refuses one.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn all_made(&self) -> AllMade {
        let kernels = self.clone();
        AllMade::by_thread(move || {
            let refused = std::sync::Mutex::new(Ok(()));
            kernels.make_side_by_side(&|job| {
                let scope = kernels.device().push_error_scope(wgpu::ErrorFilter::Validation);
                kernels.make_one(job);
                // Natively what a scope caught is there at once.
                let mut caught = std::pin::pin!(scope.pop());
                let caught = caught.as_mut().poll(&mut std::task::Context::from_waker(std::task::Waker::noop()));
                if let std::task::Poll::Ready(Some(error)) = caught {
                    *refused.lock().unwrap_or_else(std::sync::PoisonError::into_inner) = Err(refusal(job, &error));
                }
            });
            refused.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner)
        })
    }

    /// Has every pipeline made that is not there yet, and gives the future of it. Natively threads of its own make them, from now on; in a browser they are
    /// asked for now, and the browser makes them. It never blocks, and needs no executor of a certain kind.
    ///
    /// The future gives [`GpuError::Pipeline`] where the device refuses one.
    #[cfg(target_arch = "wasm32")]
    pub fn all_made(&self) -> AllMade {
        let asked = |job| {
            let scope = self.device().push_error_scope(wgpu::ErrorFilter::Validation);
            self.make_one(job);
            (job, scope.pop())
        };
        let asked: Vec<_> = (0..self.job_count()).map(asked).collect();
        AllMade::of(async move {
            for (job, caught) in asked {
                if let Some(error) = caught.await {
                    return Err(refusal(job, &error));
                }
            }
            Ok(())
        })
    }

    fn job_count(&self) -> usize {
        TABLE.len() + self.shared.sides.len()
    }

    /// Makes a pipeline by its number: those of the kernels first, then what draws the papers' maps.
    fn make_one(&self, job: usize) {
        match TABLE.get(job) {
            Some(row) => drop(self.program(row.kernel)),
            None => drop(self.sides(job > TABLE.len())),
        }
    }

    #[cfg(not(target_arch = "wasm32"))]
    fn make_side_by_side(&self, make: &(dyn Fn(usize) + Sync)) {
        let jobs = self.job_count();
        let next = AtomicUsize::new(0);
        let work = || {
            loop {
                match next.fetch_add(1, Ordering::Relaxed) {
                    job if job < jobs => make(job),
                    _ => break,
                }
            }
        };
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

    /// Bytes of the buffers that cloths share, each counted once: with [`Solver::own_bytes`](crate::Solver::own_bytes) of every cloth it is what the cloths
    /// take.
    pub fn shared_bytes(&self) -> u64 {
        self.shared.constants.bytes()
    }

    /// The device that they are of.
    pub fn device(&self) -> &wgpu::Device {
        &self.shared.device
    }

    /// A buffer that nothing writes, of these contents.
    pub(crate) fn constant(&self, name: &'static str, contents: &[u8], usage: wgpu::BufferUsages) -> Arc<wgpu::Buffer> {
        self.shared.constants.buffer(&self.shared.device, name, contents, usage)
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

/// What a device says of a pipeline that it refuses.
fn refusal(job: usize, error: &wgpu::Error) -> GpuError {
    let kernel = TABLE.get(job).map_or("the maps of two sides", |row| row.kernel.name());
    GpuError::Pipeline { kernel: kernel.to_owned(), message: error.to_string() }
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
