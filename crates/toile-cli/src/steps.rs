//! The steps of a cloth, bounded as the library bounds them.

use toile::Error;
use toile::model::{Model, StepSettings};
use toile::scene::Settings;

/// The numbers of a step of a cloth; an error when a frame would have more of them than a run could end with.
pub fn step_settings(name: &str, settings: &Settings, model: &Model) -> Result<StepSettings, Error> {
    let step = StepSettings::new(settings, model);
    let (steps, most) = (step.steps_per_frame, StepSettings::STEPS_PER_FRAME_MAX);
    if steps > most {
        return Err(Error::Steps { cloth: name.to_owned(), steps, most });
    }
    Ok(step)
}
