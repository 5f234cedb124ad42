//! `toile rules`: one scene under every rule of the velocity modification, side by side.

use crate::adapter;
use crate::args::{Backend, Rules};
use crate::bodies::shapes;
use crate::engine::Computer;
use crate::fit;
use crate::interrupt::Interrupted;
use crate::look::State;
use crate::output;
use crate::picture::{self, Drawn, View};
use crate::progress::Progress;
use crate::stdout::print;
use anyhow::{Context, Result, bail};
use glam::{DVec3, Vec3};
use image::RgbImage;
use serde::Serialize;
use toile::files::{SceneFile, read_scene, write_atomically};
use toile::model::{Fit, FitOptions};
use toile::model::{Model, Status, StepSettings};
use toile::scene::{Cloth, Mesh, Rule};

/// Height of the pictures [px].
const PICTURE_HEIGHT: u32 = 480;

/// What became of a scene under one rule. The names are stable.
#[derive(Debug, Serialize)]
struct Row {
    rule: &'static str,
    steps_per_frame: u32,
    /// Frames before the state ran away; all of them when it did not.
    frames_sound: u32,
    diverged: bool,
    /// Largest threshold of the fabric [1].
    threshold: f64,
    /// Largest elongation at the end of any frame [1].
    elongation_max_over_run: f32,
    /// Largest elongation in the picture [1].
    elongation_max: f32,
    /// How far the centre of mass of the cloth is from the centre of the sphere [m], without y; null without a sphere.
    lag_m: Option<f64>,
    /// The mean of it at the end of all sound frames [m].
    lag_mean_m: Option<f64>,
    /// The largest of it at the end of any of them [m].
    lag_max_over_run_m: Option<f64>,
}

/// Runs the scene once per rule; writes `rules.png` and `rules.json`.
pub fn run(arguments: &Rules) -> Result<()> {
    let running = &arguments.running;
    let file = read_scene(&arguments.scene, &arguments.set)?;
    output::check(&running.out, "rules.json")?;
    if !running.quiet {
        fit::tell_of_files(&file.warnings);
    }
    let computer = match running.place.backend {
        Backend::Gpu => Computer::Gpu(adapter::open(&running.place)?),
        Backend::Reference => Computer::Reference,
    };
    let mut rows = Vec::new();
    let mut ends = Vec::new();
    for (name, rule) in Rule::ALL {
        let (row, mesh, ball) = try_rule(&file, name, rule, &computer, running.hides_progress())?;
        rows.push(row);
        ends.push((mesh, ball));
    }
    let pictures = draw(&file, &rows, &ends)?;
    let text = serde_json::to_string_pretty(&rows)?;
    output::write_whole(&running.out, |folder| {
        picture::save_png(&folder.join("rules.png"), &picture::strip(&pictures))?;
        Ok(write_atomically(&folder.join("rules.json"), text.as_bytes())?)
    })?;
    if running.json {
        print(&text)?;
    } else if !running.quiet {
        for row in &rows {
            print(&row.line())?;
        }
        print(&format!("wrote {}", running.out.display()))?;
    }
    Ok(())
}

/// A picture of each rule at its end, all at one scale, with its name and what became of it.
fn draw(file: &SceneFile, rows: &[Row], ends: &[(Mesh, Option<Mesh>)]) -> Result<Vec<RgbImage>> {
    // What ran away would make all others specks.
    let sound = || rows.iter().zip(ends).filter(|(row, _)| !row.diverged).map(|(_, end)| end);
    let shown: Vec<_> = if sound().next().is_some() { sound().collect() } else { ends.iter().collect() };
    let meshes = shown.into_iter().flat_map(|(cloth, ball)| std::iter::once(cloth).chain(ball));
    let bounds = meshes.filter_map(Mesh::bounds);
    let stage = bounds.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    let picture = |(row, (cloth, ball)): (&Row, &(Mesh, Option<Mesh>))| -> Result<RgbImage> {
        let thickness = file.scene.fabrics().next().map_or(0.0, |fabric| fabric.thickness);
        let mut drawn = vec![Drawn::cloth(cloth, 0, thickness)];
        drawn.extend(ball.as_ref().map(Drawn::body));
        let views = picture::render(&drawn, stage.or(Some(Default::default())), &[View::ThreeQuarter], PICTURE_HEIGHT)?;
        let Some(mut picture) = views.into_iter().next() else { unreachable!("one view was asked for") };
        let stretch = format!("{:.1} %", 1e2 * row.elongation_max_over_run);
        picture::caption(&mut picture, &[row.rule, &row.word(), &stretch]);
        Ok(picture)
    };
    rows.iter().zip(ends).map(picture).collect()
}

