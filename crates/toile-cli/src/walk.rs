//! A walk: an outfit is dressed in the first pose of a clip and goes along with the body, frame by frame.

pub mod dressing;
mod regions;
mod rows;
mod saved;
mod stage;

use crate::adapter::{self, Gpu};
use crate::args::{Backend, Running};
use crate::commands::print;
use crate::engine::{Computer, Layer, status};
use crate::interrupt;
use crate::output;
use crate::picture::{self, Drawn, Material, View};
use crate::steps::step_settings;
use crate::worn::{self, Surroundings};
use anyhow::{Context, Result, bail};
use glam::Vec3;
use image::RgbImage;
use indicatif::{ProgressBar, ProgressStyle};
use regions::Regions;
use rows::{FrameRow, WalkMetrics};
use saved::{GarmentState, Saved};
use stage::Stage;
use std::fmt::Write;
use std::hash::{DefaultHasher, Hasher};
use std::path::Path;
use std::time::Instant;
use toile::Outfit;
use toile::files::{MovingFaces, write_atomically, write_pc2, write_usda};
use toile::gpu::{Kernel, Timer, readback};
use toile::model::{Model, Status, StepSettings};
use toile::scene::{Garment, Mesh, MovingMesh, Settings};
use toile_reference::ExactDistance;

/// Maps are drawn so often at least [1/s]; in between, surfaces go straight on by the velocity map.
const MAP_RATE: f64 = 60.0;
/// Time that a garment has to hang quietly at the start of the walk [s].
const WAITING_SECONDS: f64 = 0.5;
/// Frames in the strip.
const STRIP_COUNT: u32 = 6;
/// Height of the pictures [px].
const PICTURE_HEIGHT: u32 = 480;
/// What ctrl-c leaves of a walk that has begun.
const KEPT: &str = "interrupted: every frame so far is kept, go on with --resume";

/// What walks.
pub struct Walk {
    /// The body and its motion.
    pub body: MovingMesh,
    /// The way from the pose in which it is dressed to the start of the walk; `None` when it is dressed there.
    pub dressing: Option<MovingMesh>,
    /// The garments, inner ones first.
    pub garments: Vec<Garment>,
    /// How they are simulated, at the frame rate of the walk.
    pub settings: Settings,
    /// Number of frames after the first.
    pub frame_count: u32,
    /// Whether the maps of a round are drawn once and kept.
    pub precompute_maps: bool,
    /// Whether to go on where an interrupted walk ended.
    pub resume: bool,
}

