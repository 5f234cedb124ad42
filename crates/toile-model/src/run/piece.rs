//! The cloths of a scene, meshed.

use super::dressing::DressingStage;
use super::step::StepSettings;
use crate::{Merge, Model, ModelError};
use glam::Vec3;
use toile_scene::{Cloth, Scene};

/// A garment or a sheet, meshed, with the numbers of its steps.
#[derive(Debug)]
pub struct Piece {
    /// Name of the garment or sheet.
    pub name: String,
    /// The garment before it is sewn; `None` for a sheet.
    pub open: Option<Open>,
    /// The sheet, or the sewn garment.
    pub model: Model,
    /// The numbers of a step of the run.
    pub step: StepSettings,
}

/// A garment before it is sewn.
#[derive(Debug)]
pub struct Open {
    /// Its panels.
    pub model: Model,
    /// How its particles become those of the sewn one.
    pub merge: Merge,
    /// The numbers of a step while it is sewn.
    pub sewing: StepSettings,
}

impl Piece {
    /// The cloths of a scene, in its order.
    ///
    /// # Errors
    /// [`ModelError`] when a garment cannot be meshed, or a frame would take too many steps.
    pub fn all(scene: &Scene) -> Result<Vec<Self>, ModelError> {
        let settings = &scene.settings;
        let piece = |cloth: &Cloth| match cloth {
            Cloth::Sheet(sheet) => {
                let model = Model::from_sheet(sheet, settings);
                let step = StepSettings::of_cloth(&sheet.name, settings, &model)?;
                Ok(Self { name: sheet.name.clone(), open: None, model, step })
            }
            Cloth::Garment(garment) => {
                let open = Model::from_garment(garment, settings)?;
                let sewing = StepSettings::of_cloth(&garment.name, settings, &open)?.sewing();
                let (model, merge) = open.sewn();
                let step = StepSettings::of_cloth(&garment.name, settings, &model)?;
                let open = Open { model: open, merge, sewing };
                Ok(Self { name: garment.name.clone(), open: Some(open), model, step })
            }
        };
        scene.cloths.iter().map(piece).collect()
    }

    /// The numbers of a step in a stage of the dressing.
    pub fn settings_of(&self, stage: DressingStage) -> StepSettings {
        match (stage, &self.open) {
            (DressingStage::Sewing, Some(open)) => open.sewing.clone(),
            (DressingStage::Easing, _) => self.step.easing(),
            _ => self.step.draping(),
        }
    }

    /// What is simulated in a stage of the dressing.
    pub fn model_of(&self, stage: DressingStage) -> &Model {
        match (stage, &self.open) {
            (DressingStage::Sewing, Some(open)) => &open.model,
            _ => &self.model,
        }
    }

    /// The box that a sheet can reach while it hangs on its pins or lies on something near: where it starts, and its longest side around.
    /// `None` without particles.
    pub fn reach(&self) -> Option<[Vec3; 2]> {
        let positions = || self.model.positions.iter().copied();
        let [low, high] = [positions().reduce(Vec3::min)?, positions().reduce(Vec3::max)?];
        let side = (high - low).max_element();
        Some([low - side, high + side])
    }
}
