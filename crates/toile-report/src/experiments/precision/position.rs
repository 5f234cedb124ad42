//! Position error against the converged f64 answer on the CPU, on scenes that are not chaotic.

use crate::page::{Axis, Block, Cell, Plot, Series, SeriesStyle, Table};
use glam::DVec3;
use toile::model::{Model, StepSettings};
use toile::scene::{Pin, Rule, Settings, Threshold, VelocityModification};
use toile_lab::Distance;
use toile_lab::Network;
use toile_lab::scenes::{fabric, square};
use toile_lab::{Lab, LabError, Run};

/// Particles on a side.
const N: u32 = 9;
/// Step of the f64 answer where no limit acts [s]; at half of it the answer differs by less than the f32 of the device can tell.
const EXACT_STEP: f64 = 2.5e-4;
/// Stiffness of a limit in the f64 answer [N/m]: the whole sheet, 1.96 N, stretches it by 20 µm.
const LIMIT_STIFFNESS: f64 = 1e5;
/// How long the swing and the fall are followed [s].
const SECONDS: f64 = 0.5;

/// A scene with one answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scene {
    /// A sheet of 0.25 m × 0.25 m hangs by its whole upper edge and swings from 10° off. No spring comes near its limit.
    Swing,
    /// The same sheet falls freely.
    Fall,
}

impl Scene {
    fn model(self, rule: Rule) -> (Model, Settings) {
        let mut settings = Settings::new(fabric());
        settings.velocity_modification = VelocityModification::new(rule);
        let angle = 10_f64.to_radians();
        let down = DVec3::new(0.0, -angle.cos(), angle.sin());
        let pins = match self {
            Scene::Swing => (0..N).map(|column| Pin { column, row: 0 }).collect(),
            Scene::Fall => Vec::new(),
        };
        (Model::from_sheet(&square(N, 0.25, DVec3::ZERO, down, pins), &settings), settings)
    }

    /// Where the sheet is after half a second, converged in f64 [m].
    pub fn exact(self) -> Vec<DVec3> {
        let (model, settings) = self.model(Rule::None);
        let mut network = Network::new(&model, &StepSettings::new(&settings, &model));
        network.advance(SECONDS, EXACT_STEP);
        network.positions
    }

    /// How far the device is from the exact answer [m] under a rule, with so many steps in 1/60 s.
    pub fn error(self, lab: &Lab, rule: Rule, steps_per_frame: u32, exact: &[DVec3]) -> Result<Distance, LabError> {
        let (model, settings) = self.model(rule);
        let mut step = StepSettings::new(&settings, &model);
        step.steps_per_frame = steps_per_frame;
        step.dt = (1.0 / (settings.frame_rate * f64::from(steps_per_frame))) as f32;
        let mut run = Run::new(lab, model, step, Default::default())?;
        let end = run.steps(lab, (SECONDS * settings.frame_rate).round() as u32 * steps_per_frame)?;
        Ok(if end.is_some() { Distance::between(&run.positions(lab)?, exact) } else { Distance::INFINITE })
    }
}

/// How far a sheet of 1 m × 1 m of soft springs that comes to rest on its held upper edge, most of its springs at their limit, is from where
/// it would be if every limit held exactly [m].
pub fn rest_error(lab: &Lab, rule: Rule, sweeps: u32) -> Result<Distance, LabError> {
    let mut settings = Settings::new(fabric());
    settings.velocity_modification = VelocityModification::new(rule);
    settings.velocity_modification.sweeps = Some(sweeps);
    settings.fabric.structural_stiffness = 2.0;
    settings.fabric.shear_stiffness = 1.0;
    settings.fabric.bend_stiffness = 0.2;
    settings.fabric.threshold = Threshold::even(0.01);
    settings.fabric.damping = 20.0;
    let pins = (0..N).map(|column| Pin { column, row: 0 }).collect();
    let model = Model::from_sheet(&square(N, 1.0, DVec3::ZERO, DVec3::NEG_Y, pins), &settings);
    let step = StepSettings::new(&settings, &model);
    let mut exact = Network::new(&model, &step).with_limits(&model, LIMIT_STIFFNESS);
    exact.advance(1.0, 0.8 * exact.stable_step());
    let mut run = Run::new(lab, model, step, Default::default())?;
    for _ in 0..60 {
        if run.frame(lab)?.is_none() {
            return Ok(Distance::INFINITE);
        }
    }
    Ok(Distance::between(&run.positions(lab)?, &exact.positions))
}

pub(super) fn blocks(lab: &mut Lab, progress: [f64; 2]) -> Result<Vec<Block>, LabError> {
    let [start, end] = progress;
    let middle = start + 0.6 * (end - start);
    let mut blocks = moving(lab, [start, middle])?;
    blocks.extend(resting(lab, [middle, end])?);
    Ok(blocks)
}

