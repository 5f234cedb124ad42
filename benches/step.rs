//! What one step costs, kernel by kernel, on a square sheet of 64² to 1024² particles: hanging from two corners, and lying
//! on a sphere. Times are the least of 20 steps in µs, each pass alone; beside them stands the cost in state copies, the time
//! of a kernel that reads and writes position and velocity of every particle, which carries over between machines. Then
//! the bytes per particle.
//!
//! `cargo bench --bench step`, or `cargo bench --bench step -- --quick` for 64² and 256² only. Before them stands what a frame
//! costs the host; `-- --host` measures that alone. A polish is dispatched indirectly, which wgpu checks on the device
//! unless `WGPU_VALIDATION_INDIRECT_CALL=0` says not to.

mod support;

use std::time::Instant;
use support::Bench;
use toile::model::StepSettings;
use toile::{Cloth, Colliders};
use toile_lab::fixtures::{scene, shapes, sheet_model};

/// Frames whose recording is measured.
const HOST_FRAMES: usize = 20;

/// Steps that are measured.
const STEPS: usize = 20;

fn main() {
    let sizes: &[u32] = if has_option("--quick") { &[64, 256] } else { &[64, 128, 256, 512, 1024] };
    let bench = Bench::open();
    for (name, polish) in [("ball", None), ("moving-ball", None), ("ball", Some("{ target = 0.05, sweeps = 3 }"))] {
        measure_host(&bench, name, 128, polish);
    }
    if has_option("--host") {
        return;
    }
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
    let mut cloth = Cloth::new(&bench.device, &model, &settings, Colliders::new(None, shapes(&scene)))
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

/// What it takes the host to record a frame, and wgpu to finish the encoder: the least of some frames, whose work is done before the next.
fn measure_host(bench: &Bench, name: &str, size: u32, polish: Option<&str>) {
    let size_text = size.to_string();
    let keys: Vec<_> = [("n", size_text.as_str())].into_iter().chain(polish.map(|polish| ("polish", polish))).collect();
    let scene = scene(name, &keys);
    let model = sheet_model(&scene);
    let settings = StepSettings::new(&scene.settings, &model);
    let mut cloth = Cloth::new(&bench.device, &model, &settings, Colliders::new(None, shapes(&scene)))
        .unwrap_or_else(|error| panic!("{error}"));
    let steps = settings.steps_per_frame as usize;
    let dispatches = steps * cloth.plan().step.len() + cloth.plan().frame.len();
    let mut least = [f64::INFINITY; 2];
    for _ in 0..HOST_FRAMES {
        let start = Instant::now();
        let mut encoder = bench.device.create_command_encoder(&Default::default());
        cloth.record(&bench.device, &mut encoder);
        let recorded = start.elapsed();
        let commands = encoder.finish();
        let finished = start.elapsed();
        bench.queue.submit([commands]);
        bench.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        least[0] = least[0].min(1e3 * recorded.as_secs_f64());
        least[1] = least[1].min(1e3 * (finished - recorded).as_secs_f64());
    }
    let [record, finish] = least;
    let with = if polish.is_some() { " with a polish" } else { "" };
    println!(
        "\n{name} {size}²{with}: a frame is {dispatches} dispatches, recorded in {record:.2} ms, finished in {finish:.2} ms"
    );
}

/// Whether the option is among the arguments. cargo adds `--bench`, which says nothing.
fn has_option(option: &str) -> bool {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let known = ["--quick", "--host"];
    assert!(
        arguments.iter().all(|argument| known.contains(&argument.as_str())),
        "the options are {known:?}, not {arguments:?}"
    );
    arguments.iter().any(|argument| argument == option)
}
