//! A walk: an outfit is dressed and goes along with the body, frame by frame.

mod regions;
mod rows;
mod saved;
mod stage;
mod walker;

use crate::adapter::{self, Gpu};
use crate::args::{Backend, Running};
use crate::engine::{self, Engine, status};
use crate::interrupt;
use crate::look::State;
use crate::outcome::{self, Outcome};
use crate::output;
use crate::picture::{self, Drawn, Material, View};
use crate::progress::Progress;
use crate::stdout::print;
use crate::worn::{self, Log};
use anyhow::{Context, Result, bail};
use glam::Vec3;
use image::RgbImage;
use regions::Regions;
use rows::{FrameRow, WalkMetrics};
use saved::Saved;
use stage::Stage;
use std::fmt::Write;
use std::hash::{DefaultHasher, Hasher};
use std::path::Path;
use std::time::Instant;
use toile::Simulation;
use toile::files::{MovingFaces, write_atomically, write_pc2, write_usda};
use toile::gpu::{Kernel, Timer};
use toile::model::{Fit, Solid, Status, Verdict};
use toile::scene::{Cloth, Mesh, MovingMesh, Settings};
use toile_reference::ExactDistance;
use walker::Walker;

/// Frames in the strip.
const STRIP_COUNT: u32 = 6;
/// What ctrl-c leaves of a walk that has begun.
const KEPT: &str = "interrupted: every frame so far is kept, go on with --resume";

/// What walks.
pub struct Walk {
    /// The body and its motion.
    pub body: MovingMesh,
    /// The body with its garments, looked at before they are sewn.
    pub fit: Fit,
    /// How they are simulated, at the frame rate of the walk.
    pub settings: Settings,
    /// Number of frames after the first.
    pub frame_count: u32,
    /// Whether the maps of a round are drawn once and kept.
    pub precompute_maps: bool,
    /// Whether to go on where an interrupted walk ended.
    pub resume: bool,
    /// Height of the pictures [px].
    pub height: u32,
    /// From where they look.
    pub views: Vec<View>,
}

impl Walk {
    /// All that decides the result, as text: a walk goes on only with the same.
    fn identity(&self, gpu: &Gpu) -> String {
        let mut digest = Digest(DefaultHasher::new());
        write!(digest, "{:?}", (&self.body, &self.fit.dress_in, &self.fit.scene.cloths))
            .expect("a digest takes every text");
        format!(
            "toile {} on {}\n{:?}\n{} frames, maps kept: {}\nbody and garments {:016x}\n",
            env!("CARGO_PKG_VERSION"),
            gpu.name,
            self.settings,
            self.frame_count,
            self.precompute_maps,
            digest.0.finish(),
        )
    }

    /// The simulation at its start.
    fn simulation(&self, gpu: &Gpu) -> Result<Simulation> {
        Ok(Simulation::fitted(&gpu.device, &self.fit)?)
    }
}

/// A text as one number.
struct Digest(DefaultHasher);

impl std::fmt::Write for Digest {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}

/// Dresses and walks, and writes pictures, motion and metrics.
pub fn walk(walk: &Walk, running: &Running) -> Result<Outcome> {
    output::check(&running.out, "metrics.json")?;
    if running.place.backend == Backend::Reference {
        bail!("--backend reference: a walk needs a device; toile dress runs without one");
    }
    let gpu = adapter::open(&running.place)?;
    let saved = Saved::open(&running.out, walk.identity(&gpu), walk.resume)?;
    let mut simulation = walk.simulation(&gpu)?;
    if walk.precompute_maps {
        let bytes =
            simulation.keep_maps().context("--precompute-maps: leave the option out, or change --clip or --fps")?;
        if !running.quiet && !running.json {
            print(&format!("the maps of a round take {:.0} MiB", bytes as f64 / f64::from(1 << 20)))?;
        }
    }
    match saved.frame_count() {
        0 => {
            let verdicts;
            (simulation, verdicts) = dress(walk, &gpu, simulation, running)?;
            saved.begin(&verdicts)?;
            saved.write(0, &simulation.save(&gpu.queue)?, &positions(&gpu, &simulation)?, None)?;
        }
        count => {
            let state = saved.state(count - 1)?;
            simulation.restore(&gpu.queue, &state).with_context(|| saved.damaged(count - 1))?;
        }
    }
    let walkers: Vec<Walker> = simulation.cloths().map(Walker::of).collect();
    let collision_part = simulate(walk, &gpu, &mut simulation, &saved, running)?;
    let (rows, verdicts) = (saved.rows(walk.frame_count)?, saved.verdicts()?);
    finish(walk, &walkers, &saved, running)?;
    let metrics = WalkMetrics::new(&gpu.name, &walk.fit, &walkers, &verdicts, collision_part, rows);
    let text = serde_json::to_string_pretty(&metrics)?;
    write_atomically(&running.out.join("metrics.json"), text.as_bytes())?;
    saved.remove()?;
    if running.json {
        print(&text)?;
    } else if !running.quiet {
        for jump in metrics.jumps() {
            print(&jump)?;
        }
        print(&metrics.line())?;
        print(&format!("wrote {}", running.out.display()))?;
    }
    Ok(Outcome::of(&verdicts))
}

