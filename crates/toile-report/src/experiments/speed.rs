//! Frames per second against strain, and what the same frames would take on other memory.

use crate::Experiment;
use crate::page::{Axis, Block, Cell, Plot, Section, Series, SeriesStyle, Table};
use glam::DVec3;
use std::time::{Duration, Instant};
use toile::Colliders;
use toile::gpu::{GpuError, Maps, Plan};
use toile::model::{Model, StepSettings};
use toile::scene::{Settings, Shape, Sheet};
use toile_lab::scenes::{ball, fabric, hanging_sheet, square};
use toile_lab::{Lab, LabError, Run};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "speed", title: "Frames per second against strain", minutes: [0.5, 4.0], run };

/// Particles on a side, until the time is over.
const SIZES: [u32; 6] = [32, 64, 128, 256, 512, 1024];

/// Frames of a scene at 60 a second: the sheet has swung down and up again, or has folded over the sphere.
const FRAMES: u32 = 60;

/// Frames and steps that are timed: the fastest of them counts.
const TIMED: usize = 5;

/// What is read and written in a copy of the state: position and velocity of each particle [byte].
const STATE_BYTES: f64 = 64.0;

/// Frames per second that a size is looked for at [1/s].
const FRAME_RATE: f64 = 60.0;

/// Memory on paper: name and bytes per second.
const MEMORIES: [(&str, f64); 2] = [("1 TB/s", 1e12), ("4 TB/s", 4e12)];

/// What a dispatch costs on paper that waits for the one before it [s].
pub const DISPATCH: f64 = 4e-6;

/// What a sheet of one size does and costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Particles on a side.
    pub n: u32,
    /// Steps per frame.
    pub steps: u32,
    /// Dispatches per frame.
    pub dispatches: u64,
    /// Bytes per frame by the plan.
    pub bytes: u64,
    /// Time of a frame by the clock of the host [ms].
    pub frame: f64,
    /// Time of its kernels by the device's clock [ms]; `None` when the clock was too coarse for them.
    pub kernels: Option<f64>,
    /// Time of a copy of the state [ms]; `None` when the clock was too coarse for it.
    pub state_copy: Option<f64>,
    /// Largest elongation at the end of any frame, and 99th percentile at the last [1]; `None` where the time was over.
    pub strain: Option<[f64; 2]>,
}

impl Speed {
    /// Number of particles.
    pub fn particle_count(&self) -> u64 {
        u64::from(self.n) * u64::from(self.n)
    }

    /// Time of a frame on memory of so many bytes per second, on paper [ms].
    pub fn on_paper(&self, bytes_per_second: f64) -> f64 {
        1e3 * (self.dispatches as f64 * DISPATCH + self.bytes as f64 / bytes_per_second)
    }
}

/// The scenes: a sheet that swings on two corners, and one that falls on a sphere.
pub const SCENES: [&str; 2] = ["hang", "ball"];

fn scene(name: &str, n: u32) -> (Sheet, Settings, Vec<Shape>) {
    match name {
        "ball" => {
            let sheet = square(n, 1.0, DVec3::new(-0.5, 0.45, 0.5), DVec3::NEG_Z, Vec::new());
            (sheet, Settings::new(fabric()), vec![ball()])
        }
        _ => {
            let (sheet, settings) = hanging_sheet(n);
            (sheet, settings, Vec::new())
        }
    }
}

