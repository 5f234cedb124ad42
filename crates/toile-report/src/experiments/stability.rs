//! Stability atlas: the largest stable step.

use crate::Experiment;
use crate::page::{Axis, Block, Cell, Plot, Section, Series, SeriesStyle, Table};
use std::f64::consts::PI;
use toile::model::{Arrays, Model, StepSettings};
use toile::scene::{Rule, Shape, VelocityModification};
use toile_lab::scenes::hanging_sheet;
use toile_lab::{Lab, LabError, with};
use toile_reference::{Colliders, Reference};

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment { name: "stability", title: "Stability atlas", minutes: [0.1, 0.7], run };

/// Smallest and largest step that is tried, in units of sqrt(m/K).
const REACH: [f64; 2] = [0.1, 12.8];

/// Speed that no part of a sheet of 1 m reaches that only swings [m/s].
const SPEED_MAX: f32 = 30.0;

/// One corner of the atlas: a sheet of 1 m × 1 m that swings on two corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Particles on a side.
    pub n: u32,
    /// Rule of the velocity modification.
    pub rule: Rule,
    /// Stiffness of the structural springs [N/m]; shear springs have half of it, bend springs a tenth.
    pub stiffness: f64,
    /// Viscous damping rate [1/s].
    pub damping: f64,
    /// Whether a sphere is in the way of the swing.
    pub contact: bool,
    /// Every other particle has so many times the mass of the rest [1].
    pub mass_ratio: f64,
    /// Simulated time that the sheet must survive [s].
    pub seconds: f64,
}

/// The largest stable step of a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StableStep {
    /// Largest step found stable [s]; 0 when even the smallest that is tried is not, infinite when the largest is.
    pub dt: f64,
    /// sqrt(m/K) with the mass of an inner particle and the highest stiffness of a link [s].
    pub unit: f64,
    /// 2/ω with Gershgorin's bound ω² ≤ 2·Σk·w on the links [s].
    pub bound: f64,
}

impl StableStep {
    /// D eq. 4: 0.4·π·sqrt(m/K) [s].
    pub fn papers(&self) -> f64 {
        0.4 * PI * self.unit
    }
}

