//! The cloths of a scene that have been simulated, and the way there.

use crate::args::Running;
use crate::bodies::{meshes, shapes};
use crate::engine::{Computer, Engine};
use crate::look::{Look, State};
use crate::outcome;
use crate::progress::Progress;
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::time::Instant;
use toile::Stage;
use toile::gpu::PassTime;
use toile::model::{
    CALM_FRAMES, DressingStage, Fit, Judged, Model, Motion, REST_SPEED, Solid, Status, StepSettings, Verdict,
};
use toile::scene::{Cloth, Mesh, Scene};

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
    /// Widest seam gap at the end of sewing [m].
    pub seam_gap: f32,
    /// How it is worn; `None` of a sheet.
    pub verdict: Option<Verdict>,
    /// What was seen along the way.
    pub log: Log,
    /// Cost of a step by pass.
    pub pass_times: BTreeMap<String, PassTime>,
    /// Bytes on the device.
    pub gpu_bytes: u64,
}

/// What was seen along the way of a cloth.
#[derive(Default)]
pub struct Log {
    /// At the end of each frame of the run, or of draping.
    pub statuses: Vec<Status>,
    step_ms: Vec<f64>,
}

impl Log {
    fn add(&mut self, settings: &StepSettings, milliseconds: f64) {
        self.step_ms.push(milliseconds / f64::from(settings.steps_per_frame));
    }

    /// Largest elongation at the end of any frame of the run, or of draping [1]: while seams close, cloth is drawn out that nobody wears yet.
    pub fn elongation_max(&self) -> f32 {
        self.statuses.iter().map(|status| status.elongation_max).fold(0.0, f32::max)
    }

    /// Median wall time of a step [ms].
    pub fn step_ms_median(&self) -> f64 {
        let mut times = self.step_ms.clone();
        times.sort_by(f64::total_cmp);
        times.get(times.len() / 2).copied().unwrap_or(0.0)
    }
}

/// Longest simulated time that dressed garments have to come to rest once the body stands as it is given [s].
const HANGING_SECONDS: f64 = 6.0;

/// Dresses the garments of a scene one over the other; where it has sheets, everything then runs for its frames.
pub fn run(fit: &Fit, frames: u32, computer: &Computer, running: &Running) -> Result<Vec<Worn>> {
    let scene = &fit.scene;
    let mut engine = computer.start(fit)?;
    let seconds = 1.0 / scene.settings.frame_rate;
    let mut logs: Vec<Log> = scene.cloths.iter().map(|_| Log::default()).collect();
    let of_garments = scene.cloths.iter().zip(&mut logs).filter(|(cloth, _)| matches!(cloth, Cloth::Garment(_)));
    let hides = running.hides_progress();
    dress(&mut engine, &mut of_garments.map(|(_, log)| log).collect::<Vec<_>>(), seconds, hides)?;
    let (dressings, mut verdicts) = (engine.dressings(), engine.verdicts()?);
    let has_sheets = scene.cloths.iter().any(|cloth| matches!(cloth, Cloth::Sheet(_)));
    if fit.dress_in.is_some() && !has_sheets {
        verdicts = hang(&mut engine, scene, seconds, hides)?;
    }
    let mut dressed = dressings.into_iter().zip(verdicts);
    if has_sheets {
        run_frames(&mut engine, &mut logs, scene, frames, seconds, hides)?;
    }
    let (states, bytes) = (engine.states()?, engine.bytes());
    let mut worn = Vec::new();
    for ((look, State { positions, normals, touching }), log) in engine.cloths()?.into_iter().zip(states).zip(logs) {
        let is_garment = matches!(scene.cloths[worn.len()], Cloth::Garment(_));
        let (dressing, verdict) = if is_garment { dressed.next() } else { None }.unzip();
        if let Some(verdict) = verdict.as_ref().filter(|_| !running.quiet) {
            outcome::warn(look.name, verdict);
        }
        worn.push(Worn {
            name: look.name.to_owned(),
            mesh: Mesh { positions, normals, triangles: look.model.triangles() },
            model: look.model.clone(),
            settings: look.settings,
            touching,
            status: look.status,
            sewing_steps: dressing.as_ref().map_or(0, |dressing| dressing.sewing_steps()),
            draping_steps: dressing.as_ref().map_or(look.status.step, |dressing| dressing.draping_steps()),
            seam_gap: dressing.as_ref().map_or(0.0, |dressing| dressing.seam_gap()),
            verdict,
            log,
            gpu_bytes: bytes.get(worn.len()).copied().unwrap_or(0),
            pass_times: BTreeMap::new(),
        });
    }
    for (worn, times) in worn.iter_mut().zip(engine.pass_times()?) {
        worn.pass_times = times;
    }
    Ok(worn)
}

