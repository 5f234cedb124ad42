//! Whether cloth holds its threshold at any resolution, and what that costs: a sheet of 1 m × 1 m that swings on two corners,
//! falls on a sphere, and lies on one that moves, under the rules that stay bounded. One row for each rule, scene and size: largest and
//! 99th percentile of the elongation at the end, the largest at the end of any frame, steps per frame, sweeps, passes and state
//! copies per frame; how fast the centre of mass of a free crumpled sheet drifts by itself as part of its mean speed, and by how much
//! its kinetic energy grows at most. With a polish also the further sweeps and the missed steps of the run, per step; its passes are
//! those that it may have, its cost is that of the steps after the run.
//!
//! `cargo bench --bench strain`, or with `-- --n 64,128 --rule hierarchical --scene hang --threshold 0.01 --frames 60 --polish 0.015,8`.

mod support;

use glam::{DVec3, Vec3};
use support::Bench;
use toile::gpu::readback;
use toile::model::{Arrays, Limit, Model, StepSettings};
use toile::scene::{Polish, Rule, Scene, Sheet, Threshold, VelocityModification};
use toile::{Cloth, Colliders, Strain};
use toile_lab::Random;
use toile_lab::fixtures::{scene, shapes, sheet_model};
use toile_lab::with;

const RULES: [(&str, Rule); 3] =
    [("none", Rule::None), ("predictive", Rule::Predictive), ("hierarchical", Rule::Hierarchical)];
const SCENES: [&str; 3] = ["hang", "ball", "moving-ball"];

/// Steps that are timed for the state copies.
const STEPS: usize = 5;

fn main() {
    let options = Options::read();
    let bench = Bench::open();
    println!(
        "{:<12} {:<12} {:>5} {:>9} | {:>8} {:>8} {:>8} | {:>5} {:>6} {:>6} {:>9} {:>8} | {:>8} {:>8} | {:>8} {:>8}",
        "rule",
        "scene",
        "n",
        "threshold",
        "max",
        "p99",
        "max run",
        "steps",
        "sweeps",
        "passes",
        "ms",
        "copies",
        "drift",
        "energy",
        "further",
        "missed"
    );
    for name in &options.scenes {
        for n in &options.sizes {
            for (rule_name, rule) in RULES.iter().filter(|(name, _)| options.rules.iter().any(|rule| rule == name)) {
                Row::measure(&bench, name, *n, *rule, &options).print(rule_name, name, *n, options.threshold);
            }
        }
    }
}

struct Options {
    scenes: Vec<String>,
    rules: Vec<String>,
    sizes: Vec<u32>,
    threshold: f64,
    frames: Option<u32>,
    polish: Option<Polish>,
}

impl Options {
    /// The options of the command line. cargo adds `--bench`, which says nothing.
    fn read() -> Self {
        let words = |list: &[&str]| list.iter().map(|word| (*word).to_owned()).collect();
        let mut options = Self {
            scenes: words(&SCENES),
            rules: words(&RULES.map(|(name, _)| name)),
            sizes: vec![64, 128, 256],
            threshold: 0.05,
            frames: None,
            polish: None,
        };
        let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
        while let Some(option) = arguments.next() {
            let value = arguments.next().unwrap_or_else(|| panic!("{option} needs a value"));
            let list = || value.split(',').map(str::to_owned).collect::<Vec<String>>();
            match option.as_str() {
                "--scene" => options.scenes = list(),
                "--rule" => options.rules = list(),
                "--n" => options.sizes = list().iter().map(|n| n.parse().expect("sizes are numbers")).collect(),
                "--threshold" => options.threshold = value.parse().expect("the threshold is a number"),
                "--frames" => options.frames = Some(value.parse().expect("the frames are a number")),
                "--polish" => {
                    let (target, sweeps) = value.split_once(',').expect("a polish is TARGET,SWEEPS");
                    let target = target.parse().expect("the target is a number");
                    let sweeps = sweeps.parse().expect("the sweeps are a number");
                    options.polish = Some(Polish { target, sweeps });
                }
                _ => panic!("there is no option {option}: --scene, --rule, --n, --threshold, --frames, --polish"),
            }
        }
        options
    }
}

