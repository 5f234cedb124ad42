//! A cloth that has been simulated, and the way there.

use crate::engine::{Computer, Engine, Layer, State};
use crate::progress::Progress;
use crate::steps::step_settings;
use anyhow::{Context, Result, anyhow};
use std::collections::BTreeMap;
use std::time::Instant;
use toile::gpu::PassTime;
use toile::model::{Dressing, DressingError, Merge, Model, Stage, Status, StepSettings};
use toile::scene::{Garment, Mesh, Settings, Shape};

/// A cloth that has been simulated.
pub struct Worn {
    /// Name of the garment or sheet.
    pub name: String,
    /// What was simulated last: the sewn model of a garment.
    pub model: Model,
    /// The numbers of its steps.
    pub settings: StepSettings,
    /// The cloth at the end, one vertex per particle.
    pub mesh: Mesh,
    /// Which particles are in contact by the maps; empty without a body.
    pub touching: Vec<bool>,
    /// Status at the end.
    pub status: Status,
    /// Steps sewn.
    pub sewing_steps: u64,
    /// Steps draped or run.
    pub draping_steps: u64,
    /// Widest seam gap when the pairs were merged [m].
    pub seam_gap: f32,
    /// What was seen along the way.
    pub log: Log,
    /// Cost of a step by pass.
    pub pass_times: BTreeMap<String, PassTime>,
    /// Bytes on the device.
    pub gpu_bytes: u64,
}

/// What was seen along the way.
#[derive(Default)]
pub struct Log {
    /// Largest elongation at the end of any frame [1].
    pub elongation_max: f32,
    /// At the end of each frame of the run, or of draping.
    pub statuses: Vec<Status>,
    step_ms: Vec<f64>,
}

/// What a cloth is simulated with.
pub struct Surroundings<'a> {
    /// What computes.
    pub computer: &'a Computer,
    /// Body and inner garments.
    pub layers: &'a [Layer],
    /// Analytic shapes.
    pub shapes: Vec<Shape>,
    /// Edge length of a map texel [m].
    pub texel: f32,
    /// No progress.
    pub quiet: bool,
}

impl Log {
    fn frame(&mut self, engine: &mut Engine<'_>, settings: &StepSettings) -> Result<Status> {
        let start = Instant::now();
        let status = engine.frame()?;
        self.step_ms.push(1e3 * start.elapsed().as_secs_f64() / f64::from(settings.steps_per_frame));
        self.elongation_max = self.elongation_max.max(status.elongation_max);
        Ok(status)
    }

    /// Median wall time of a step [ms].
    pub fn step_ms_median(&self) -> f64 {
        let mut times = self.step_ms.clone();
        times.sort_by(f64::total_cmp);
        times.get(times.len() / 2).copied().unwrap_or(0.0)
    }
}

/// Sews a garment around what it finds, and drapes it until it is at rest.
pub fn dress(garment: &Garment, settings: &Settings, around: &Surroundings<'_>) -> Result<Worn> {
    let open = Model::from_garment(garment, settings)?;
    let open_settings = step_settings(&garment.name, settings, &open)?.sewing();
    let mut engine =
        around.computer.start(&open, &open_settings, around.layers, around.shapes.clone(), around.texel)?;
    let mut dressing = Dressing::new(&open, &open_settings);
    let mut log = Log::default();
    let progress = Progress::new(&garment.name, around.quiet);
    while dressing.stage() == Stage::Sewing {
        let status = log.frame(&mut engine, &open_settings)?;
        progress.say(format!("sewing, step {}, widest gap {:.1} mm", status.step, 1e3 * status.seam_gap_max));
        if let Err(error) = dressing.advance(&status, open.particle_count()) {
            return Err(name_seam(error, &open, &engine, &garment.name));
        }
    }
    let (sewn, merge) = open.sewn();
    let step = step_settings(&garment.name, settings, &sewn)?;
    engine = engine.sewn(&sewn, &merge, &step.easing())?;
    while dressing.stage() == Stage::Easing {
        let status = log.frame(&mut engine, &step.easing())?;
        progress.say(format!("easing, step {}, elongation {:.3}", status.step, status.elongation_max));
        dressing.advance(&status, sewn.particle_count()).with_context(|| format!("garment {}", garment.name))?;
    }
    let sewn_settings = step.draping();
    engine = engine.sewn(&sewn, &Merge::identity(sewn.particle_count()), &sewn_settings)?;
    while dressing.stage() == Stage::Draping {
        let status = log.frame(&mut engine, &sewn_settings)?;
        log.statuses.push(status);
        let energy = status.kinetic_energy / sewn.particle_count() as f32;
        progress.say(format!("draping, step {}, {energy:.1e} J per particle", status.step));
        dressing.advance(&status, sewn.particle_count()).with_context(|| format!("garment {}", garment.name))?;
    }
    progress.finish(format!("dressed in {} + {} steps", dressing.sewing_steps(), dressing.draping_steps()));
    let mut worn = finish(&garment.name, sewn, sewn_settings, engine, log)?;
    worn.sewing_steps = dressing.sewing_steps();
    worn.draping_steps = dressing.draping_steps();
    worn.seam_gap = dressing.seam_gap();
    Ok(worn)
}

/// Runs a cloth without seams for a number of frames.
pub fn run(name: &str, model: Model, frames: u32, settings: &Settings, around: &Surroundings<'_>) -> Result<Worn> {
    let settings = step_settings(name, settings, &model)?;
    let mut engine = around.computer.start(&model, &settings, around.layers, around.shapes.clone(), around.texel)?;
    let mut log = Log::default();
    let progress = Progress::new(name, around.quiet);
    for frame in 1..=frames {
        let status = log.frame(&mut engine, &settings)?;
        log.statuses.push(status);
        progress.say(format!("frame {frame} of {frames}, elongation {:.3}", status.elongation_max));
    }
    progress.finish(format!("{frames} frames of {} steps", settings.steps_per_frame));
    finish(name, model, settings, engine, log)
}

fn finish(name: &str, model: Model, settings: StepSettings, mut engine: Engine<'_>, log: Log) -> Result<Worn> {
    let status = log.statuses.last().copied().unwrap_or_default();
    let State { positions, normals, touching } = engine.state()?;
    Ok(Worn {
        name: name.to_owned(),
        mesh: Mesh { positions, normals, triangles: model.triangles() },
        model,
        settings,
        touching,
        status,
        sewing_steps: 0,
        draping_steps: status.step,
        seam_gap: 0.0,
        log,
        gpu_bytes: engine.bytes(),
        pass_times: engine.pass_times()?,
    })
}

/// Names the seam that stayed open.
fn name_seam(error: DressingError, open: &Model, engine: &Engine<'_>, garment: &str) -> anyhow::Error {
    let seam = match (&error, engine.state()) {
        (DressingError::SeamsOpen { .. }, Ok(state)) => {
            open.widest_seam(&state.positions).map(|(name, _)| format!(", seam {name}")).unwrap_or_default()
        }
        _ => String::new(),
    };
    anyhow!(error).context(format!("garment {garment}{seam}"))
}