/// Dresses the garments one over the other, says how they are worn, and has the body go over to the start of its walk.
fn dress(walk: &Walk, gpu: &Gpu, simulation: Simulation, running: &Running) -> Result<(Simulation, Vec<Verdict>)> {
    let seconds = 1.0 / walk.settings.frame_rate;
    let mut logs: Vec<Log> = walk.fit.scene.cloths.iter().map(|_| Log::default()).collect();
    let mut engine = Engine::Gpu { gpu, simulation: Box::new(simulation) };
    worn::dress(&mut engine, &mut logs.iter_mut().collect::<Vec<_>>(), seconds, running.hides_progress())?;
    let verdicts = engine.verdicts()?;
    for (garment, verdict) in walk.fit.scene.cloths.iter().zip(&verdicts).filter(|_| !running.quiet) {
        let name = match garment {
            Cloth::Garment(garment) => &garment.name,
            Cloth::Sheet(sheet) => &sheet.name,
        };
        outcome::warn(name, verdict);
    }
    let Engine::Gpu { mut simulation, .. } = engine else { unreachable!("it was just made") };
    // No time passes: what comes next begins.
    engine::advance(gpu, &mut simulation, 0.0)?;
    while simulation.stage()? != toile::Stage::Running {
        interrupt::check()?;
        engine::advance(gpu, &mut simulation, seconds)?;
        for worn in simulation.cloths() {
            status(worn.cloth)?;
        }
        engine::advance(gpu, &mut simulation, 0.0)?;
    }
    Ok((*simulation, verdicts))
}

/// Positions of all cloths [m].
fn positions(gpu: &Gpu, simulation: &Simulation) -> Result<Vec<Vec<Vec3>>> {
    simulation.cloths().map(|worn| Ok(State::of(gpu, worn.cloth)?.positions)).collect()
}

/// Walks, frame by frame, and says which part of a step goes to the bodies.
fn simulate(walk: &Walk, gpu: &Gpu, simulation: &mut Simulation, saved: &Saved, running: &Running) -> Result<f64> {
    let seconds = 1.0 / walk.settings.frame_rate;
    let done = saved.frame_count() - 1;
    let regions = Regions::new(&walk.body);
    let stage = Stage::new(&walk.body, f64::from(walk.frame_count) * seconds);
    std::fs::create_dir_all(&running.out)?;
    let progress = Progress::counted("walking", running.hides_progress(), walk.frame_count, done);
    let mut told = 0;
    let before = simulation.cloths().map(|worn| Ok(worn.cloth.status()?.unwrap_or_default()));
    let mut last: Vec<Status> = before.collect::<Result<_>>()?;
    for frame in done + 1..=walk.frame_count {
        interrupt::check().context(KEPT)?;
        let time = f64::from(frame) * seconds;
        let (_, [maps_ms, simulated_ms]) = simulation.advance_timed(&gpu.queue, seconds)?;
        let output = Instant::now();
        let body = walk.body.at(time);
        let (exact, mut inner) = ((ExactDistance::new(&body), Solid::of([&body])), Vec::new());
        let mut row = FrameRow::new(frame, time, maps_ms, simulated_ms);
        row.teleports = simulation.teleports().to_vec();
        row.teleports.drain(..told);
        told += row.teleports.len();
        let (mut points, mut cloths) = (Vec::new(), Vec::new());
        for (worn, last) in simulation.cloths().zip(&mut last) {
            let status = status(worn.cloth)?;
            row.add_polish(last, &status);
            *last = status;
            let state = State::of(gpu, worn.cloth)?;
            let (thickness, texel) = (f64::from(worn.cloth.settings().thickness), walk.settings.texel as f32);
            row.add(worn.model, &state, &status, &exact, &inner, &body, &regions, thickness, texel);
            let mesh = Mesh { positions: state.positions, normals: state.normals, triangles: worn.model.triangles() };
            points.push(mesh.positions.clone());
            if points.len() < walk.fit.scene.cloths.len() {
                inner.push(ExactDistance::new(&mesh));
            }
            cloths.push(mesh);
        }
        let pictures = Instant::now();
        let views = draw(walk, &body, &cloths, stage.at(time))?;
        picture::save_png(&picture_path(&running.out, frame), &picture::strip(&views))?;
        row.picture_ms = 1e3 * pictures.elapsed().as_secs_f64();
        row.output_ms = 1e3 * output.elapsed().as_secs_f64();
        saved.write(frame, &simulation.save(&gpu.queue)?, &points, Some(&row))?;
        progress.reach(frame);
        progress.say(format!("frame {frame} of {}", walk.frame_count));
    }
    progress.finish(format!("{} frames", walk.frame_count));
    collision_part(gpu, simulation)
}

