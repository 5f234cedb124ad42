//! What the start of a cloth costs: the first one of a device makes its pipelines, or finds them made; a further one makes the buffers of its state alone.
//! One that shares nothing makes all its buffers on the same device, with pipelines that are made before. Its model is made before, too. Each row is
//! the least of several starts, on a device of its own where pipelines are made.
//!
//! `cargo bench --bench start -- --n 16,64`.

use std::time::Instant;
use toile::gpu::Kernels;
use toile::model::{Model, StepSettings};
use toile::scene::{Cloth as Cut, Scene};
use toile::{Cloth, Colliders};
use toile_lab::INSTALL_HINT;
use toile_lab::fixtures::scene;

/// Starts of a row.
const STARTS: usize = 9;

/// What a start took.
struct Start {
    /// Until the cloth is made [ms].
    made: f64,
    /// Its first frame [ms].
    frame: f64,
    /// What it takes of the device that was not there before.
    bytes: u64,
}

/// A device of its own, whose driver has seen no kernel yet.
struct Bench {
    device: wgpu::Device,
    queue: wgpu::Queue,
}

impl Bench {
    fn new() -> Self {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle().with_env());
        let adapter = pollster::block_on(instance.request_adapter(&Default::default())).expect(INSTALL_HINT);
        let opened = pollster::block_on(adapter.request_device(&Default::default()));
        let (device, queue) = opened.expect("the adapter gives a device");
        Self { device, queue }
    }
}

fn main() {
    let sizes = std::env::args().skip_while(|word| word != "--n").nth(1).unwrap_or_else(|| "16,64".to_owned());
    // The first device of a process also loads the driver.
    let bench = Bench::new();
    Kernels::new(&bench.device).make_all();
    println!("{}", bench.device.adapter_info().name);
    println!("{:<52} {:>10} {:>10} {:>10}", "", "start [ms]", "frame [ms]", "[kB]");
    row("all pipelines, side by side", |bench| {
        let kernels = Kernels::new(&bench.device);
        let made = time(|| kernels.make_all());
        Start { made, frame: f64::INFINITY, bytes: 0 }
    });
    for n in sizes.split(',') {
        let (model, step, colliders) = hanging(n);
        let start = |kernels: &Kernels, bench: &Bench| {
            let (mut cloth, before) = (None, kernels.shared_bytes());
            let made = time(|| cloth = Some(Cloth::new(kernels, &model, &step, colliders.clone()).expect("it fits")));
            let mut cloth = cloth.expect("it was just made");
            // A driver may compile a kernel when it is first used.
            let frame = time(|| {
                let mut encoder = bench.device.create_command_encoder(&Default::default());
                cloth.record(&bench.device, &mut encoder);
                bench.queue.submit([encoder.finish()]);
                bench.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
            });
            Start { made, frame, bytes: cloth.own_bytes() + kernels.shared_bytes() - before }
        };
        row(&format!("{n} × {n}, the first of a device"), |bench| start(&Kernels::new(&bench.device), bench));
        row(&format!("{n} × {n}, the first, pipelines made before"), |bench| {
            let kernels = Kernels::new(&bench.device);
            kernels.make_all();
            start(&kernels, bench)
        });
        let bench = Bench::new();
        let kernels = Kernels::new(&bench.device);
        kernels.make_all();
        let _worn = Cloth::new(&kernels, &model, &step, colliders.clone()).expect("it fits");
        let (mut alone, mut further) = (Vec::new(), Vec::new());
        for _ in 0..STARTS {
            let apart = Kernels::new(&bench.device);
            apart.make_all();
            alone.push(start(&apart, &bench));
            further.push(start(&kernels, &bench));
        }
        print(&format!("{n} × {n}, a further one that shares nothing"), &alone);
        print(&format!("{n} × {n}, a further one"), &further);
    }
}

/// A sheet that hangs beside a sphere.
fn hanging(n: &str) -> (Model, StepSettings, Colliders) {
    let Scene { settings, cloths, bodies, .. } = scene("ball", &[("n", n)]);
    let [Cut::Sheet(sheet)] = cloths.as_slice() else { panic!("it is a sheet") };
    let model = Model::from_sheet(sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    let shapes = bodies.into_iter().filter_map(|body| match body {
        toile::scene::Body::Shape(shape) => Some(shape),
        _ => None,
    });
    (model, step, Colliders::new(None, shapes.collect()))
}

fn row(name: &str, start: impl Fn(&Bench) -> Start) {
    print(name, &(0..STARTS).map(|_| start(&Bench::new())).collect::<Vec<_>>());
}

fn print(name: &str, starts: &[Start]) {
    // What else the machine does only ever adds.
    let least = |of: fn(&Start) -> f64| starts.iter().map(of).fold(f64::INFINITY, f64::min);
    let frame = Some(least(|start| start.frame)).filter(|frame| frame.is_finite());
    let frame = frame.map_or(String::new(), |frame| format!("{frame:.1}"));
    let bytes = starts.iter().map(|start| start.bytes).min().filter(|bytes| *bytes > 0);
    let bytes = bytes.map_or(String::new(), |bytes| format!("{:.0}", bytes as f64 / 1e3));
    println!("{name:<52} {:>10.2} {frame:>10} {bytes:>10}", least(|start| start.made));
}

/// How long something takes [ms].
fn time(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    1e3 * start.elapsed().as_secs_f64()
}