/// Bisects for the largest step at which the sheet neither gets faster than 30 m/s nor loses a particle, to 5 %.
pub fn stable_step(corner: &Corner) -> StableStep {
    let (sheet, mut settings) = hanging_sheet(corner.n);
    let fabric = &mut settings.fabric;
    fabric.structural_stiffness = corner.stiffness;
    fabric.shear_stiffness = 0.5 * corner.stiffness;
    fabric.bend_stiffness = 0.1 * corner.stiffness;
    fabric.damping = corner.damping;
    settings.velocity_modification = VelocityModification::new(corner.rule);
    let heavy = |model: &mut Arrays| {
        for i in (0..model.masses.len()).step_by(2) {
            model.masses[i] *= corner.mass_ratio as f32;
            model.inverse_masses[i] /= corner.mass_ratio as f32;
        }
        model.weigh_coarse_particles();
    };
    let model = Model::from_sheet(&sheet, &settings).changed(heavy).expect("particles of other masses");
    let links = || model.links.values.iter().map(|link| f64::from(link.stiffness));
    // The lightest of the inner particles.
    let mass = settings.fabric.areal_density / f64::from(corner.n - 1).powi(2);
    let squared_rate = (0..model.positions.len())
        .map(|i| {
            let stiffness: f64 = model.links.row(i).iter().map(|link| f64::from(link.stiffness)).sum();
            2.0 * stiffness * f64::from(model.inverse_masses[i])
        })
        .fold(0.0, f64::max);
    let unit = (mass / links().fold(0.0, f64::max)).sqrt();
    let step = StepSettings::new(&settings, &model);
    let survives = |dt: f64| survives(&model, &with(step.clone(), |step| step.dt = dt as f32), corner);
    let [mut low, mut high] = REACH.map(|reach| reach * unit);
    let dt = if !survives(low) {
        0.0
    } else if survives(high) {
        f64::INFINITY
    } else {
        while high / low > 1.05 {
            let middle = (low * high).sqrt();
            if survives(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    StableStep { dt, unit, bound: 2.0 / squared_rate.sqrt() }
}

fn survives(model: &Model, step: &StepSettings, corner: &Corner) -> bool {
    // In the way of the lower edge.
    let sphere = Shape::sphere(glam::DVec3::new(0.5, -0.5, 0.3), 0.15);
    let colliders = Colliders::new(None, if corner.contact { vec![sphere] } else { Vec::new() });
    let mut reference = Reference::new(model, step, colliders);
    let steps = (corner.seconds / f64::from(step.dt)).ceil() as u32;
    for index in 0..steps {
        reference.step();
        // Looked at from time to time: a run that diverged does not come back.
        if index % 8 == 7 || index + 1 == steps {
            let status = reference.status();
            if status.non_finite_count > 0 || status.speed_max > SPEED_MAX {
                return false;
            }
        }
    }
    true
}

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let base = Corner {
        n: lab.pick(16, 24),
        rule: Rule::None,
        stiffness: 20.0,
        damping: 0.1,
        contact: false,
        mass_ratio: 1.0,
        seconds: lab.pick(1.0, 2.0),
    };
    let stiffnesses = lab.pick(vec![2.0, 20.0, 200.0], vec![2.0, 6.0, 20.0, 60.0, 200.0, 600.0]);
    let mut corners: Vec<(String, &str, Corner)> = Vec::new();
    for (name, rule) in Rule::ALL {
        for &stiffness in &stiffnesses {
            corners.push((format!("K = {stiffness} N/m"), name, Corner { rule, stiffness, ..base }));
        }
        corners.push(("damping 10/s".to_owned(), name, Corner { rule, damping: 10.0, ..base }));
        corners.push(("on a sphere".to_owned(), name, Corner { rule, contact: true, ..base }));
        for mass_ratio in lab.pick(vec![100.0], vec![10.0, 100.0, 1000.0]) {
            corners.push((format!("mass ratio {mass_ratio}"), name, Corner { rule, mass_ratio, ..base }));
        }
    }
    let caption = format!(
        "A sheet of 1 m × 1 m, {0} × {0} particles, 0.2 kg/m², swings on two corners for {1} s; K of the structural springs, K/2 of the shear and K/10 of the bend \
         springs. Unless said otherwise K = 20 N/m, damping 0.1/s, no body, even masses. A step is stable when no particle gets faster than {2} m/s; bisected to 5 % between {3} and {4} \
         sqrt(m/K). Under the predictive rules links are softened to what 1/960 s carries; K in sqrt(m/K) is the link's. Reference on the CPU.",
        base.n, base.seconds, SPEED_MAX, REACH[0], REACH[1]
    );
    let columns = &[
        ["rule", ""],
        ["varied", ""],
        ["largest stable step", "ms"],
        ["in sqrt(m/K)", "1"],
        ["D eq. 4", "ms"],
        ["our bound", "ms"],
        ["stable by bound", "1"],
        ["eq. 4 is safe", ""],
        ["our bound is safe", ""],
    ];
    let mut table = Table::new(caption.clone(), columns);
    let mut curves: Vec<Vec<[f64; 2]>> = vec![Vec::new(); Rule::ALL.len()];
    let mut bound = Vec::new();
    let [mut papers_fail, mut ours_fail] = [0, 0];
    let count = corners.len();
    for (index, (varied, name, corner)) in corners.into_iter().enumerate() {
        lab.say(index as f64 / count as f64, &format!("stable step: {name}, {varied}"))?;
        let found = stable_step(&corner);
        let dt = match found.dt {
            0.0 => Cell::text("none"),
            dt if dt.is_infinite() => Cell::text("all"),
            dt => Cell::number(1e3 * dt),
        };
        let ratio = |unit: f64| if found.dt.is_finite() { Cell::number(found.dt / unit) } else { Cell::Missing };
        let safe = |step: f64| if found.dt >= 0.95 * step { "yes" } else { "no" };
        papers_fail += usize::from(safe(found.papers()) == "no");
        ours_fail += usize::from(safe(found.bound) == "no");
        table.push(vec![
            Cell::text(name),
            Cell::text(varied),
            dt,
            ratio(found.unit),
            Cell::number(1e3 * found.papers()),
            Cell::number(1e3 * found.bound),
            ratio(found.bound),
            Cell::text(safe(found.papers())),
            Cell::text(safe(found.bound)),
        ]);
        if (corner.damping, corner.contact, corner.mass_ratio) == (base.damping, false, 1.0) {
            let rule = Rule::ALL.iter().position(|(rule, _)| *rule == name).expect("it is one of them");
            curves[rule].push([corner.stiffness, found.dt.min(REACH[1] * found.unit) / found.unit]);
            if corner.rule == Rule::None {
                bound.push([corner.stiffness, found.bound / found.unit]);
            }
        }
    }
    let ends = [stiffnesses[0], stiffnesses[stiffnesses.len() - 1]];
    let mut series = vec![
        Series::new("D eq. 4", SeriesStyle::Line, ends.map(|x| [x, 0.4 * PI])),
        Series::new("our bound", SeriesStyle::Line, bound),
    ];
    let measured = Rule::ALL.iter().zip(curves);
    series.extend(measured.map(|((name, _), points)| Series::new(*name, SeriesStyle::LineAndMarks, points)));
    let plot = Plot {
        caption: format!(
            "Who explodes where: above its curve a rule is unstable; a rule without a mark has no stable step. {caption}"
        ),
        x: Axis::log("stiffness K", "N/m"),
        y: Axis::log("largest stable step by sqrt(m/K)", "1"),
        series,
    };
    let lead = format!(
        "The largest step that each rule survives, beside eq. 4 of D and our bound. Eq. 4 is not safe in {papers_fail} of {count} corners, our bound in {ours_fail}: a \
         rule that is unstable by itself has no safe step."
    );
    let mut section = EXPERIMENT.section(lead);
    section.blocks = vec![Block::Plot(plot), Block::Table(table)];
    Ok(section)
}
