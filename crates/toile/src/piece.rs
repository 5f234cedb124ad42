//! The cloths of a scene, meshed.

use crate::{Cloth, Error};
use glam::Vec3;
use toile_model::{DressingStage, Merge, Model, StepSettings};
use toile_scene::{Scene, Settings};

/// A garment or a sheet, meshed, with the numbers of its steps.
#[derive(Debug)]
pub(crate) struct Piece {
    pub(crate) name: String,
    /// The garment before it is sewn; `None` for a sheet.
    pub(crate) open: Option<Open>,
    /// The sheet, or the sewn garment.
    pub(crate) model: Model,
    /// The numbers of a step of the run.
    pub(crate) step: StepSettings,
}

/// A garment before it is sewn.
#[derive(Debug)]
pub(crate) struct Open {
    pub(crate) model: Model,
    pub(crate) merge: Merge,
    /// The numbers of a step while it is sewn.
    pub(crate) sewing: StepSettings,
}

impl Piece {
    /// The cloths of a scene, in its order.
    ///
    /// # Errors
    /// [`Error::Model`] when a garment cannot be meshed, [`Error::Steps`] when a frame would take too many steps.
    pub(crate) fn all(scene: &Scene) -> Result<Vec<Self>, Error> {
        let settings = &scene.settings;
        let piece = |cloth: &toile_scene::Cloth| match cloth {
            toile_scene::Cloth::Sheet(sheet) => {
                let model = Model::from_sheet(sheet, settings);
                let step = step_settings(&sheet.name, settings, &model)?;
                Ok(Self { name: sheet.name.clone(), open: None, model, step })
            }
            toile_scene::Cloth::Garment(garment) => {
                let open = Model::from_garment(garment, settings)?;
                let sewing = step_settings(&garment.name, settings, &open)?.sewing();
                let (model, merge) = open.sewn();
                let step = step_settings(&garment.name, settings, &model)?;
                let open = Open { model: open, merge, sewing };
                Ok(Self { name: garment.name.clone(), open: Some(open), model, step })
            }
        };
        scene.cloths.iter().map(piece).collect()
    }

    /// The numbers of a step in a stage of the dressing.
    pub(crate) fn settings_of(&self, stage: DressingStage) -> StepSettings {
        match (stage, &self.open) {
            (DressingStage::Sewing, Some(open)) => open.sewing.clone(),
            (DressingStage::Easing, _) => self.step.easing(),
            _ => self.step.draping(),
        }
    }

    /// The model that a cloth of this piece has.
    pub(crate) fn model_of(&self, cloth: &Cloth) -> &Model {
        match &self.open {
            Some(open) if cloth.is_sewing() => &open.model,
            _ => &self.model,
        }
    }

    /// The box that a sheet can reach while it hangs on its pins or lies on something near: where it starts, and its longest side around.
    /// `None` without particles.
    pub(crate) fn reach(&self) -> Option<[Vec3; 2]> {
        let positions = || self.model.positions.iter().copied();
        let [low, high] = [positions().reduce(Vec3::min)?, positions().reduce(Vec3::max)?];
        let side = (high - low).max_element();
        Some([low - side, high + side])
    }
}

/// The numbers of a step of a cloth.
fn step_settings(name: &str, settings: &Settings, model: &Model) -> Result<StepSettings, Error> {
    let step = StepSettings::new(settings, model);
    let (steps, most) = (step.steps_per_frame, StepSettings::STEPS_PER_FRAME_MAX);
    if steps > most {
        return Err(Error::Steps { cloth: name.to_owned(), steps, most });
    }
    Ok(step)
}
