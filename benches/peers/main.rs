//! Toile beside other programs, on one scene, in one run, by one measure: a sheet of 1 m × 1 m that swings on two corners and falls on a
//! sphere, 60 frames of 1/60 s. Each program has several settings, so that a curve comes out of what a frame costs against the largest
//! elongation in the run.
//!
//! - toile, on the adapter that wgpu finds;
//! - NvCloth's scheme, ours, on one thread: not NVIDIA's code;
//! - Taichi's cloth example on its CPU backend, on all cores: `taichi_cloth.py`, in an environment that `--make-environments` makes.
//!
//! Programs take turns, and the times are medians of the repetitions. The middle of the sheet half-way is held against stiff cloth in f64: a sheet
//! that is slow to fall has little strain, too, and proves nothing.
//!
//! `cargo bench --bench peers`, once after `cargo bench --bench peers -- --make-environments`; the other options are said by `-- --help`.

mod environment;
mod options;
mod page;
mod settings;
mod taichi;

#[path = "../support/mod.rs"]
#[expect(dead_code, reason = "whole frames are timed here, no kernel alone")]
mod support;

use options::Options;
use settings::Program;
use std::process::ExitCode;
use std::time::{Duration, Instant};
use support::Bench;
use toile::{Cloth, Colliders};
use toile_lab::fixtures::shapes;
use toile_lab::peers::{Course, Figures, NvClothScheme, Trial, stiff_middle};

/// Particles on a side of the stiff sheet.
const STIFF_SIZE: u32 = 33;

/// What came of one setting of one program.
pub enum Outcome {
    /// Figures of each repetition.
    Done(Vec<Figures>),
    /// A position was not finite.
    Diverged,
    /// It took longer than the limit.
    Late,
    /// It could not be run, with why.
    Failed(String),
}

/// One row of the table.
pub struct Row {
    program: String,
    scene: String,
    n: u32,
    setting: String,
    outcome: Outcome,
    /// Where the middle of stiff cloth is half-way [m].
    stiff: glam::DVec3,
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            eprintln!("peers: {fault}");
            ExitCode::from(2)
        }
    }
}

fn run() -> Result<(), String> {
    let Some(options) = Options::read(std::env::args().skip(1))? else {
        println!("{}", options::HELP);
        return Ok(());
    };
    if options.make_environments {
        return environment::make();
    }
    // Before anything is measured: what cannot be written is a pity after an hour.
    for file in options.json.iter().chain(&options.plot) {
        std::fs::write(file, "").map_err(|error| format!("{} cannot be written: {error}", file.display()))?;
    }
    let python = environment::python();
    if let Err(hint) = &python {
        println!("Taichi is absent: {hint}");
    }
    let bench = Bench::open();
    let adapter = bench.device.adapter_info().name;
    let mut rows = Vec::new();
    for scene in &options.scenes {
        let stiff = stiff_middle(scene, STIFF_SIZE, f64::from(options.frames / 2) / 60.0);
        for n in &options.sizes {
            let trial = Trial::new(scene, *n);
            let mut programs = settings::programs(&trial);
            programs.retain(|(program, _)| python.is_ok() || !matches!(program, Program::Taichi(_)));
            let outcomes = measure(&bench, python.as_deref().ok(), &trial, &programs, &options);
            rows.extend(programs.into_iter().zip(outcomes).map(|((program, setting), outcome)| Row {
                program: program.name().to_owned(),
                scene: scene.clone(),
                n: *n,
                setting,
                outcome,
                stiff,
            }));
        }
    }
    let section = page::section(&rows, &adapter, &options, python.err().as_deref());
    println!("\n{}", page::text(&section));
    if let Some(file) = &options.plot {
        write(file, &page::svg(&section))?;
    }
    if let Some(file) = &options.json {
        write(file, &page::json(section, adapter))?;
    }
    let failed = rows.iter().filter(|row| matches!(row.outcome, Outcome::Failed(_))).count();
    if failed > 0 {
        return Err(format!("{failed} of {} settings failed, as the table says", rows.len()));
    }
    Ok(())
}

fn write(file: &std::path::Path, text: &str) -> Result<(), String> {
    std::fs::write(file, text).map_err(|error| format!("{} cannot be written: {error}", file.display()))
}