struct Row {
    elongation_max: f64,
    elongation_p99: f64,
    elongation_max_over_run: f64,
    steps_per_frame: u32,
    sweeps: u32,
    passes_per_frame: u32,
    milliseconds_per_frame: f64,
    copies_per_frame: f64,
    /// Speed of the centre of mass of a free sheet, as part of the mean speed of its particles.
    drift: f64,
    /// Largest kinetic energy of a free sheet without springs, as part of that at the start, less one.
    energy_growth: f64,
    further_sweeps_per_step: f64,
    missed_steps_per_step: f64,
}

impl Row {
    fn measure(bench: &Bench, name: &str, n: u32, rule: Rule, options: &Options) -> Self {
        let mut scene = scene(name, &[("n", &n.to_string())]);
        // A polish works under the predictive rules alone.
        let polish = options.polish.filter(|_| rule != Rule::None);
        scene.settings.velocity_modification = VelocityModification::new(rule);
        scene.settings.velocity_modification.polish = polish;
        scene.settings.fabric.threshold = Threshold::even(options.threshold);
        let model = sheet_model(&scene);
        let settings = StepSettings::new(&scene.settings, &model);
        let colliders = Colliders::new(None, shapes(&scene));
        let mut cloth =
            Cloth::new(&bench.device, &model, &settings, colliders).unwrap_or_else(|error| panic!("{error}"));
        let frames = options.frames.unwrap_or(if name == "moving-ball" { 240 } else { 120 });
        let mut over_run = 0.0_f64;
        let mut elongations = vec![0.0];
        for _ in 0..frames {
            elongations = frame(bench, &mut cloth, &model.limits).unwrap_or_else(|| vec![f64::INFINITY]);
            over_run = over_run.max(elongations[elongations.len() - 1]);
            if over_run.is_infinite() {
                break;
            }
        }
        let strain = cloth.strain().ok().flatten();
        let per_step = |count: fn(&Strain) -> u32| {
            strain.as_ref().map_or(f64::INFINITY, |strain| f64::from(count(strain)) / strain.step as f64)
        };
        let further_sweeps_per_step = per_step(|strain| strain.further_sweeps);
        let missed_steps_per_step = per_step(|strain| strain.missed_steps);
        let cost = bench.step_cost(&mut cloth, STEPS);
        let dispatches: u32 = cost.kernels.iter().map(|(_, dispatches, _)| dispatches).sum();
        let steps = settings.steps_per_frame;
        let [drift, energy_growth] = free_sheet(bench, &scene);
        Self {
            elongation_max: elongations[elongations.len() - 1],
            elongation_p99: elongations[elongations.len() * 99 / 100],
            elongation_max_over_run: over_run,
            steps_per_frame: steps,
            sweeps: settings.sweeps,
            passes_per_frame: steps * dispatches,
            milliseconds_per_frame: f64::from(steps) * cost.milliseconds(),
            copies_per_frame: f64::from(steps) * cost.milliseconds() / cost.state_copy,
            drift,
            energy_growth,
            further_sweeps_per_step,
            missed_steps_per_step,
        }
    }

    fn print(&self, rule: &str, scene: &str, n: u32, threshold: f64) {
        println!(
            "{rule:<12} {scene:<12} {n:>5} {threshold:>9} | {:>8.4} {:>8.4} {:>8.4} | {:>5} {:>6} {:>6} {:>9.1} {:>8.0} | {:>8.1e} {:>8.1e} | {:>8.2} {:>8.3}",
            self.elongation_max,
            self.elongation_p99,
            self.elongation_max_over_run,
            self.steps_per_frame,
            self.sweeps,
            self.passes_per_frame,
            self.milliseconds_per_frame,
            self.copies_per_frame,
            self.drift,
            self.energy_growth,
            self.further_sweeps_per_step,
            self.missed_steps_per_step,
        );
    }
}

