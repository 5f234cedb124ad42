//! A simulation under the hand of its host.

use crate::outfit::Outfit;
use crate::simulation::{Phase, Simulation};
use crate::stage::Stage;
use crate::{Checkpoint, Control, Error};
use glam::DVec3;
use toile_model::{DressingStage, StepSettings};

/// Farthest that a body may stand from where its motion has it [m]: beyond, the places of particles are coarser than a thread.
const FARTHEST: f64 = 1e4;

impl Simulation {
    /// What changes while it runs, as it is now.
    pub fn control(&self) -> &Control {
        &self.control
    }

    /// Changes what may change while it runs; it holds for what is recorded from now on. Control is no part of a saved state: a host that restores
    /// one sets it again.
    ///
    /// # Errors
    /// [`Error::Model`] when a number is out of its range, or a stiffness asks for a shorter step than the cloth has; [`Error::Gpu`] when what it asks for
    /// does not fit the device. Then nothing is changed.
    ///
    /// # Panics
    /// When something changes that stays: density, thickness, and the number of shapes while garments are dressed; and when a particle that is
    /// held does not exist.
    pub fn set_control(&mut self, encoder: &mut wgpu::CommandEncoder, control: &Control) -> Result<(), Error> {
        control.check(&self.control, &self.settings)?;
        for (piece, pins) in self.pieces.iter().zip(&control.pins) {
            let count = piece.model.particle_count();
            let last = pins.last_key_value().map_or(0, |(particle, _)| *particle);
            assert!(pins.is_empty() || last < count, "{} has {count} particles, and no particle {last}", piece.name);
        }
        assert!(
            matches!(self.phase, Phase::Together { .. }) || control.shapes.len() == self.control.shapes.len(),
            "while garments are dressed there are as many shapes as the scene has"
        );
        let settings = control.settings(&self.settings);
        let changed = |index: &usize| control.changes_model(*index, &self.control.fabrics[*index]);
        let changed: Vec<usize> = (0..self.pieces.len()).filter(changed).collect();
        let changes_model = !changed.is_empty();
        let changes_shapes = control.shapes != self.control.shapes;
        // Most calls move a pin: only what may be taken back is kept.
        let pieces_before = control.may_ask_for_passes(&self.control).then(|| self.pieces.clone());
        let remade = changed.iter().map(|index| {
            let mut cloth = self.scene_cloths[*index].clone();
            cloth.set_fabric(control.fabrics[*index].clone());
            self.pieces[*index].of_other_fabric(&cloth, &settings)
        });
        for (index, piece) in changed.iter().zip(remade.collect::<Result<Vec<_>, _>>()?) {
            self.pieces[*index] = piece;
        }
        let pieces = self.pieces.iter_mut().zip(&control.fabrics);
        pieces.for_each(|(piece, fabric)| piece.take_numbers(&settings, fabric));
        let before = (
            std::mem::replace(&mut self.settings, settings),
            std::mem::replace(&mut self.bodies.shapes, control.shapes.clone()),
            std::mem::replace(&mut self.control, control.clone()),
        );
        if self.wants_other_passes() {
            if let Err(error) = self.go_on_in_new_buffers(encoder) {
                (self.settings, self.bodies.shapes, self.control) = before;
                self.pieces = pieces_before.unwrap_or_else(|| std::mem::take(&mut self.pieces));
                return Err(error);
            }
            return Ok(());
        }
        self.tell_numbers(encoder, changes_model);
        if changes_shapes {
            let shapes = self.bodies.shapes.clone();
            self.cloths_mut().for_each(|cloth| cloth.set_shapes(shapes.clone()));
        }
        if let Phase::Together { outfit, stage: Stage::Running, .. } = &mut self.phase {
            outfit.set_pins(control.pins.iter());
        }
        Ok(())
    }

    /// Whether all go together and a cloth lacks a pass, or room for the shapes.
    fn wants_other_passes(&self) -> bool {
        let Phase::Together { outfit, stage, .. } = &self.phase else { return false };
        let first = self.pieces.first().map_or(1, |piece| piece.step.steps_per_frame);
        let mut worn = self.pieces.iter().zip(outfit.cloths());
        worn.any(|(piece, cloth)| {
            !cloth.has_passes_of(&self.step_together(piece, *stage, first), self.bodies.shapes.len())
        })
    }

    /// Has all go on in an outfit of the present settings and shapes.
    pub(crate) fn go_on_in_new_buffers(&mut self, encoder: &mut wgpu::CommandEncoder) -> Result<(), Error> {
        let Phase::Together { outfit: before, stage, garment_bounds } = &self.phase else { return Ok(()) };
        let mut outfit = self.outfit(*stage, garment_bounds)?;
        outfit.go_on_from(encoder, before)?;
        if *stage == Stage::Running {
            if self.keeps_maps {
                outfit.keep_maps(&self.kernels, &self.bodies.moving[0], &mut |_, record| {
                    record(encoder);
                    Ok(())
                })?;
            }
            outfit.set_pins(self.control.pins.iter());
        }
        if let Phase::Together { outfit: before, .. } = &mut self.phase {
            **before = outfit;
        }
        Ok(())
    }

