//! Hard cases, each with what must hold and what happened.

mod bodies;
mod broken;
mod cloth;
mod rest;

use crate::Experiment;
use crate::page::{Block, Cell, Section, Table};
use toile::Colliders;
use toile::model::{Model, StepSettings};
use toile_lab::{Lab, LabError, Run};

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment { name: "hard_cases", title: "Hard cases", minutes: [0.3, 1.5], run };

/// A case: its name, what must hold, and what does it.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name, with what is asked of the cloth.
    pub name: &'static str,
    /// What must hold.
    pub must: &'static str,
    /// Does it.
    pub run: fn(&Lab) -> Result<Outcome, LabError>,
}

/// What happened in a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// In words and numbers.
    pub happened: String,
    /// Whether what must hold did.
    pub held: bool,
}

/// Every case, in the order of the table.
pub const CASES: &[Case] = &[
    cloth::STIFFNESS,
    cloth::MASSES,
    cloth::NEEDLE,
    cloth::CRUMPLED,
    cloth::COINCIDENT,
    cloth::WEIGHTLESS,
    cloth::HEAVY,
    cloth::NO_THRESHOLD,
    cloth::FAR_AWAY,
    bodies::INSIDE,
    bodies::TELEPORT,
    bodies::SPIN,
    bodies::BULLET,
    rest::HANGING,
    rest::LYING,
    broken::NAN,
    broken::INFINITY,
];

/// What a run of some frames came to.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Course {
    /// Whether every particle stayed finite and below 1 km/s.
    finite: bool,
    /// Largest speed at the end of any frame [m/s].
    speed_max: f32,
    /// Largest elongation at the end of any frame, and at the end [1].
    elongation_max: f32,
    elongation_end: f32,
}

impl Course {
    fn words(&self) -> String {
        let Self { finite, speed_max, elongation_max, elongation_end } = self;
        if *finite {
            format!(
                "at most {speed_max:.3} m/s; elongation at most {elongation_max:.3}, {elongation_end:.3} at the end"
            )
        } else {
            "it diverged and was reported as an error".to_owned()
        }
    }
}

/// Does some frames.
fn course(
    lab: &Lab,
    model: Model,
    step: StepSettings,
    colliders: Colliders,
    frames: u32,
) -> Result<(Run, Course), LabError> {
    let mut run = Run::new(lab, model, step, colliders)?;
    let mut course = Course { finite: true, speed_max: 0.0, elongation_max: 0.0, elongation_end: 0.0 };
    for _ in 0..frames {
        let Some(status) = run.frame(lab)? else {
            course.finite = false;
            break;
        };
        course.speed_max = course.speed_max.max(status.speed_max);
        course.elongation_max = course.elongation_max.max(status.elongation_max);
        course.elongation_end = status.elongation_max;
    }
    Ok((run, course))
}

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let caption = format!(
        "Hard cases under the default settings (hierarchical limits, three sweeps, 60 frames per second) unless the case says otherwise. The sheet is 1 m × 1 m of \
         0.2 kg/m², springs of 20, 10 and 2 N/m, threshold 5 %, 12 × 12 particles, on two held corners or free, for a quarter of a second, next to bodies for 0.4 s. {}",
        lab.place()
    );
    let mut table = Table::new(caption, &[["case", ""], ["must hold", ""], ["what happened", ""], ["held", ""]]);
    let mut failed = Vec::new();
    for (index, case) in CASES.iter().enumerate() {
        lab.say(index as f64 / CASES.len() as f64, case.name)?;
        let outcome = (case.run)(lab)?;
        if !outcome.held {
            failed.push(case.name);
        }
        let held = if outcome.held { "yes" } else { "no" };
        table.push([case.name, case.must, &outcome.happened, held].map(Cell::text).to_vec());
    }
    let lead = if failed.is_empty() {
        format!("All {} cases held. Nothing panicked, hung, or went silently non-finite.", CASES.len())
    } else {
        format!("{} of {} cases did not hold: {}.", failed.len(), CASES.len(), failed.join("; "))
    };
    let mut section = Section::new(&EXPERIMENT, lead);
    section.blocks = vec![Block::Table(table)];
    Ok(section)
}