/// Runs a scene of n × n particles for so many frames and measures what a frame costs; without the frames where they would take longer
/// than `left`.
///
/// # Errors
/// [`LabError::Toile`] when the device is lost or does not hold the sheet.
pub fn measure(lab: &Lab, name: &str, n: u32, frames: u32, left: Duration) -> Result<Speed, LabError> {
    let (sheet, settings, shapes) = scene(name, n);
    let model = Model::from_sheet(&sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    let plan = Plan::new(&model, &step, Maps::None, !shapes.is_empty());
    let dispatches = u64::from(step.steps_per_frame) * plan.step.len() as u64 + plan.frame.len() as u64;
    let bytes = u64::from(step.steps_per_frame) * plan.traffic(&model, &step, &shapes);
    let mut run = Run::new(lab, model, step, Colliders::new(None, shapes))?;
    let mut frame = Duration::MAX;
    for _ in 0..TIMED {
        let start = Instant::now();
        run.frame(lab)?;
        frame = frame.min(start.elapsed());
    }
    // Reading the positions back takes time too, but less than a frame.
    let strain = (2 * frames * frame < left).then(|| strain(lab, &mut run, frames)).transpose()?;
    let cost = run.cost(lab, TIMED)?;
    let seen = |milliseconds: f64| (milliseconds > 0.0).then_some(milliseconds);
    Ok(Speed {
        n,
        steps: run.step.steps_per_frame,
        dispatches,
        bytes,
        frame: 1e3 * frame.as_secs_f64(),
        kernels: seen(f64::from(run.step.steps_per_frame) * cost.milliseconds()),
        state_copy: seen(cost.state_copy),
        strain,
    })
}

/// Goes on up to so many frames from the start; the largest elongation at the end of any of them, and the 99th percentile at the last.
fn strain(lab: &Lab, run: &mut Run, frames: u32) -> Result<[f64; 2], LabError> {
    let mut largest = 0.0_f64;
    let mut last = 0.0;
    for _ in TIMED as u32..frames {
        run.frame(lab)?;
        let elongations = run.elongations(lab)?;
        largest = largest.max(elongations[elongations.len() - 1]);
        last = elongations[elongations.len() * 99 / 100];
    }
    Ok([largest, last])
}

/// Particles on a side at which a frame takes `milliseconds`, by the power law between the sizes around it; `None` where none of
/// the points, n and time of a frame [ms] each in ascending order, is on one of its sides.
pub fn size_at(points: &[[f64; 2]], milliseconds: f64) -> Option<f64> {
    let [[n, time], [next_n, next_time]] =
        points.windows(2).map(|pair| [pair[0], pair[1]]).find(|[a, b]| a[1] <= milliseconds && milliseconds < b[1])?;
    let part = (milliseconds / time).ln() / (next_time / time).ln();
    Some(n * (next_n / n).powf(part))
}

/// What the lead says of the size that is looked for.
fn told(points: &[[f64; 2]]) -> String {
    let wanted = 1e3 / FRAME_RATE;
    match (points.first(), points.last(), size_at(points, wanted)) {
        (.., Some(n)) => format!("{n:.0} × {n:.0}"),
        (Some([n, time]), ..) if *time > wanted => format!("less than {n:.0} × {n:.0}"),
        (_, Some([n, _]), _) => format!("at least {n:.0} × {n:.0}"),
        _ => "unknown".to_owned(),
    }
}

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let start = Instant::now();
    let whole = Duration::from_secs(lab.pick(25, 220));
    let mut blocks = Vec::new();
    let mut leads = Vec::new();
    for (index, name) in SCENES.into_iter().enumerate() {
        let end = whole * (index as u32 + 1) / SCENES.len() as u32;
        let mut speeds: Vec<Speed> = Vec::new();
        let mut refused = None;
        for n in SIZES {
            let left = end.saturating_sub(start.elapsed());
            // Four times the particles take about four times as long; beside the timed frames there are the timed steps and the model.
            let next = speeds.last().map_or(0.0, |speed| 4e-3 * speed.frame * (3 * TIMED) as f64);
            if next > left.as_secs_f64() {
                break;
            }
            lab.say(start.elapsed().as_secs_f64() / whole.as_secs_f64(), &format!("{name} of {n} × {n} particles"))?;
            match measure(lab, name, n, FRAMES, left) {
                Err(LabError::Toile(toile::Error::Gpu(GpuError::BufferTooLarge { .. }))) => {
                    refused = Some(n);
                    break;
                }
                speed => speeds.push(speed?),
            }
        }
        let points = |of: &dyn Fn(&Speed) -> f64| -> Vec<[f64; 2]> {
            speeds.iter().map(|speed| [f64::from(speed.n), of(speed)]).collect()
        };
        let paper = MEMORIES.map(|(memory, rate)| (memory, told(&points(&|speed| speed.on_paper(rate)))));
        leads.push(format!(
            "{name}: {} here; on paper {} at {} and {} at {}",
            told(&points(&|speed| speed.frame)),
            paper[0].1,
            paper[0].0,
            paper[1].1,
            paper[1].0
        ));
        let mut words =
            format!("The scene {name}, default settings: {} steps per frame. ", speeds.first().map_or(0, |s| s.steps));
        if let Some(n) = refused {
            words.push_str(&format!("{n} × {n} particles do not fit the device. "));
        }
        blocks.push(Block::Table(table(&words, &speeds, lab)));
        let mut series = vec![Series::new("measured", SeriesStyle::LineAndMarks, points(&|speed| speed.frame))];
        series.extend(MEMORIES.map(|(memory, rate)| {
            Series::new(format!("on paper, {memory}"), SeriesStyle::Line, points(&|speed| speed.on_paper(rate)))
        }));
        blocks.push(Block::Plot(Plot {
            caption: format!(
                "Time of a frame of the scene {name} with n × n particles: by the clock of the host, and on paper, where a dispatch costs {:.0} µs and \
                 memory moves the bytes of the plan. {}",
                1e6 * DISPATCH,
                lab.place()
            ),
            x: Axis::log("n", ""),
            y: Axis::log("time of a frame", "ms"),
            series,
        }));
    }
    let lead = format!("The largest sheet at {FRAME_RATE:.0} frames per second. {}.", leads.join(". "));
    let mut section = EXPERIMENT.section(lead);
    section.blocks = blocks;
    Ok(section)
}

