//! The cloths of a scene, meshed.

use super::dressing::DressingStage;
use super::letting_out::LetOut;
use super::step::StepSettings;
use crate::{Merge, Model, ModelError};
use glam::Vec3;
use toile_scene::{Cloth, Fabric, Scene, Settings};

/// A garment or a sheet, meshed, with the numbers of its steps.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Name of the garment or sheet.
    pub name: String,
    /// The garment before it is sewn; `None` for a sheet.
    pub open: Option<Open>,
    /// The sheet, or the garment once it is sewn; see [`Piece::leave_open`].
    pub model: Model,
    /// The numbers of a step of the run.
    pub step: StepSettings,
    /// What it is made of.
    pub fabric: Fabric,
    let_out: LetOut,
}

/// A garment before it is sewn.
#[derive(Clone, Debug)]
pub struct Open {
    /// Its panels.
    pub model: Model,
    /// How its particles become those of the sewn one.
    pub merge: Merge,
    /// The numbers of a step while it is sewn.
    pub sewing: StepSettings,
    /// The numbers of a step of the run, where it is left open.
    step: StepSettings,
    /// What would have been worn, where it is left open.
    sewn: Option<Box<Sewn>>,
}

/// What is worn once a garment is sewn.
#[derive(Clone, Debug)]
struct Sewn {
    model: Model,
    merge: Merge,
    step: StepSettings,
}

/// How far each of some cloths, from the inside out, is raised in what those over it see [m], by their thicknesses [m]. An outer one keeps its own thickness from
/// what is below; where that is thicker, the outer face of what is below would show through it.
pub fn raised_ways(thicknesses: &[f32]) -> Vec<f32> {
    let way = |index: usize| {
        let thinnest = thicknesses[index + 1..].iter().copied().reduce(f32::min);
        thinnest.map_or(0.0, |thinnest| (thicknesses[index] - thinnest).max(0.0))
    };
    (0..thicknesses.len()).map(way).collect()
}

impl Piece {
    /// The cloths of a scene, in its order.
    ///
    /// # Errors
    /// [`ModelError`] when a number is out of its range, a garment cannot be meshed, or a frame would take too many steps.
    pub fn all(scene: &Scene) -> Result<Vec<Self>, ModelError> {
        scene.check()?;
        scene.cloths.iter().map(|cloth| Self::new(cloth, &scene.settings)).collect()
    }

    fn new(cloth: &Cloth, settings: &Settings) -> Result<Self, ModelError> {
        let settings = &settings.of_fabric(cloth.fabric());
        let fabric = settings.fabric.clone();
        match cloth {
            Cloth::Sheet(sheet) => {
                let model = Model::from_sheet(sheet, settings);
                let step = StepSettings::of_cloth(&sheet.name, settings, &model)?;
                Ok(Self { name: sheet.name.clone(), open: None, model, step, fabric, let_out: LetOut::default() })
            }
            Cloth::Garment(garment) => {
                let open = Model::from_garment(garment, settings)?;
                let open_step = StepSettings::of_cloth(&garment.name, settings, &open)?;
                let (model, merge) = open.sewn();
                let step = StepSettings::of_cloth(&garment.name, settings, &model)?;
                let open = Open { model: open, merge, sewing: open_step.sewing(), step: open_step, sewn: None };
                Ok(Self {
                    name: garment.name.clone(),
                    open: Some(open),
                    model,
                    step,
                    fabric,
                    let_out: LetOut::default(),
                })
            }
        }
    }

    /// Takes the numbers of settings that may change while a cloth runs, and of its fabric; see [`StepSettings::with_numbers_of`].
    pub fn take_numbers(&mut self, settings: &Settings, fabric: &Fabric) {
        let settings = &settings.of_fabric(Some(fabric));
        self.fabric = fabric.clone();
        let take = |step: &mut StepSettings| *step = step.with_numbers_of(settings);
        take(&mut self.step);
        if let Some(open) = &mut self.open {
            take(&mut open.step);
            open.sewing = open.step.sewing();
            open.sewn.iter_mut().for_each(|sewn| take(&mut sewn.step));
        }
    }

    /// Largest area for which maps of the cloth make room [m²].
    pub fn area_max(&self) -> f64 {
        self.model.area_max(self.fabric.areal_density)
    }

