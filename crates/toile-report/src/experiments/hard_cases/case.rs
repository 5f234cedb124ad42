//! What a hard case is, and what a run of one came to.

use toile::Colliders;
use toile::model::{Model, StepSettings};
use toile_lab::{Lab, LabError, Run};

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

/// What a run of some frames came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Course {
    /// Whether every particle stayed finite and below 1 km/s.
    pub(super) finite: bool,
    /// Largest speed at the end of any frame [m/s].
    pub(super) speed_max: f32,
    /// Largest elongation at the end of any frame, and at the end [1].
    pub(super) elongation_max: f32,
    pub(super) elongation_end: f32,
}

impl Course {
    pub(super) fn words(&self) -> String {
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
pub(super) fn course(
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