fn try_rule(
    file: &SceneFile,
    name: &'static str,
    rule: Rule,
    computer: &Computer,
    quiet: bool,
) -> Result<(Row, Mesh, Option<Mesh>)> {
    let scene = &file.scene;
    let ([Cloth::Sheet(sheet)], shapes) = (scene.cloths.as_slice(), shapes(scene)) else {
        bail!("scene {} is not one sheet: the rules are compared on a single sheet", scene.name);
    };
    if scene.settings.velocity_modification.polish.is_some() {
        bail!(
            "scene {} has a polish, and few rules have one: the rules are compared without, leave it out",
            scene.name
        );
    }
    if scene.bodies.len() != shapes.len() || shapes.len() > 1 {
        bail!(
            "scene {} has a mesh body or several shapes: the rules are compared on a sheet alone or with one shape",
            scene.name
        );
    }
    let mut scene = scene.clone();
    scene.settings.velocity_modification.rule = rule;
    scene.settings = scene.settings.of_fabric(sheet.fabric.as_ref());
    let model = Model::from_sheet(sheet, &scene.settings);
    let step = StepSettings::of_cloth(name, &scene.settings, &model)?;
    let mut engine = computer.start(&Fit::new(&scene, &FitOptions::default())?)?;
    let seconds = 1.0 / scene.settings.frame_rate;
    let mut state = State { positions: model.positions.clone(), ..State::default() };
    let mut last = Status::default();
    let mut row = Row {
        rule: name,
        steps_per_frame: step.steps_per_frame,
        frames_sound: 0,
        diverged: false,
        threshold: scene.settings.fabric.threshold.most(),
        elongation_max_over_run: 0.0,
        elongation_max: 0.0,
        lag_m: None,
        lag_mean_m: None,
        lag_max_over_run_m: None,
    };
    let lag = |positions: &[Vec3], status: &Status| {
        let time = status.step as f64 * f64::from(step.dt);
        shapes.first().map(|sphere| lag(positions, &model.masses, sphere.at(time).0))
    };
    let mut lags = Vec::new();
    let progress = Progress::new(name, quiet);
    while row.frames_sound < file.frames {
        let done = engine.frame(seconds).and_then(|_| only(engine.cloths()?).map(|look| look.status));
        match done {
            Ok(status) => {
                last = status;
                state = only(engine.states()?)?;
                row.frames_sound += 1;
                lags.extend(lag(&state.positions, &status));
                row.elongation_max_over_run = row.elongation_max_over_run.max(status.elongation_max);
                progress.say(format!("frame {} of {}", row.frames_sound, file.frames));
            }
            Err(error) if error.is::<Interrupted>() || !error.is::<toile::Error>() => return Err(error),
            Err(_) => {
                row.diverged = true;
                break;
            }
        }
    }
    progress.finish(format!("{} frames", row.frames_sound));
    row.elongation_max = last.elongation_max;
    row.lag_m = lags.last().copied();
    row.lag_mean_m = row.lag_m.map(|_| lags.iter().sum::<f64>() / lags.len() as f64);
    row.lag_max_over_run_m = lags.iter().copied().reduce(f64::max);
    let end = last.step as f64 * f64::from(step.dt);
    let ball = shapes.first().map(|sphere| sphere.mesh(end));
    Ok((row, Mesh { positions: state.positions, normals: state.normals, triangles: model.triangles() }, ball))
}

/// The one cloth that there is.
fn only<T>(cloths: Vec<T>) -> Result<T> {
    cloths.into_iter().next().context("a scene of one sheet has one cloth")
}

/// Distance of the centre of mass of the cloth from a point [m], without y.
fn lag(positions: &[Vec3], masses: &[f32], point: DVec3) -> f64 {
    let mass: f64 = masses.iter().map(|mass| f64::from(*mass)).sum();
    let moment: DVec3 = positions.iter().zip(masses).map(|(place, mass)| place.as_dvec3() * f64::from(*mass)).sum();
    (moment / mass - point).with_y(0.0).length()
}

impl Row {
    /// What became of the cloth: it holds its threshold where it is never stretched more than twice as far, as the guard of the default has it.
    fn word(&self) -> String {
        if self.diverged {
            return format!("ran away after {} frames", self.frames_sound);
        }
        let holds = f64::from(self.elongation_max_over_run) <= 2.0 * self.threshold;
        if holds { "holds".to_owned() } else { "stretches".to_owned() }
    }

    fn line(&self) -> String {
        let end = self.word();
        let lag = match (self.lag_mean_m, self.lag_max_over_run_m) {
            (Some(mean), Some(max)) => {
                format!(" · {:.1} mm behind the sphere (at most {:.1} mm)", 1e3 * mean, 1e3 * max)
            }
            _ => String::new(),
        };
        format!(
            "{:<12} {end} · {} steps per frame · elongation {:.1} %, over the run {:.1} % of {:.1} % allowed{lag}",
            self.rule,
            self.steps_per_frame,
            1e2 * self.elongation_max,
            1e2 * self.elongation_max_over_run,
            1e2 * self.threshold
        )
    }
}
