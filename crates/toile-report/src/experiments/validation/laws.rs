//! Free fall and momentum of a sheet that nothing holds.

use crate::page::{Axis, Block, Cell, Plot, Series, SeriesStyle, Table};
use glam::{DVec2, DVec3};
use toile::Colliders;
use toile::model::{Model, StepSettings};
use toile::scene::{Rule, Settings, Sheet, VelocityModification};
use toile_lab::scenes::fabric;
use toile_lab::{Lab, LabError, Random, Run};

/// Frames that the sheet falls.
const FALL_FRAMES: u32 = 15;

/// What free fall differs by, in parts of the way fallen [1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FallError {
    /// From the sum that symplectic Euler makes of gravity, g·dt²·n(n + 1)/2: the particle that is farthest from it.
    pub from_euler: f64,
    /// Of that particle from the parabola ½·g·t².
    pub from_parabola: f64,
}

/// What a free crumpled sheet gains by itself, in parts of what its particles have [1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MomentumError {
    /// Way of the centre of mass, by the mean way of the particles.
    pub linear: f64,
    /// Angular momentum about the centre of mass, by Σ m·|r|·|v|.
    pub angular: f64,
}

/// Drops a level sheet of 1 m × 1 m and 9 × 9 particles for a quarter of a second.
///
/// # Errors
/// [`LabError`] when the device is lost.
pub fn free_fall_error(lab: &Lab, rule: Rule, steps_per_frame: u32) -> Result<FallError, LabError> {
    let settings = settings(rule);
    let model = Model::from_sheet(&sheet(9), &settings);
    let step = with_steps(StepSettings::new(&settings, &model), &settings, steps_per_frame);
    let mut run = Run::new(lab, model, step, Colliders::default())?;
    for _ in 0..FALL_FRAMES {
        run.frame(lab)?;
    }
    let n = f64::from(FALL_FRAMES * steps_per_frame);
    let gravity = settings.gravity.length();
    let euler = gravity * f64::from(run.step.dt).powi(2) * n * (n + 1.0) / 2.0;
    let parabola = 0.5 * gravity * run.time().powi(2);
    let mut error = FallError { from_euler: 0.0, from_parabola: 0.0 };
    for (position, start) in run.positions(lab)?.iter().zip(&run.model.positions) {
        let way = *position - start.as_dvec3();
        let off = |fall: f64| (way + DVec3::Y * fall).length() / fall;
        if off(euler) >= error.from_euler {
            error = FallError { from_euler: off(euler), from_parabola: off(parabola) };
        }
    }
    Ok(error)
}

/// Crumples a sheet of 17 × 17 particles of uneven mass at random, weightless and undamped, and lets it go for four frames.
///
/// # Errors
/// [`LabError`] when the device is lost.
pub fn momentum_error(lab: &Lab, rule: Rule) -> Result<MomentumError, LabError> {
    let mut settings = settings(rule);
    settings.gravity = DVec3::ZERO;
    let random = &mut Random::new(lab.seed);
    let model = Model::from_sheet(&sheet(17), &settings).changed(|model| {
        for position in &mut model.positions {
            *position += random.vector(0.02);
        }
        // Different masses: a rule that averages them away is found out.
        for (mass, inverse) in model.masses.iter_mut().zip(&mut model.inverse_masses) {
            *mass *= random.between(1.0, 3.0);
            *inverse = 1.0 / *mass;
        }
        model.weigh_coarse_particles();
    })?;
    let step = StepSettings::new(&settings, &model);
    let mut run = Run::new(lab, model, step, Colliders::default())?;
    for _ in 0..4 {
        run.frame(lab)?;
    }
    let masses: Vec<f64> = run.model.masses.iter().map(|mass| f64::from(*mass)).collect();
    let total: f64 = masses.iter().sum();
    let [end, velocities] = [run.positions(lab)?, run.velocities(lab)?];
    let ways: Vec<DVec3> = end.iter().zip(&run.model.positions).map(|(p, start)| *p - start.as_dvec3()).collect();
    let mean = |vectors: &[DVec3]| vectors.iter().zip(&masses).map(|(v, m)| *v * *m).sum::<DVec3>() / total;
    let centre = mean(&end);
    let turning = |i: usize| (end[i] - centre).cross(velocities[i]) * masses[i];
    let scale = |i: usize| (end[i] - centre).length() * velocities[i].length() * masses[i];
    let particles = || 0..end.len();
    Ok(MomentumError {
        linear: mean(&ways).length() * end.len() as f64 / ways.iter().map(|way| way.length()).sum::<f64>(),
        angular: particles().map(turning).sum::<DVec3>().length() / particles().map(scale).sum::<f64>(),
    })
}

