//! What the start of a cloth costs: the first one of a device makes its pipelines, or finds them made; a further one makes buffers alone. Its model is
//! made before. Each row is the least of several starts, on a device of its own where pipelines are made.
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
    println!("{:<52} {:>10} {:>12}", "", "start [ms]", "frame [ms]");
    row("all pipelines, side by side", |bench| {
        let kernels = Kernels::new(&bench.device);
        let made = time(|| kernels.make_all());
        [made, f64::INFINITY]
    });
    for n in sizes.split(',') {
        let (model, step, colliders) = hanging(n);
        let start = |kernels: &Kernels, bench: &Bench| {
            let mut cloth = None;
            let start = time(|| cloth = Some(Cloth::new(kernels, &model, &step, colliders.clone()).expect("it fits")));
            let mut cloth = cloth.expect("it was just made");
            // A driver may compile a kernel when it is first used.
            let frame = time(|| {
                let mut encoder = bench.device.create_command_encoder(&Default::default());
                cloth.record(&bench.device, &mut encoder);
                bench.queue.submit([encoder.finish()]);
                bench.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
            });
            [start, frame]
        };
        row(&format!("{n} × {n}, the first of a device"), |bench| start(&Kernels::new(&bench.device), bench));
        row(&format!("{n} × {n}, the first, pipelines made before"), |bench| {
            let kernels = Kernels::new(&bench.device);
            kernels.make_all();
            start(&kernels, bench)
        });
        let (bench, mut further) = (Bench::new(), Vec::new());
        let kernels = Kernels::new(&bench.device);
        start(&kernels, &bench);
        further.extend((0..STARTS).map(|_| start(&kernels, &bench)));
        print(&format!("{n} × {n}, a further one"), further);
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

fn row(name: &str, start: impl Fn(&Bench) -> [f64; 2]) {
    print(name, (0..STARTS).map(|_| start(&Bench::new())).collect());
}

fn print(name: &str, starts: Vec<[f64; 2]>) {
    // What else the machine does only ever adds.
    let least = |which: usize| starts.iter().map(|times| times[which]).fold(f64::INFINITY, f64::min);
    let frame = Some(least(1)).filter(|frame| frame.is_finite()).map_or(String::new(), |frame| format!("{frame:.1}"));
    println!("{name:<52} {:>10.2} {frame:>12}", least(0));
}

/// How long something takes [ms].
fn time(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    1e3 * start.elapsed().as_secs_f64()
}