/// Lets every setting of every program run so often, in turns, so that what else the machine does meets all of them.
fn measure(
    bench: &Bench,
    python: Option<&std::path::Path>,
    trial: &Trial,
    programs: &[(Program, String)],
    options: &Options,
) -> Vec<Outcome> {
    let mut outcomes: Vec<Outcome> = programs.iter().map(|_| Outcome::Done(Vec::new())).collect();
    for repetition in 1..=options.repetitions {
        for ((program, setting), outcome) in programs.iter().zip(&mut outcomes) {
            let Outcome::Done(done) = outcome else { continue };
            eprintln!(
                "{repetition}/{}: {} {} {}, {setting}",
                options.repetitions,
                trial.scene.name,
                trial.n,
                program.name()
            );
            let limit = Duration::from_secs(options.limit);
            let ended = match program {
                Program::Toile(settings) => toile(bench, trial, settings, options.frames, limit),
                Program::NvCloth(settings, iterations) => {
                    let mut scheme = NvClothScheme::new(trial, *settings);
                    course(options.frames, limit, || {
                        let start = Instant::now();
                        scheme.advance(trial.frame_seconds(), *iterations);
                        Ok(Some((start.elapsed(), scheme.positions())))
                    })
                }
                Program::Taichi(settings) => {
                    let python = python.expect("a program that is absent has no rows");
                    taichi::course(python, trial, *settings, options.frames, limit)
                }
            };
            match ended {
                Ok(Ended::Whole(course)) => match course.figures(trial.n as usize, trial.spacing()) {
                    Some(figures) => done.push(figures),
                    None => *outcome = Outcome::Diverged,
                },
                Ok(Ended::Diverged) => *outcome = Outcome::Diverged,
                Ok(Ended::Late) => *outcome = Outcome::Late,
                Err(fault) => *outcome = Outcome::Failed(fault),
            }
        }
    }
    outcomes
}

/// How a run ended.
pub enum Ended {
    /// With all its frames.
    Whole(Course),
    /// The program itself said that it diverged.
    Diverged,
    /// It was stopped at the limit.
    Late,
}

/// A run within this process: `frame` does a frame and gives its time and positions, or nothing once it has diverged.
fn course(
    frames: u32,
    limit: Duration,
    mut frame: impl FnMut() -> Result<Option<(Duration, Vec<glam::Vec3>)>, String>,
) -> Result<Ended, String> {
    let (start, mut course) = (Instant::now(), Course::default());
    for _ in 0..frames {
        let Some((time, positions)) = frame()? else { return Ok(Ended::Diverged) };
        course.milliseconds.push(1e3 * time.as_secs_f64());
        course.positions.push(positions);
        if start.elapsed() > limit {
            return Ok(Ended::Late);
        }
    }
    Ok(Ended::Whole(course))
}

/// Toile: the frame is recorded, submitted and awaited within the time, and read back outside of it.
fn toile(
    bench: &Bench,
    trial: &Trial,
    settings: &toile::scene::Settings,
    frames: u32,
    limit: Duration,
) -> Result<Ended, String> {
    let [toile::scene::Cloth::Sheet(sheet)] = trial.scene.cloths.as_slice() else { panic!("a trial has one sheet") };
    let model = toile::model::Model::from_sheet(sheet, settings);
    let step = toile::model::StepSettings::new(settings, &model);
    let colliders = Colliders::new(None, shapes(&trial.scene));
    let mut cloth = Cloth::new(&bench.device, &model, &step, colliders).map_err(|error| error.to_string())?;
    course(frames, limit, || {
        let start = Instant::now();
        let mut encoder = bench.device.create_command_encoder(&Default::default());
        cloth.record(&bench.device, &mut encoder);
        bench.queue.submit([encoder.finish()]);
        bench.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| error.to_string())?;
        let time = start.elapsed();
        if let Err(error) = cloth.status() {
            return if matches!(error, toile::Error::Diverged { .. }) { Ok(None) } else { Err(error.to_string()) };
        }
        let read = toile::gpu::readback::read_vec4s(&bench.device, &bench.queue, &cloth.frame().positions);
        let positions = read.map_err(|error| error.to_string())?;
        Ok(Some((time, positions.into_iter().map(|position| position.truncate()).collect())))
    })
}
