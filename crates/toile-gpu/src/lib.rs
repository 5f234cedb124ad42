//! Plan, buffers, maps, pipelines, solver, status, timing and read-back on a wgpu device.
//!
//! Nothing here creates a device, submits, or waits, except what the feature `native-wait` brings: `readback`, `Timer`, `Solver::time_step` and
//! `Kernels::make_all`, which are for tests, benches and programs that write files.

#[cfg(target_arch = "wasm32")]
const _: () = assert!(
    wgpu::Instance::enabled_backend_features().contains(wgpu::Backends::BROWSER_WEBGPU),
    "in a browser there is WebGPU alone"
);

mod all_made;
mod buffers;
mod constants;
pub mod contents;
mod error;
mod hosted;
mod kernels;
mod limits;
mod maps;
mod mark;
mod moving_body;
mod needs;
mod plan;
mod program;
mod raised;
#[cfg(feature = "native-wait")]
pub mod readback;
mod slot;
mod solver;
mod status;
mod step_params;
#[cfg(feature = "native-wait")]
mod timing;
mod traffic;
mod trail;

pub use all_made::AllMade;
pub use error::GpuError;
pub use hosted::{HostAttribute, HostMotion, HostVertices};
pub use kernels::Kernels;
pub use maps::{BodyMaps, MapSpace, MapsFault, Surface};
pub use mark::Mark;
pub use moving_body::MovingBody;
pub use needs::Maps;
pub use plan::{KernelRuns, Pass, Plan, kernel_runs};
pub use program::Program;
pub use raised::Raised;
pub use slot::Arrival;
pub use solver::Solver;
#[cfg(feature = "native-wait")]
pub use timing::{PassTime, Timer};
pub use toile_kernels::Kernel;
pub use trail::Trail;