    /// The same piece of the fabric that its cloth has now, as it runs: with the step that it has, worn as it is.
    ///
    /// # Errors
    /// [`ModelError::Steps`] when the fabric asks for a shorter step; [`ModelError`] when the cloth cannot be meshed.
    pub fn of_other_fabric(&self, cloth: &Cloth, settings: &Settings) -> Result<Self, ModelError> {
        let mut piece = Self::new(cloth, settings)?;
        piece.leave_open(self.is_left_open());
        piece.step = piece.step.at_step_of(&self.name, &self.step)?;
        if let (Some(open), Some(old)) = (&mut piece.open, &self.open) {
            open.step = open.step.at_step_of(&self.name, &old.step)?;
            open.sewing = open.step.sewing();
            if let (Some(sewn), Some(old)) = (&mut open.sewn, &old.sewn) {
                sewn.step = sewn.step.at_step_of(&self.name, &old.step)?;
            }
        }
        Ok(piece)
    }

    /// Has the garment be worn as its open model, whose seams are still drawn together, or as the sewn one again. Seams that stayed far open
    /// are not merged: what lies between them would end on the wrong side. A sheet has no seams and stays as it is.
    pub fn leave_open(&mut self, is_left: bool) {
        let Some(open) = &mut self.open else { return };
        open.sewn = match (open.sewn.take(), is_left) {
            (None, true) => Some(Box::new(Sewn {
                model: std::mem::replace(&mut self.model, open.model.clone()),
                merge: std::mem::replace(&mut open.merge, Merge::identity(open.model.particle_count())),
                step: std::mem::replace(&mut self.step, open.step.clone()),
            })),
            (Some(sewn), false) => {
                (self.model, open.merge, self.step) = (sewn.model, sewn.merge, sewn.step);
                None
            }
            (as_it_is, _) => as_it_is,
        };
    }

    /// Whether the garment is worn as its open model.
    pub fn is_left_open(&self) -> bool {
        self.open.as_ref().is_some_and(|open| open.sewn.is_some())
    }

    /// Lets limits out to what the garment needs where it lies, at positions [m], shape [particle_count], evened out along the lines of its
    /// cloth. What is stretched within its threshold keeps its limits; so do sheets, and what is left open.
    pub fn let_out_at(&mut self, positions: &[Vec3]) {
        let Some(open) = self.open.as_ref().filter(|open| open.sewn.is_none()) else { return };
        let ratios = self.model.room_at(&open.model, &open.merge, positions);
        self.let_out(&ratios);
    }

    /// Lets limits out by so much each [1], shape [limit_count], in place of what they were let out by before; empty takes that back.
    pub fn let_out(&mut self, ratios: &[f32]) {
        self.let_out.apply(&mut self.model, ratios);
    }

    /// By how much limits are let out [1], shape [limit_count]; empty where none is.
    pub fn room(&self) -> &[f32] {
        &self.let_out.ratios
    }

    /// The numbers of a step in a stage of the dressing.
    pub fn settings_of(&self, stage: DressingStage) -> StepSettings {
        match (stage, &self.open) {
            (DressingStage::Sewing, Some(open)) => open.sewing.clone(),
            (DressingStage::Easing, _) => self.step.easing(),
            (DressingStage::Yielding, _) => self.step.yielding(),
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

#[cfg(test)]
mod tests {
    use super::raised_ways;

    #[test]
    fn what_is_thicker_than_one_over_it_is_raised_by_the_rest() {
        for (thicknesses, ways) in [
            (&[] as &[f32], &[] as &[f32]),
            (&[0.003], &[0.0]),
            (&[0.003, 0.003], &[0.0, 0.0]),
            (&[0.0015, 0.003], &[0.0, 0.0]),
            (&[0.003, 0.0015], &[0.0015, 0.0]),
            (&[0.004, 0.006, 0.001, 0.002], &[0.003, 0.005, 0.0, 0.0]),
        ] {
            let found = raised_ways(thicknesses);
            assert_eq!(found.len(), ways.len());
            assert!(found.iter().zip(ways).all(|(a, b)| (a - b).abs() < 1e-7), "{thicknesses:?}: {found:?}");
        }
    }
}
