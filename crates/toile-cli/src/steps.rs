//! The steps of a cloth, bounded: a slip in a scene must not ask for years.

use anyhow::{Result, bail};
use toile::model::{Model, StepSettings};
use toile::scene::Settings;

/// Most steps of a frame. The default rule has 16 at 60 frames per second and 960 at one; a rule that leaves the tension to stiff springs has
/// hundreds on fine cloth.
const STEPS_PER_FRAME_MAX: u32 = 10_000;

/// The numbers of a step of a cloth; an error when a frame would have more of them than a run could end with.
pub fn step_settings(name: &str, settings: &Settings, model: &Model) -> Result<StepSettings> {
    let step = StepSettings::new(settings, model);
    if step.steps_per_frame > STEPS_PER_FRAME_MAX {
        bail!(
            "{name}: a frame would take {} steps, and at most {STEPS_PER_FRAME_MAX} are done: use softer springs, heavier or coarser cloth, a \
             larger safety factor, or the rule \"hierarchical\", which needs few",
            step.steps_per_frame
        );
    }
    Ok(step)
}
