//! What one step costs, kernel by kernel, on a square sheet of 64² to 1024² particles: hanging from two corners, and lying
//! on a sphere. Times are the least of 20 steps in µs, each pass alone; beside them stands the cost in state copies, the time
//! of a kernel that reads and writes position and velocity of every particle, which carries over between machines. Then
//! the bytes per particle.
//!
//! `cargo bench --bench step`, or `cargo bench --bench step -- --quick` for 64² and 256² only.

mod support;

use support::Bench;
use toile::model::StepSettings;
use toile::{Cloth, Colliders};
use toile_lab::fixtures::{scene, sheet_model, sphere};

/// Steps that are measured.
const STEPS: usize = 20;

fn main() {
    let sizes: &[u32] = if has_option("--quick") { &[64, 256] } else { &[64, 128, 256, 512, 1024] };
    let bench = Bench::open();
    for name in ["hang", "ball"] {
        for size in sizes {
            measure(&bench, name, *size);
        }
    }
}

fn measure(bench: &Bench, name: &str, size: u32) {
    let scene = scene(name, &[("n", &size.to_string())]);
    let model = sheet_model(&scene);
    let settings = StepSettings::new(&scene.settings, &model);
    let mut cloth = Cloth::new(&bench.device, &model, &settings, Colliders { maps: None, sphere: sphere(&scene) })
        .unwrap_or_else(|error| panic!("{error}"));
    let cost = bench.step_cost(&mut cloth, STEPS);
    let particles = f64::from(model.particle_count());
    println!(
        "\n{name} {size}²: {} particles, {} springs, {:.0} bytes per particle, state copy {:.1} µs ({:.2} ns per particle)",
        model.particle_count(),
        model.spring_count(),
        cloth.bytes() as f64 / particles,
        1e3 * cost.state_copy,
        1e6 * cost.state_copy / particles,
    );
    println!("  {:<18} {:>10} {:>12} {:>12}", "kernel", "dispatches", "µs", "state copies");
    for (kernel, dispatches, ms) in &cost.kernels {
        println!("  {kernel:<18} {dispatches:>10} {:>12.1} {:>12.2}", 1e3 * ms, ms / cost.state_copy);
    }
    let dispatches: u32 = cost.kernels.iter().map(|(_, dispatches, _)| dispatches).sum();
    let step = cost.milliseconds();
    println!("  {:<18} {dispatches:>10} {:>12.1} {:>12.2}", "step", 1e3 * step, step / cost.state_copy);
}

/// Whether the option is among the arguments. cargo adds `--bench`, which says nothing.
fn has_option(option: &str) -> bool {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    assert!(arguments.iter().all(|argument| argument == option), "the only option is {option}, not {arguments:?}");
    !arguments.is_empty()
}