impl Walk {
    /// All that decides the result, as text: a walk goes on only with the same.
    fn identity(&self, gpu: &Gpu) -> String {
        let mut digest = Digest(DefaultHasher::new());
        write!(digest, "{:?}", (&self.body, &self.dressing, &self.garments)).expect("a digest takes every text");
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
}

/// A text as one number.
struct Digest(DefaultHasher);

impl std::fmt::Write for Digest {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}

/// A garment that is dressed and goes along.
struct Walker {
    name: String,
    model: Model,
    settings: StepSettings,
    triangles: Vec<[u32; 3]>,
}

/// Dresses and walks, and writes pictures, motion and metrics.
pub fn walk(walk: &Walk, running: &Running) -> Result<()> {
    output::check(&running.out)?;
    if running.place.backend == Backend::Reference {
        bail!("--backend reference: a walk needs a device; toile dress runs without one");
    }
    let computer = Computer::Gpu(adapter::open(&running.place)?);
    let Computer::Gpu(gpu) = &computer else { unreachable!("it was just opened") };
    let saved = Saved::open(&running.out, walk.identity(gpu), walk.resume)?;
    let walkers = walk.garments.iter().map(|garment| walker(garment, &walk.settings)).collect::<Result<Vec<_>>>()?;
    if saved.frame_count() == 0 {
        let mut states = dress(walk, &computer, running.quiet)?;
        if let Some(way) = &walk.dressing {
            states = go_to_start(walk, way, gpu, &walkers, &states)?;
        }
        saved.write(0, &states, None)?;
    }
    let collision_part = simulate(walk, gpu, &walkers, &saved, running)?;
    let rows = saved.rows(walk.frame_count)?;
    finish(walk, &walkers, &saved, running)?;
    let metrics = WalkMetrics::new(&gpu.name, &walk.settings, &walkers, collision_part, rows);
    let text = serde_json::to_string_pretty(&metrics)?;
    write_atomically(&running.out.join("metrics.json"), text.as_bytes())?;
    saved.remove()?;
    if running.json {
        print(&text)?;
    } else if !running.quiet {
        print(&metrics.line())?;
        print(&format!("wrote {}", running.out.display()))?;
    }
    Ok(())
}

fn walker(garment: &Garment, settings: &Settings) -> Result<Walker> {
    let (model, _) = Model::from_garment(garment, settings)?.sewn();
    let settings = step_settings(&garment.name, settings, &model)?;
    Ok(Walker { name: garment.name.clone(), triangles: model.triangles(), model, settings })
}

/// Dresses the garments one over the other in the first pose.
fn dress(walk: &Walk, computer: &Computer, quiet: bool) -> Result<Vec<GarmentState>> {
    let thickness = walk.settings.fabric.thickness as f32;
    let texel = walk.settings.texel as f32;
    let body = walk.dressing.as_ref().unwrap_or(&walk.body);
    let mut layers = vec![Layer { mesh: body.mesh.clone(), thickness }];
    let mut states = Vec::new();
    for garment in &walk.garments {
        let around = Surroundings { computer, layers: &layers, shapes: Vec::new(), texel, quiet };
        let worn = worn::dress(garment, &walk.settings, &around)?;
        states.push(GarmentState::at_rest(&worn.mesh.positions));
        layers.push(Layer { mesh: worn.mesh, thickness });
    }
    Ok(states)
}

/// The dressed garments go along while the body goes over to the start of its walk and waits there until they hang quietly. They ease
/// on the way: with friction, shoulders keep the stretch that sinking arms leave in them.
fn go_to_start(
    walk: &Walk,
    way: &MovingMesh,
    gpu: &Gpu,
    walkers: &[Walker],
    states: &[GarmentState],
) -> Result<Vec<GarmentState>> {
    let seconds = 1.0 / walk.settings.frame_rate;
    let maps_per_frame = maps_per_frame(walkers[0].settings.steps_per_frame, walk.settings.frame_rate);
    let garments: Vec<_> = walkers.iter().map(|walker| (&walker.model, walker.settings.easing())).collect();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let texel = walk.settings.texel as f32;
    let mut outfit = Outfit::new(&gpu.device, &mut encoder, way, &garments, texel, maps_per_frame)?;
    outfit.record_start(&gpu.device, &mut encoder, 0.0);
    gpu.queue.submit([encoder.finish()]);
    for ((cloth, walker), state) in outfit.garments().zip(walkers).zip(states) {
        state.upload(gpu, cloth, &walker.model)?;
    }
    let frame_count = ((way.duration() + WAITING_SECONDS) / seconds).ceil() as u32;
    for _ in 0..frame_count {
        interrupt::check()?;
        timed(gpu, |encoder| outfit.record(&gpu.device, encoder, seconds))?;
        for cloth in outfit.garments_mut() {
            status(cloth)?;
        }
    }
    outfit.garments().map(|cloth| GarmentState::download(gpu, cloth)).collect()
}

/// Walks, frame by frame, and says which part of a step goes to the bodies.
fn simulate(walk: &Walk, gpu: &Gpu, walkers: &[Walker], saved: &Saved, running: &Running) -> Result<f64> {
    let seconds = 1.0 / walk.settings.frame_rate;
    let maps_per_frame = maps_per_frame(walkers[0].settings.steps_per_frame, walk.settings.frame_rate);
    let done = saved.frame_count() - 1;
    let mut outfit = start(walk, gpu, walkers, saved, running, maps_per_frame)?;
    let regions = Regions::new(&walk.body);
    let stage = Stage::new(&walk.body, f64::from(walk.frame_count) * seconds);
    std::fs::create_dir_all(&running.out)?;
    let progress = progress(walk.frame_count, done, running.quiet);
    let mut last = vec![Status::default(); walkers.len()];
    for frame in done + 1..=walk.frame_count {
        interrupt::check().context(KEPT)?;
        let [before, time] = [frame - 1, frame].map(|frame| f64::from(frame) * seconds);
        let [maps_ms, simulated_ms] = advance(gpu, &mut outfit, before, seconds, maps_per_frame)?;
        let output = Instant::now();
        let body = walk.body.at(time);
        let (exact, mut inner) = (ExactDistance::new(&body), Vec::new());
        let mut row = FrameRow::new(frame, time, maps_ms, simulated_ms);
        let (mut states, mut cloths) = (Vec::new(), Vec::new());
        for ((cloth, walker), last) in outfit.garments_mut().zip(walkers).zip(&mut last) {
            let status = status(cloth)?;
            row.add_polish(last, &status);
            *last = status;
            let state = GarmentState::download(gpu, cloth)?;
            let (thickness, texel) = (walk.settings.fabric.thickness, walk.settings.texel as f32);
            row.add(&walker.model, &state, &status, &exact, &inner, &body, &regions, thickness, texel);
            let normals = readback::read_vec4s(&gpu.device, &gpu.queue, &cloth.frame().normals)?;
            let normals = normals.into_iter().map(|normal| normal.truncate()).collect();
            let mesh = Mesh { positions: state.positions(), normals, triangles: walker.triangles.clone() };
            states.push(state);
            if states.len() < walkers.len() {
                inner.push(ExactDistance::new(&mesh));
            }
            cloths.push(mesh);
        }
        let views = draw(&body, &cloths, walk.settings.fabric.thickness, stage.at(time))?;
        picture::save_png(&picture_path(&running.out, frame), &picture::strip(&views))?;
        row.output_ms = 1e3 * output.elapsed().as_secs_f64();
        saved.write(frame, &states, Some(&row))?;
        progress.inc(1);
    }
    progress.finish();
    collision_part(gpu, &mut outfit)
}

/// The outfit as it was at the end of the last frame that is kept.
fn start(
    walk: &Walk,
    gpu: &Gpu,
    walkers: &[Walker],
    saved: &Saved,
    running: &Running,
    maps_per_frame: u32,
) -> Result<Outfit> {
    let seconds = 1.0 / walk.settings.frame_rate;
    let garments: Vec<_> = walkers.iter().map(|walker| (&walker.model, walker.settings.clone())).collect();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let texel = walk.settings.texel as f32;
    let mut outfit = Outfit::new(&gpu.device, &mut encoder, &walk.body, &garments, texel, maps_per_frame)?;
    if walk.precompute_maps {
        let interval = seconds / f64::from(maps_per_frame);
        if Outfit::can_keep_maps(&walk.body, interval).is_none() {
            bail!(
                "--precompute-maps needs a clip that ends as it begins, after a whole number of maps; it has {:.3} s, and a map is \
                 drawn every {interval:.4} s: leave the option out, or change --clip or --fps",
                walk.body.duration()
            );
        }
        let bytes = outfit.keep_maps(&gpu.device, &mut encoder, &walk.body, interval);
        if !running.quiet && !running.json {
            print(&format!("the maps of a round take {:.0} MiB", bytes as f64 / f64::from(1 << 20)))?;
        }
    }
    let done = saved.frame_count() - 1;
    outfit.record_start(&gpu.device, &mut encoder, f64::from(done) * seconds);
    gpu.queue.submit([encoder.finish()]);
    for ((cloth, walker), state) in outfit.garments().zip(walkers).zip(&saved.read(done)?) {
        state.upload(gpu, cloth, &walker.model)?;
    }
    Ok(outfit)
}

/// Goes on by a frame of `seconds` from a time [s]; how long poses and maps took, and the steps [ms].
fn advance(gpu: &Gpu, outfit: &mut Outfit, time: f64, seconds: f64, maps_per_frame: u32) -> Result<[f64; 2]> {
    let start = Instant::now();
    let interval = seconds / f64::from(maps_per_frame);
    let mut maps_ms = 0.0;
    for index in 1..=maps_per_frame {
        let next = time + interval * f64::from(index);
        maps_ms += timed(gpu, |encoder| outfit.record_pose(&gpu.device, encoder, next))?;
        timed(gpu, |encoder| outfit.record_steps(&gpu.device, encoder, interval))?;
    }
    timed(gpu, |encoder| outfit.record_outputs(encoder))?;
    Ok([maps_ms, 1e3 * start.elapsed().as_secs_f64() - maps_ms])
}

/// Which part of one more step of every garment goes to the bodies [1]: each pass is timed alone.
fn collision_part(gpu: &Gpu, outfit: &mut Outfit) -> Result<f64> {
    let timer = Timer::new(&gpu.device, &gpu.queue)?;
    let [mut whole, mut collision] = [0.0; 2];
    for cloth in outfit.garments_mut() {
        for (kernel, time) in cloth.time_step(&gpu.device, &gpu.queue, &timer)? {
            match kernel {
                Kernel::StateCopy => continue,
                Kernel::Reaction
                | Kernel::QuadMidpoints
                | Kernel::SampleMovingMaps
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

/// How often the maps are drawn in a frame: at least at the map rate, and so that the steps divide evenly.
fn maps_per_frame(steps: u32, frame_rate: f64) -> u32 {
    let wanted = ((MAP_RATE / frame_rate).ceil() as u32).clamp(1, steps);
    (wanted..=steps).find(|count| steps.is_multiple_of(*count)).unwrap_or(steps)
}

/// Submits what is recorded, waits, and says how long it took [ms].
fn timed(gpu: &Gpu, record: impl FnOnce(&mut wgpu::CommandEncoder)) -> Result<f64> {
    let start = Instant::now();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    record(&mut encoder);
    gpu.queue.submit([encoder.finish()]);
    gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
    Ok(1e3 * start.elapsed().as_secs_f64())
}

fn progress(frame_count: u32, done: u32, quiet: bool) -> ProgressBar {
    let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(u64::from(frame_count)) };
    let template = "walking: {bar:30} {pos} of {len} frames, {per_sec}, {eta} left";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    bar.set_position(u64::from(done));
    bar.reset_eta();
    bar
}

/// The two views of a frame.
fn draw(body: &Mesh, cloths: &[Mesh], thickness: f64, stage: [Vec3; 2]) -> Result<Vec<RgbImage>> {
    let mut drawn = vec![Drawn::body(body)];
    drawn.extend(cloths.iter().enumerate().map(|(i, mesh)| Drawn::cloth(mesh, i, thickness)));
    let views = [View::ThreeQuarter, View::Side].map(|view| picture::render_in(&drawn, stage, view, PICTURE_HEIGHT));
    Ok(views.into_iter().collect::<Result<Vec<_>, _>>()?)
}

fn picture_path(folder: &Path, frame: u32) -> std::path::PathBuf {
    folder.join(format!("frame_{frame:04}.png"))
}

/// Draws some frames side by side, the first view above the second.
fn draw_strip(walk: &Walk, walkers: &[Walker], saved: &Saved, folder: &Path) -> Result<()> {
    let seconds = 1.0 / walk.settings.frame_rate;
    let stage = Stage::new(&walk.body, f64::from(walk.frame_count) * seconds);
    let count = STRIP_COUNT.min(walk.frame_count);
    let mut views = [Vec::new(), Vec::new()];
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
        let drawn = draw(&walk.body.at(time), &cloths, walk.settings.fabric.thickness, stage.at(time))?;
        views.iter_mut().zip(drawn).for_each(|(row, view)| row.push(view));
    }
    Ok(picture::save_png(&folder.join("walk.png"), &picture::stack(&views.map(|row| picture::strip(&row))))?)
}

/// Writes the motion and the moving picture from what was saved of each frame.
fn finish(walk: &Walk, walkers: &[Walker], saved: &Saved, running: &Running) -> Result<()> {
    let count = walk.frame_count as usize + 1;
    let rate = walk.settings.frame_rate;
    let faces: Vec<MovingFaces<'_>> = walkers
        .iter()
        .enumerate()
        .map(|(i, walker)| MovingFaces {
            name: &walker.name,
            triangles: &walker.triangles,
            colour: Material::cloth(i).linear_outside(),
        })
        .collect();
    let points = |mesh: usize, frame: usize| -> Result<Vec<Vec3>> {
        interrupt::check().context(KEPT)?;
        saved.positions(frame as u32, mesh)
    };
    write_usda(&running.out.join("walk.usda"), &faces, count, rate, points)?;
    for (index, walker) in walkers.iter().enumerate() {
        let path = running.out.join(format!("{index}_{}.pc2", walker.name));
        write_pc2(&path, walker.model.positions.len(), count, |frame| points(index, frame))?;
    }
    draw_strip(walk, walkers, saved, &running.out)?;
    let frames = (1..=walk.frame_count).map(|frame| picture_path(&running.out, frame));
    picture::save_gif(&running.out.join("walk.gif"), frames, rate)?;
    Ok(())
}
