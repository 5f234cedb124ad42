//! What a simulation tells: how the garments are dressed and worn, where all stands, and since when.

use crate::Cloth;
use crate::outfit::Teleport;
use crate::simulation::{Phase, Simulation, Worn};
use crate::stage::Stage;
use glam::DVec3;
use toile_gpu::Surface;
use toile_model::{Dressing, DressingStage, Finding, MapBox};

impl Simulation {
    /// What was found before sewing, and what was mended.
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// The cloths that are on the device, from the inside out: while garments are dressed those that are, and the one that is being dressed.
    pub fn cloths(&self) -> impl Iterator<Item = Worn<'_>> {
        let cloths: Vec<&Cloth> = match &self.phase {
            Phase::Dressing(dressed) => {
                let fitting = dressed.fitting.iter().map(|fitting| &fitting.cloth);
                dressed.done.iter().map(|done| &done.cloth).chain(fitting).collect()
            }
            Phase::Together { outfit, .. } => outfit.cloths().collect(),
        };
        let dressing = matches!(self.phase, Phase::Dressing(_));
        let pieces = self.pieces.iter().filter(move |piece| !dressing || piece.open.is_some());
        pieces.zip(cloths).zip(self.dressing_stages()).map(|((piece, cloth), stage)| Worn {
            name: &piece.name,
            model: piece.model_of(stage),
            cloth,
        })
    }

    /// How far each of the cloths that are on the device is dressed.
    pub(crate) fn dressing_stages(&self) -> impl Iterator<Item = DressingStage> {
        let (dressed, fitting) = match &self.phase {
            Phase::Dressing(dressed) => (dressed.done.len(), dressed.fitting.as_ref().map(|fitting| fitting.stage)),
            Phase::Together { outfit, .. } => (outfit.cloths().len(), None),
        };
        std::iter::repeat_n(DressingStage::Dressed, dressed).chain(fitting)
    }

    /// The cloths themselves, for measuring: [`Cloth::time_step`] goes on by a step.
    pub fn cloths_mut(&mut self) -> impl Iterator<Item = &mut Cloth> {
        let cloths: Vec<&mut Cloth> = match &mut self.phase {
            Phase::Dressing(dressed) => {
                let fitting = dressed.fitting.iter_mut().map(|fitting| &mut fitting.cloth);
                dressed.done.iter_mut().map(|done| &mut done.cloth).chain(fitting).collect()
            }
            Phase::Together { outfit, .. } => outfit.cloths_mut().collect(),
        };
        cloths.into_iter()
    }

    /// How garments have been dressed, from the inside out, and how far the present one is; empty from then on.
    pub fn dressings(&self) -> impl Iterator<Item = &Dressing> {
        let dressed = match &self.phase {
            Phase::Dressing(dressed) => Some(dressed),
            Phase::Together { .. } => None,
        };
        dressed.into_iter().flat_map(|dressed| {
            let fitting = dressed.fitting.iter().map(|fitting| &fitting.dressing);
            dressed.done.iter().map(|done| &done.dressing).chain(fitting)
        })
    }

    /// The bodies on the device as the maps draw them, at [`Simulation::body_time`]: those at rest, then those that move; none while garments
    /// are dressed.
    pub fn bodies(&self) -> impl Iterator<Item = &Surface> {
        let outfit = match &self.phase {
            Phase::Dressing(_) => None,
            Phase::Together { outfit, .. } => Some(outfit),
        };
        outfit.into_iter().flat_map(|outfit| outfit.bodies())
    }

    /// How far bodies that move stand from where their motion has them [m]: the sum of all [teleports](Simulation::teleport).
    pub fn place(&self) -> DVec3 {
        match &self.phase {
            Phase::Dressing(_) => DVec3::ZERO,
            Phase::Together { outfit, .. } => outfit.place(),
        }
    }

    /// Where the maps of the cloths stand; `None` without maps and while garments are dressed.
    pub fn map_box(&self) -> Option<MapBox> {
        match &self.phase {
            Phase::Dressing(_) => None,
            Phase::Together { outfit, .. } => outfit.shown(),
        }
    }

    /// Time since the run began that is simulated [s]; 0 before.
    pub fn time(&self) -> f64 {
        match &self.phase {
            Phase::Together { outfit, stage: Stage::Running, .. } => self.clock.done() as f64 * outfit.part_seconds(),
            _ => 0.0,
        }
    }

    /// Time in the motion of the bodies that [`Simulation::bodies`] and the maps show [s]: the end of the present interval of the maps, of which
    /// there are at least 60 in a second.
    pub fn body_time(&self) -> f64 {
        match &self.phase {
            Phase::Dressing(_) => 0.0,
            Phase::Together { outfit, .. } => outfit.body_time(),
        }
    }

    /// Where the body [jumped](toile_scene::Lead::jump) and took its garments along, since the run began or was restored: by the rigid transform
    /// of its leading joint, positions, velocities and contacts. It does so where one body moves and has joints; a sheet only lies on it.
    pub fn teleports(&self) -> &[Teleport] {
        match &self.phase {
            Phase::Together { outfit, stage: Stage::Running, .. } => outfit.teleports(),
            _ => &[],
        }
    }

    /// Bytes on the device. What its cloths share counts once, also where cloths of other simulations have it too.
    pub fn bytes(&self) -> u64 {
        let mut shared: Vec<&wgpu::Buffer> = Vec::new();
        for buffer in self.cloths().flat_map(|worn| worn.cloth.shared()) {
            if !shared.contains(&buffer) {
                shared.push(buffer);
            }
        }
        let own: u64 = self.cloths().map(|worn| worn.cloth.own_bytes()).sum();
        let cloths = own + shared.into_iter().map(wgpu::Buffer::size).sum::<u64>();
        match &self.phase {
            Phase::Dressing(_) => cloths,
            Phase::Together { outfit, .. } => cloths + outfit.bytes(),
        }
    }
}