/// Dresses every garment until it is at rest or its time is up. There is a log for each garment.
pub fn dress(engine: &mut Engine<'_>, logs: &mut [&mut Log], seconds: f64, hides_progress: bool) -> Result<()> {
    let mut told: Vec<Progress> = Vec::new();
    loop {
        let stage = engine.stage()?;
        for (progress, dressing) in told.iter().zip(engine.dressings()) {
            if dressing.stage() == DressingStage::Dressed {
                let (sewing, draping) = (dressing.sewing_steps(), dressing.draping_steps());
                progress.finish(format!("dressed in {sewing} + {draping} steps"));
            }
        }
        if stage >= Stage::Dressed {
            return Ok(());
        }
        let start = Instant::now();
        if engine.frame(seconds)? == 0 {
            // The device has still to say how large the garments below are.
            continue;
        }
        let milliseconds = 1e3 * start.elapsed().as_secs_f64();
        let cloths = engine.cloths()?;
        let look = cloths.last().context("a garment is being dressed")?;
        let log = &mut logs[cloths.len() - 1];
        log.add(&look.settings, milliseconds);
        if stage == Stage::Draping {
            log.statuses.push(look.status);
        }
        if told.len() < cloths.len() {
            told.push(Progress::new(look.name, hides_progress));
        }
        if let Some(progress) = told.last() {
            progress.say(stage_line(stage, look));
        }
    }
}

/// Goes over from the pose that garments were sewn in to how the body stands, and on until they are at rest or their time is up; how they are
/// worn then.
fn hang(engine: &mut Engine<'_>, scene: &Scene, seconds: f64, hides_progress: bool) -> Result<Vec<Verdict>> {
    let progress = Progress::new("arms", hides_progress);
    // No time passes: what comes next begins.
    engine.frame(0.0)?;
    while engine.stage()? != Stage::Running {
        engine.frame(seconds)?;
        engine.frame(0.0)?;
        progress.say("lowering".into());
    }
    let mut motions = vec![Motion::default(); scene.cloths.len()];
    let mut calm_frames = 0;
    for frame in 0..(HANGING_SECONDS / seconds) as u64 {
        engine.frame(seconds)?;
        for (motion, state) in motions.iter_mut().zip(engine.states()?) {
            motion.see(frame + 1, state.positions, seconds as f32);
        }
        let is_calm = motions.iter().all(|motion| motion.speed().is_some_and(|speed| speed <= REST_SPEED));
        calm_frames = if is_calm { calm_frames + 1 } else { 0 };
        progress.say(format!("hanging, frame {frame}"));
        if calm_frames >= CALM_FRAMES {
            break;
        }
    }
    progress.finish("lowered".into());
    let shapes: Vec<Mesh> = shapes(scene).iter().map(|shape| shape.mesh(0.0)).collect();
    let body = Solid::of(meshes(scene).chain(&shapes));
    let is_at_rest = calm_frames >= CALM_FRAMES;
    let judged = engine.cloths()?.into_iter().zip(&motions).map(|(look, motion)| {
        Verdict::of(&Judged::new(look.model, motion.positions(), motion.velocities(), is_at_rest), &body)
    });
    Ok(judged.collect())
}

fn stage_line(stage: Stage, look: &Look<'_>) -> String {
    let status = &look.status;
    match stage {
        Stage::Sewing => format!("sewing, step {}, widest gap {:.1} mm", status.step, 1e3 * status.seam_gap_max),
        Stage::Easing => format!("easing, step {}, elongation {:.3}", status.step, status.elongation_max),
        _ => {
            let energy = status.kinetic_energy / look.model.particle_count().max(1) as f32;
            format!("draping, step {}, {energy:.1e} J per particle", status.step)
        }
    }
}

/// Runs all cloths together for the frames of the scene.
fn run_frames(
    engine: &mut Engine<'_>,
    logs: &mut [Log],
    scene: &Scene,
    count: u32,
    seconds: f64,
    hides_progress: bool,
) -> Result<()> {
    let progress = Progress::new(&scene.name, hides_progress);
    logs.iter_mut().for_each(|log| log.statuses.clear());
    let mut frame = 0;
    while frame < count {
        let start = Instant::now();
        if engine.frame(seconds)? == 0 {
            continue;
        }
        frame += 1;
        let milliseconds = 1e3 * start.elapsed().as_secs_f64();
        let cloths = engine.cloths()?;
        for (look, log) in cloths.iter().zip(logs.iter_mut()) {
            log.add(&look.settings, milliseconds);
            log.statuses.push(look.status);
        }
        let elongation = cloths.iter().map(|look| look.status.elongation_max).fold(0.0, f32::max);
        progress.say(format!("frame {frame} of {count}, elongation {elongation:.3}"));
    }
    progress.finish(format!("{frame} frames"));
    Ok(())
}