fn table(words: &str, speeds: &[Speed], lab: &Lab) -> Table {
    let caption = format!(
        "{words}A frame is the fastest of {TIMED} by the clock of the host, its kernels are the fastest of {TIMED} steps by that of the device. \
         Elongation: the largest at the end of any of {FRAMES} frames, and the 99th percentile at the last; none where the time was over. A state copy \
         reads and writes position and velocity of every particle. Bytes are those of the plan. {}",
        lab.place()
    );
    let mut table = Table::new(
        caption,
        &[
            ["n", ""],
            ["frame", "ms"],
            ["kernels", "ms"],
            ["kernels", "state copies"],
            ["dispatches", "1/frame"],
            ["particles", "million/s"],
            ["largest elongation", "%"],
            ["p99", "%"],
            ["moved", "byte per particle and step"],
            ["moved", "GB/s"],
            ["a state copy moves", "GB/s"],
            ["on paper, 1 TB/s", "ms"],
            ["on paper, 4 TB/s", "ms"],
        ],
    );
    for speed in speeds {
        let particles = speed.particle_count() as f64;
        let copied = speed.kernels.zip(speed.state_copy);
        let strain = |place: usize| Cell::number_or_missing(speed.strain.map(|strain| 100.0 * strain[place]));
        table.push(vec![
            Cell::Count(u64::from(speed.n)),
            Cell::number(speed.frame),
            Cell::number_or_missing(speed.kernels),
            Cell::number_or_missing(copied.map(|(kernels, copy)| kernels / copy)),
            Cell::Count(speed.dispatches),
            Cell::number(1e-3 * particles / speed.frame),
            strain(0),
            strain(1),
            Cell::number(speed.bytes as f64 / (particles * f64::from(speed.steps))),
            Cell::number_or_missing(speed.kernels.map(|kernels| 1e-6 * speed.bytes as f64 / kernels)),
            Cell::number_or_missing(speed.state_copy.map(|copy| 1e-6 * STATE_BYTES * particles / copy)),
            Cell::number(speed.on_paper(MEMORIES[0].1)),
            Cell::number(speed.on_paper(MEMORIES[1].1)),
        ]);
    }
    table
}