fn sheet(scene: &Scene) -> &Sheet {
    let [toile::scene::Cloth::Sheet(sheet)] = scene.cloths.as_slice() else {
        panic!("the scenes of this bench have one sheet")
    };
    sheet
}

/// Does a frame and gives the elongations at its end, sorted; `None` once the run has diverged.
fn frame(bench: &Bench, cloth: &mut Cloth, limits: &[Limit]) -> Option<Vec<f64>> {
    let mut encoder = bench.device.create_command_encoder(&Default::default());
    cloth.record(&bench.device, &mut encoder);
    bench.queue.submit([encoder.finish()]);
    let positions = read(bench, &cloth.frame().positions);
    cloth.status().ok()?;
    let elongation = |limit: &Limit| {
        let [a, b] = limit.ends.map(|end| positions[end as usize].as_dvec3());
        a.distance(b) / f64::from(limit.rest_length) - 1.0
    };
    let mut elongations: Vec<f64> = limits.iter().map(elongation).collect();
    elongations.sort_by(f64::total_cmp);
    Some(elongations)
}

fn read(bench: &Bench, buffer: &wgpu::Buffer) -> Vec<Vec3> {
    let read = readback::read_vec4s(&bench.device, &bench.queue, buffer).expect("the device answers");
    read.into_iter().map(|vector| vector.truncate()).collect()
}

/// A sheet without pins, body, gravity, damping and springs, crumpled at random, for half a second: only limits act.
fn free_sheet(bench: &Bench, scene: &Scene) -> [f64; 2] {
    let mut settings = scene.settings.clone();
    settings.gravity = DVec3::ZERO;
    let fabric = &mut settings.fabric;
    (fabric.structural_stiffness, fabric.shear_stiffness, fabric.bend_stiffness) = (0.0, 0.0, 0.0);
    fabric.damping = 0.0;
    let mut free = sheet(scene).clone();
    free.columns = 64;
    free.rows = 64;
    free.pins = Vec::new();
    let random = &mut Random::new(1);
    let crumple =
        |model: &mut Arrays| model.positions.iter_mut().for_each(|position| *position += random.vector(0.004));
    let model = Model::from_sheet(&free, &settings).changed(crumple).expect("particles elsewhere");
    let step = StepSettings::new(&settings, &model);
    let mut cloth = Cloth::new(&bench.device, &model, &with(step, |step| step.steps_per_frame = 1), Default::default())
        .unwrap_or_else(|error| panic!("{error}"));
    let mut one_step = || {
        let mut encoder = bench.device.create_command_encoder(&Default::default());
        cloth.record_steps(&bench.device, &mut encoder, 0..1, 1);
        bench.queue.submit([encoder.finish()]);
        let velocities = read(bench, cloth.velocities());
        let weighed = || velocities.iter().zip(&model.masses).map(|(v, mass)| (v.as_dvec3(), f64::from(*mass)));
        let momentum: DVec3 = weighed().map(|(v, mass)| v * mass).sum();
        let sum_of_speeds: f64 = weighed().map(|(v, mass)| v.length() * mass).sum();
        let energy: f64 = weighed().map(|(v, mass)| 0.5 * mass * v.length_squared()).sum();
        [momentum.length() / sum_of_speeds.max(f64::MIN_POSITIVE), energy]
    };
    // The first step sets the sheet in motion: what is over-long is pulled together.
    let [mut drift, start] = one_step();
    let mut energy_max = start;
    for _ in 0..480 {
        let [momentum, energy] = one_step();
        drift = drift.max(momentum);
        energy_max = energy_max.max(energy);
    }
    [drift, if start > 0.0 { energy_max / start - 1.0 } else { 0.0 }]
}