fn moving(lab: &mut Lab, progress: [f64; 2]) -> Result<Vec<Block>, LabError> {
    let steps: &[u32] = lab.pick(&[16, 32, 64], &[16, 32, 64, 128, 256]);
    let rules: Vec<(&str, Rule)> = match lab.pick(true, false) {
        true => Rule::ALL.into_iter().filter(|(name, _)| ["none", "average", "predictive"].contains(name)).collect(),
        false => Rule::ALL.to_vec(),
    };
    let caption = format!(
        "Position error after {SECONDS} s against the springs alone in f64 with a Runge-Kutta step of {} ms: a sheet of 0.25 m × 0.25 m, \
         {N} × {N} particles, 0.2 kg/m², springs of 20, 10 and 2 N/m, damping 0.1 /s; swing: held by its upper edge, from 10° off; fall: \
         free. No spring reaches its limit, so every rule should leave the motion alone; the sweeps are those of each rule. {}",
        1e3 * EXACT_STEP,
        lab.place()
    );
    let columns =
        [["scene", ""], ["rule", ""], ["step", "ms"], ["error, mean", "mm"], ["error, farthest", "mm"], ["order", "1"]];
    let figures = format!("The figures of the plot above: position error by scene, rule and step. {}", lab.place());
    let mut table = Table::new(figures, &columns);
    let mut series = Vec::new();
    let scenes = [("swing", Scene::Swing), ("fall", Scene::Fall)];
    let count = scenes.len() * rules.len();
    for (number, (scene_name, scene)) in scenes.into_iter().enumerate() {
        let exact = scene.exact();
        for (index, (name, rule)) in rules.iter().enumerate() {
            let share = (number * rules.len() + index) as f64 / count as f64;
            lab.say(progress[0] + (progress[1] - progress[0]) * share, &format!("{scene_name}, {name}"))?;
            let mut points: Vec<[f64; 2]> = Vec::new();
            for steps in steps {
                let error = scene.error(lab, *rule, *steps, &exact)?;
                let dt = 1e3 / (60.0 * f64::from(*steps));
                let order = points.last().map(|[_, last]| (last / (1e3 * error.rms)).log2());
                points.push([dt, 1e3 * error.rms]);
                table.push(vec![
                    Cell::text(scene_name),
                    Cell::text(*name),
                    Cell::number(dt),
                    Cell::number(1e3 * error.rms),
                    Cell::number(1e3 * error.max),
                    Cell::number_or_missing(order),
                ]);
            }
            series.push(Series::new(format!("{scene_name}, {name}"), SeriesStyle::LineAndMarks, points));
        }
    }
    let first = series[0].points.first().copied().unwrap_or([1.0, 1.0]);
    let last = series[0].points.last().map_or(1.0, |point| point[0]);
    let theory = [first, [last, first[1] * last / first[0]]];
    series.push(Series::new("order 1: symplectic Euler", SeriesStyle::Line, theory));
    let plot = Plot { caption, x: Axis::log("step", "ms"), y: Axis::log("position error, mean", "mm"), series };
    Ok(vec![Block::Plot(plot), Block::Table(table)])
}

fn resting(lab: &mut Lab, progress: [f64; 2]) -> Result<Vec<Block>, LabError> {
    let rows: &[(&str, Rule, u32)] = lab.pick(
        &[
            ("predictive", Rule::Predictive, 1),
            ("predictive", Rule::Predictive, 8),
            ("hierarchical", Rule::Hierarchical, 1),
            ("hierarchical", Rule::Hierarchical, 4),
        ],
        &[
            ("predictive", Rule::Predictive, 1),
            ("predictive", Rule::Predictive, 4),
            ("predictive", Rule::Predictive, 16),
            ("hierarchical", Rule::Hierarchical, 1),
            ("hierarchical", Rule::Hierarchical, 2),
            ("hierarchical", Rule::Hierarchical, 4),
            ("hierarchical", Rule::Hierarchical, 8),
        ],
    );
    let caption = format!(
        "Position error of a rest shape whose limits act: a sheet of 1 m × 1 m, {N} × {N} particles, 0.2 kg/m², springs of 2, 1 and 0.2 N/m, \
         threshold 1 %, held by its whole upper edge and brought to rest in 1 s with damping 20 /s at 960 steps per second; against the \
         same springs in f64 whose limits resist with {LIMIT_STIFFNESS:.0e} N/m. {}",
        lab.place()
    );
    let mut table =
        Table::new(&caption, &[["rule", ""], ["sweeps", ""], ["error, mean", "mm"], ["error, farthest", "mm"]]);
    for (index, (name, rule, sweeps)) in rows.iter().enumerate() {
        let share = index as f64 / rows.len() as f64;
        lab.say(
            progress[0] + (progress[1] - progress[0]) * share,
            &format!("rest under limits, {name}, {sweeps} sweeps"),
        )?;
        let error = rest_error(lab, *rule, *sweeps)?;
        table.push(vec![
            Cell::text(*name),
            Cell::Count(u64::from(*sweeps)),
            Cell::number(1e3 * error.rms),
            Cell::number(1e3 * error.max),
        ]);
    }
    Ok(vec![Block::Table(table)])
}
