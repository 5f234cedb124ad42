//! A scene that runs, on the device or by the reference, frame by frame.

use crate::adapter::Gpu;
use crate::interrupt;
use crate::look::{Look, State};
use crate::reference_run::ReferenceRun;
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use toile::gpu::{Kernel, PassTime, Timer};
use toile::model::{Dressing, Fit, Status, Verdict};
use toile::{Cloth, Simulation, Stage};

/// Steps that are timed pass by pass at the end of a run.
const TIMED_STEPS: u32 = 20;

/// What computes.
pub enum Computer {
    /// A device.
    Gpu(Gpu),
    /// The CPU reference.
    Reference,
}

/// A scene that runs.
pub enum Engine<'a> {
    /// On a device.
    Gpu {
        /// The device.
        gpu: &'a Gpu,
        /// The scene.
        simulation: Box<Simulation>,
    },
    /// By the reference.
    Reference(Box<ReferenceRun>),
}

impl Computer {
    /// Name for the metrics.
    pub fn name(&self) -> &str {
        match self {
            Computer::Gpu(gpu) => &gpu.name,
            Computer::Reference => "reference",
        }
    }

    /// A scene at its start.
    pub fn start(&self, fit: &Fit) -> Result<Engine<'_>> {
        Ok(match self {
            Computer::Gpu(gpu) => Engine::Gpu { gpu, simulation: Box::new(Simulation::fitted(&gpu.device, fit)?) },
            Computer::Reference => Engine::Reference(Box::new(ReferenceRun::new(&fit.scene)?)),
        })
    }
}

/// The status of a cloth at the end of what was waited for. One of an earlier frame, or none, would look like a calm cloth.
pub fn status(cloth: &Cloth) -> Result<Status> {
    let status = cloth.status()?.filter(|status| status.step == cloth.step());
    status.context("the device gave no status of the last frame: it may be lost")
}

/// Goes on by some seconds and waits; steps that were done.
pub fn advance(gpu: &Gpu, simulation: &mut Simulation, seconds: f64) -> Result<u32> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let advance = simulation.advance(&mut encoder, seconds)?;
    gpu.queue.submit([encoder.finish()]);
    gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
    Ok(advance.step_count)
}

impl Engine<'_> {
    /// What the scene is doing.
    pub fn stage(&mut self) -> Result<Stage> {
        match self {
            Engine::Gpu { simulation, .. } => Ok(simulation.stage()?),
            Engine::Reference(run) => Ok(run.stage()),
        }
    }

    /// Does one frame of `seconds` and waits for it; steps that were done.
    pub fn frame(&mut self, seconds: f64) -> Result<u32> {
        interrupt::check()?;
        match self {
            Engine::Gpu { gpu, simulation } => advance(gpu, simulation, seconds),
            Engine::Reference(run) => run.frame(),
        }
    }

    /// The cloths that are there, from the inside out; the last of them is the one that is being dressed.
    pub fn cloths<'a>(&'a self) -> Result<Vec<Look<'a>>> {
        match self {
            Engine::Gpu { simulation, .. } => {
                let look = |worn: toile::Worn<'a>| -> Result<Look<'a>> {
                    let (settings, status) = (worn.cloth.settings().clone(), worn.cloth.status()?.unwrap_or_default());
                    Ok(Look { name: worn.name, model: worn.model, settings, status })
                };
                simulation.cloths().map(look).collect()
            }
            Engine::Reference(run) => Ok(run.cloths()),
        }
    }

    /// How the garments were dressed, in their order.
    pub fn dressings(&self) -> Vec<Dressing> {
        match self {
            Engine::Gpu { simulation, .. } => simulation.dressings().cloned().collect(),
            Engine::Reference(run) => run.dressings(),
        }
    }

    /// How the garments are worn, in their order; empty once all go together.
    pub fn verdicts(&self) -> Result<Vec<Verdict>> {
        match self {
            Engine::Gpu { gpu, simulation } => Ok(simulation.verdicts(&gpu.queue)?),
            Engine::Reference(run) => Ok(run.verdicts()),
        }
    }

    /// Reads the cloths back, in their order.
    pub fn states(&self) -> Result<Vec<State>> {
        match self {
            Engine::Gpu { gpu, simulation } => simulation.cloths().map(|worn| State::of(gpu, worn.cloth)).collect(),
            Engine::Reference(run) => Ok(run.states()),
        }
    }

    /// For each cloth the kernels of a step and the median of what each costs per step [ms]; empty by the reference.
    /// It goes on by a few steps, so call it last.
    pub fn pass_times(&mut self) -> Result<Vec<BTreeMap<String, PassTime>>> {
        let Engine::Gpu { gpu, simulation } = self else { return Ok(Vec::new()) };
        let timer = Timer::new(&gpu.device, &gpu.queue)?;
        simulation.cloths_mut().map(|cloth| pass_times(gpu, &timer, cloth)).collect()
    }

    /// Bytes of each cloth on the device.
    pub fn bytes(&self) -> Vec<u64> {
        match self {
            Engine::Gpu { simulation, .. } => simulation.cloths().map(|worn| worn.cloth.bytes()).collect(),
            Engine::Reference(_) => Vec::new(),
        }
    }
}

fn pass_times(gpu: &Gpu, timer: &Timer, cloth: &mut Cloth) -> Result<BTreeMap<String, PassTime>> {
    let mut samples: BTreeMap<Kernel, Vec<PassTime>> = BTreeMap::new();
    for _ in 0..TIMED_STEPS {
        for (kernel, time) in cloth.time_step(&gpu.device, &gpu.queue, timer)? {
            samples.entry(kernel).or_default().push(time);
        }
    }
    let median = |mut times: Vec<PassTime>| {
        times.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
        times[times.len() / 2]
    };
    Ok(samples.into_iter().map(|(kernel, times)| (kernel.name().to_owned(), median(times))).collect())
}