/// Table and plot.
pub(super) fn blocks(lab: &mut Lab) -> Result<Vec<Block>, LabError> {
    let caption = format!(
        "What holds without anything that holds the cloth. Free fall: a level sheet of 1 m × 1 m, 9 × 9 particles, falls for a quarter of \
         a second, 16 steps per frame; the worst particle against the closed form of symplectic Euler, g·dt²·n(n + 1)/2. Momentum: a sheet of 17 × 17 \
         particles of uneven mass, crumpled at random by up to 2 cm, without gravity and damping, is let go for four frames; \
         way of the centre of mass by the mean way of the particles, and angular momentum by Σ m·|r|·|v|. Fabric of the measurements: \
         0.2 kg/m², springs of 20, 10 and 2 N/m, threshold 5 %. f32 resolves 6e-8. {}",
        lab.place()
    );
    let columns =
        &[["rule", ""], ["free fall, error", "1"], ["momentum gained", "1"], ["angular momentum gained", "1"]];
    let mut table = Table::new(caption, columns);
    for (name, rule) in Rule::ALL {
        lab.say(0.0, &format!("laws: {name}"))?;
        let fall = free_fall_error(lab, rule, 16)?;
        let momentum = momentum_error(lab, rule)?;
        let numbers = [fall.from_euler, momentum.linear, momentum.angular];
        table.push([Cell::text(name)].into_iter().chain(numbers.map(Cell::number)).collect());
    }
    let caption = format!(
        "Free fall against the parabola ½·g·t², which no step of finite length reaches: symplectic Euler is of first order, so the error halves with the \
         step. The same sheet, no rule. {}",
        lab.place()
    );
    let mut measured = Vec::new();
    for steps in [8, 16, 32, 64, 128] {
        let error = free_fall_error(lab, Rule::None, steps)?.from_parabola;
        measured.push([1e3 / (60.0 * f64::from(steps)), error]);
    }
    let order = measured.iter().map(|[x, _]| [*x, measured[0][1] * x / measured[0][0]]);
    let series = vec![
        Series::new("first order", SeriesStyle::Line, order),
        Series::new("measured", SeriesStyle::LineAndMarks, measured.iter().copied()),
    ];
    let plot = Plot { caption, x: Axis::log("step", "ms"), y: Axis::log("error by the way fallen", "1"), series };
    Ok(vec![Block::Table(table), Block::Plot(plot)])
}

/// Settings of the sheets that the velocity modification is measured on.
pub(super) fn settings(rule: Rule) -> Settings {
    let mut settings = Settings::new(fabric());
    settings.fabric.damping = 0.0;
    settings.velocity_modification = VelocityModification::new(rule);
    settings
}

/// The numbers of a step with another number of steps per frame.
pub(super) fn with_steps(step: StepSettings, settings: &Settings, steps_per_frame: u32) -> StepSettings {
    let mut changed = step;
    changed.dt = (1.0 / (settings.frame_rate * f64::from(steps_per_frame))) as f32;
    changed.steps_per_frame = steps_per_frame;
    changed
}

fn sheet(columns: u32) -> Sheet {
    let mut sheet = Sheet::new("sheet", [columns, columns], DVec2::ONE);
    sheet.corner = DVec3::new(-0.5, 1.0, -0.5);
    sheet
}
