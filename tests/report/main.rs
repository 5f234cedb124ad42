//! A small version of each section of the report, and the pages that are made of them.

mod maps;
mod page;
mod precision;
mod settings;
mod terms;

use toile_report::{Lab, Scale};
use toile_workspace::gpu;

/// A lab on the device of the tests.
fn lab() -> Lab {
    let gpu = gpu();
    Lab::new(gpu.device.clone(), gpu.queue.clone(), gpu.adapter.clone(), Scale::Quick, 1)
}