/// Which part of one more step of every garment goes to the bodies [1]: each pass is timed alone.
fn collision_part(gpu: &Gpu, simulation: &mut Simulation) -> Result<f64> {
    let timer = Timer::new(&gpu.device, &gpu.queue)?;
    let [mut whole, mut collision] = [0.0; 2];
    for cloth in simulation.cloths_mut() {
        for (kernel, time) in cloth.time_step(&gpu.device, &gpu.queue, &timer)? {
            match kernel {
                Kernel::StateCopy => continue,
                Kernel::Reaction
                | Kernel::QuadMidpoints
                | Kernel::SampleMovingSides
                | Kernel::SampleMovingLayers
                | Kernel::Collide
                | Kernel::KeepOut => {
                    collision += time.milliseconds;
                }
                _ => {}
            }
            whole += time.milliseconds;
        }
    }
    Ok(if whole > 0.0 { collision / whole } else { 0.0 })
}

/// The views of a frame.
fn draw(walk: &Walk, body: &Mesh, cloths: &[Mesh], stage: [Vec3; 2]) -> Result<Vec<RgbImage>> {
    let worn = cloths.iter().zip(walk.fit.scene.fabrics()).enumerate();
    let mut drawn = vec![Drawn::body(body)];
    drawn.extend(worn.map(|(i, (mesh, fabric))| Drawn::cloth(mesh, i, fabric.thickness)));
    Ok(picture::render(&drawn, Some(stage), &walk.views, walk.height)?)
}

fn picture_path(folder: &Path, frame: u32) -> std::path::PathBuf {
    folder.join(format!("frame_{frame:04}.png"))
}

/// Draws some frames side by side, one view above the other.
fn draw_strip(walk: &Walk, walkers: &[Walker], saved: &Saved, folder: &Path) -> Result<()> {
    let seconds = 1.0 / walk.settings.frame_rate;
    let stage = Stage::new(&walk.body, f64::from(walk.frame_count) * seconds);
    let count = STRIP_COUNT.min(walk.frame_count);
    let mut views = vec![Vec::new(); walk.views.len()];
    for index in 1..=count {
        let frame = index * walk.frame_count / count;
        let time = f64::from(frame) * seconds;
        let cloth = |(mesh, walker): (usize, &Walker)| -> Result<Mesh> {
            let positions = saved.positions(frame, mesh)?;
            let mut mesh = Mesh { positions, normals: Vec::new(), triangles: walker.triangles.clone() };
            mesh.normals = mesh.area_weighted_normals();
            Ok(mesh)
        };
        let cloths = walkers.iter().enumerate().map(cloth).collect::<Result<Vec<_>>>()?;
        let drawn = draw(walk, &walk.body.at(time), &cloths, stage.at(time))?;
        views.iter_mut().zip(drawn).for_each(|(row, view)| row.push(view));
    }
    Ok(picture::save_png(
        &folder.join("walk.png"),
        &picture::stack(&views.iter().map(|row| picture::strip(row)).collect::<Vec<_>>()),
    )?)
}

/// Writes the motion and the moving picture from what was saved of each frame.
fn finish(walk: &Walk, walkers: &[Walker], saved: &Saved, running: &Running) -> Result<()> {
    let count = walk.frame_count as usize + 1;
    let rate = walk.settings.frame_rate;
    let faces: Vec<MovingFaces<'_>> = walkers
        .iter()
        .enumerate()
        .map(|(i, walker)| MovingFaces::new(&walker.name, &walker.triangles, Material::cloth(i).linear_outside()))
        .collect();
    let progress = Progress::new("files", running.hides_progress());
    let points = |mesh: usize, frame: usize| -> Result<Vec<Vec3>> {
        interrupt::check().context(KEPT)?;
        progress.say(format!("motion of frame {frame}"));
        saved.positions(frame as u32, mesh)
    };
    write_usda(&running.out.join("walk.usda"), &faces, count, rate, points)?;
    for (index, walker) in walkers.iter().enumerate() {
        let path = running.out.join(format!("{index}_{}.pc2", walker.name));
        write_pc2(&path, walker.particle_count as usize, count, |frame| points(index, frame))?;
    }
    progress.say("drawing walk.png".to_owned());
    draw_strip(walk, walkers, saved, &running.out)?;
    let frames = (1..=walk.frame_count).map(|frame| {
        progress.say(format!("frame {frame} of walk.gif"));
        picture_path(&running.out, frame)
    });
    picture::save_gif(&running.out.join("walk.gif"), frames, rate)?;
    progress.finish("written".to_owned());
    Ok(())
}
