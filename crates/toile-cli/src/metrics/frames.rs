//! How far a cloth is stretched, frame by frame.

use crate::worn::Worn;
use serde::Serialize;
use toile::model::Status;

/// What the device found at the end of one frame.
#[derive(Debug, Serialize)]
pub struct StrainRow {
    /// Number of the frame, from 1.
    frame: u32,
    /// Time at its end since the run, or draping, began [s].
    time_s: f64,
    /// Largest elongation of a structural or shear spring [1].
    elongation_max: f64,
    /// The two particles of the spring that has it; null when none is longer than at rest.
    longest_spring: Option<[u32; 2]>,
    /// Number of springs whose elongation is above the threshold along them.
    over_long_count: u32,
    /// Further sweeps of the polish in the steps of the frame.
    further_sweeps: u32,
    /// Steps of the frame that ended above its target.
    missed_steps: u32,
}

impl StrainRow {
    /// A row for every frame that the log of a cloth has.
    pub fn all(worn: &Worn) -> Vec<Self> {
        let before = [Status::default()];
        let frames = before.iter().chain(&worn.log.statuses).zip(&worn.log.statuses);
        let seconds = f64::from(worn.settings.steps_per_frame) * f64::from(worn.settings.dt);
        let row = |(frame, (before, after)): (u32, (&Status, &Status))| Self {
            frame,
            time_s: f64::from(frame) * seconds,
            elongation_max: f64::from(after.elongation_max),
            longest_spring: after.longest_limit.map(|longest| worn.model.limits[longest as usize].ends),
            over_long_count: after.over_long_count,
            further_sweeps: after.further_sweeps - before.further_sweeps,
            missed_steps: after.missed_steps - before.missed_steps,
        };
        (1..).zip(frames).map(row).collect()
    }
}