    /// Tells the cloths on the device the numbers of their steps, and those of their springs and limits where these have changed.
    fn tell_numbers(&mut self, encoder: &mut wgpu::CommandEncoder, changes_model: bool) {
        let (dressing, stage) = match &self.phase {
            Phase::Dressing(_) => (true, Stage::Sewing),
            Phase::Together { stage, .. } => (false, *stage),
        };
        let stages: Vec<DressingStage> = self.dressing_stages().collect();
        let device = self.device.clone();
        // Taken out, so that cloths and models are borrowed side by side.
        let pieces = std::mem::take(&mut self.pieces);
        let worn = pieces.iter().filter(|piece| !dressing || piece.open.is_some());
        let first = pieces.first().map_or(1, |piece| piece.step.steps_per_frame);
        let step = |piece, of: DressingStage| -> StepSettings {
            if dressing { toile_model::Piece::settings_of(piece, of) } else { self.step_together(piece, stage, first) }
        };
        let told: Vec<_> = worn.zip(stages).map(|(piece, of)| (piece.model_of(of), step(piece, of))).collect();
        for ((model, step), cloth) in told.iter().zip(self.cloths_mut()) {
            if changes_model {
                cloth.set_model(model);
            }
            cloth.record_settings(&device, encoder, step);
        }
        self.pieces = pieces;
    }

    /// Sets the body that moves elsewhere at once, by a way [m], and what it wears along with it: nothing of it is felt as a motion. Shapes and sheets
    /// stay. A host that only draws everything elsewhere needs none of this. One that skins the body itself has it there from the next
    /// [`Simulation::advance`] on.
    ///
    /// # Panics
    /// Before the run, where a body stands still beside, where maps are kept, or when the body would stand more than 10 km from where its motion has it.
    pub fn teleport(&mut self, encoder: &mut wgpu::CommandEncoder, way: DVec3) {
        let device = self.device.clone();
        let outfit = self.running("a body is set elsewhere");
        assert!(
            !outfit.is_bound_to_its_place(),
            "a body beside one that stands still, or whose maps are kept, stays where it is"
        );
        let place = outfit.place() + way;
        assert!(
            place.abs().max_element() <= FARTHEST,
            "a body stands at most {FARTHEST} m from where its motion has it"
        );
        outfit.set_place(place);
        outfit.carry_by(&device, encoder, way);
    }

    /// Takes a garment or sheet off, by its place in [`Simulation::cloths`]: what lay over it falls on what is below. [`Simulation::put_on`] is the way back.
    ///
    /// # Panics
    /// Before the run, when there is no such cloth, or when it is the only one.
    pub fn take_off(&mut self, index: usize) {
        let count = self.pieces.len();
        assert!(
            index < count && count > 1,
            "there are {count} cloths: one of them stays, and {index} is none to take off"
        );
        let outfit = self.running("a cloth is taken off");
        let before = outfit.part_seconds();
        outfit.take_off(index);
        let ratio = (before / outfit.part_seconds()).round() as u64;
        self.clock = self.clock.in_parts(ratio);
        self.pieces.remove(index);
        self.scene_cloths.remove(index);
        self.control.pins.remove(index);
        self.control.fabrics.remove(index);
    }

    /// Records a copy of the state on the device, to which [`Simulation::reset`] goes back.
    ///
    /// # Panics
    /// Before the run.
    pub fn checkpoint(&mut self, encoder: &mut wgpu::CommandEncoder) -> Checkpoint {
        let (device, clock, control) = (self.device.clone(), self.clock, self.control.clone());
        let outfit = self.running("a checkpoint is made");
        Checkpoint {
            marks: outfit.cloths().map(|cloth| cloth.record_mark(&device, encoder)).collect(),
            clock,
            done: outfit.done(),
            place: outfit.place(),
            middle: outfit.middle(),
            teleport_count: outfit.teleports().len(),
            control,
            pins: outfit.pins().cloned().collect(),
        }
    }

    /// Goes back to a checkpoint of this simulation, control and body included.
    ///
    /// # Errors
    /// As [`Simulation::set_control`].
    ///
    /// # Panics
    /// Before the run, and when a cloth was taken off or put on since.
    pub fn reset(&mut self, encoder: &mut wgpu::CommandEncoder, checkpoint: &Checkpoint) -> Result<(), Error> {
        let outfit = self.running("it goes back to a checkpoint");
        assert_eq!(
            checkpoint.marks.len(),
            outfit.cloths().len(),
            "a checkpoint is of the cloths that there are: none was taken off or put on since"
        );
        outfit.set_place(checkpoint.place);
        if let Some(middle) = checkpoint.middle {
            outfit.stand_around(middle);
        }
        outfit.go_back(checkpoint.done, checkpoint.teleport_count);
        outfit.know_pins(checkpoint.pins.iter().cloned());
        for (cloth, mark) in outfit.cloths_mut().zip(&checkpoint.marks) {
            cloth.record_reset(encoder, mark);
        }
        self.clock = checkpoint.clock;
        self.set_control(encoder, &checkpoint.control)
    }

    pub(crate) fn running(&mut self, what: &str) -> &mut Outfit {
        match &mut self.phase {
            Phase::Together { outfit, stage: Stage::Running, .. } => outfit,
            _ => panic!("{what} once the run has begun"),
        }
    }
}
