//! A garment on its way onto a body: sewn, eased and draped, each until measured criteria hold or its time is up.

use crate::{Cloth, Colliders, Error};
use glam::{Vec3, Vec4};
use std::collections::VecDeque;
use toile_gpu::{Arrival, Kernels};
use toile_model::{Dressing, DressingStage, Merge, Motion, Piece, Status};

/// Most frames whose positions are under way at once; a frame that finds so many is not looked at.
const LOOK_COUNT: usize = 4;

/// A garment on its way onto bodies that stand still.
#[derive(Debug)]
pub(crate) struct Fitting {
    pub(crate) cloth: Cloth,
    pub(crate) dressing: Dressing,
    /// The step of the last status that was heard.
    pub(crate) heard: Option<u64>,
    /// The stage that the cloth has been handed over for.
    pub(crate) stage: DressingStage,
    /// How it moves, while it drapes.
    pub(crate) motion: Motion,
    /// Positions under way, with the steps that they are of.
    pub(crate) looks: VecDeque<(u64, Arrival)>,
}

impl Fitting {
    /// A garment whose panels stand where they were placed.
    ///
    /// # Errors
    /// [`Error::Gpu`] when the garment does not fit the device.
    pub(crate) fn new(kernels: &Kernels, piece: &Piece, colliders: Colliders) -> Result<Self, Error> {
        let open = piece.open.as_ref().expect("a garment is open before it is sewn");
        let cloth = Cloth::new(kernels, &open.model, &open.sewing, colliders)?;
        let dressing = Dressing::new(&open.model, &open.sewing);
        Ok(Self::go_on(cloth, dressing, None, DressingStage::Sewing, Motion::default()))
    }

    /// A garment that has come so far.
    pub(crate) fn go_on(
        cloth: Cloth,
        dressing: Dressing,
        heard: Option<u64>,
        stage: DressingStage,
        motion: Motion,
    ) -> Self {
        Self { cloth, dressing, heard, stage, motion, looks: VecDeque::new() }
    }

    /// Hears what the device has reported since the last time.
    ///
    /// # Errors
    /// [`Error::Diverged`] when a particle is not finite.
    pub(crate) fn hear(&mut self, piece: &mut Piece) -> Result<(), Error> {
        // What the cloth of the stage before reports says nothing about the next.
        if self.dressing.stage() != self.stage {
            return Ok(());
        }
        self.look();
        let Some(status) =
            self.cloth.status()?.filter(|status: &Status| self.heard.is_none_or(|heard| status.step > heard))
        else {
            return Ok(());
        };
        self.heard = Some(status.step);
        self.dressing.advance(&status, &self.motion);
        piece.leave_open(self.dressing.is_left_open());
        if self.stage == DressingStage::Yielding && self.dressing.stage() != DressingStage::Yielding {
            piece.let_out_at(self.motion.positions());
        }
        Ok(())
    }

    /// Takes the positions that have arrived.
    fn look(&mut self) {
        let dt = self.cloth.settings().dt;
        while let Some((step, arrival)) = self.looks.front_mut() {
            if let Some(bytes) = arrival.take() {
                let positions = bytemuck::pod_collect_to_vec::<u8, Vec4>(&bytes);
                self.motion.see(*step, positions.into_iter().map(Vec4::truncate).collect::<Vec<Vec3>>(), dt);
            } else if !arrival.is_over() {
                return;
            }
            self.looks.pop_front();
        }
    }

    /// Records the handovers that are due, then a frame.
    ///
    /// # Errors
    /// [`Error::Gpu`] when the sewn garment does not fit the device.
    pub(crate) fn record(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        piece: &Piece,
    ) -> Result<(), Error> {
        let open = piece.open.as_ref().expect("a garment is open before it is sewn");
        let wanted = self.dressing.stage();
        if self.stage == DressingStage::Sewing && wanted != DressingStage::Sewing {
            self.hand_over(device, encoder, piece, &open.merge, DressingStage::Easing)?;
        }
        let is_sewn = !matches!(self.stage, DressingStage::Sewing | DressingStage::Draping);
        if is_sewn && wanted != self.stage {
            let next = if wanted == DressingStage::Yielding { wanted } else { DressingStage::Draping };
            let same = Merge::identity(piece.model.particle_count());
            self.hand_over(device, encoder, piece, &same, next)?;
        }
        self.cloth.record(device, encoder);
        let is_seen = matches!(self.stage, DressingStage::Yielding | DressingStage::Draping);
        if is_seen && self.looks.len() < LOOK_COUNT {
            let positions = Arrival::of(device, encoder, &self.cloth.frame().positions);
            self.looks.push_back((self.cloth.step(), positions));
        }
        Ok(())
    }

    fn hand_over(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        piece: &Piece,
        merge: &Merge,
        stage: DressingStage,
    ) -> Result<(), Error> {
        self.cloth = self.cloth.sewn(device, encoder, &piece.model, merge, &piece.settings_of(stage))?;
        self.stage = stage;
        self.heard = Some(self.cloth.step());
        Ok(())
    }
}
