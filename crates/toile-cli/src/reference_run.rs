//! A scene by the CPU reference: its garments one over the other on bodies at rest, or its sheet.

use crate::bodies::{meshes, shapes};
use crate::look::{Look, State};
use anyhow::{Result, bail};
use toile::Stage;
use toile::model::{
    Dressing, DressingStage, Judged, Merge, Motion, Open, Piece, Solid, StepSettings, Verdict, raised_ways,
};
use toile::scene::{MapKind, Mesh, Scene, Shape};
use toile_reference::maps::{BodyMaps, Surface};
use toile_reference::{Colliders, Reference};

/// A scene by the CPU reference.
pub struct ReferenceRun {
    /// The bodies, then the garments that are dressed, each with whether it is open by what it is.
    layers: Vec<(Mesh, bool)>,
    maps: MapKind,
    thickness: f32,
    texel: f32,
    shapes: Vec<Shape>,
    pieces: Vec<Piece>,
    /// Those that are dressed, and the one that is.
    worn: Vec<Worn>,
}

struct Worn {
    reference: Reference,
    dressing: Option<Dressing>,
    settings: StepSettings,
    /// The stage that the cloth has been handed over for.
    stage: DressingStage,
    /// How it moves, while it drapes.
    motion: Motion,
}

impl ReferenceRun {
    /// A scene at its start.
    pub fn new(scene: &Scene) -> Result<Self> {
        let settings = &scene.settings;
        let pieces = Piece::all(scene)?;
        if pieces.len() > 1 && pieces.iter().any(|piece| piece.open.is_none()) {
            bail!("--backend reference: it runs one sheet, or garments; leave the other cloths of {} out", scene.name);
        }
        let mut run = Self {
            layers: meshes(scene).map(|mesh| (mesh.clone(), false)).collect(),
            maps: settings.maps,
            thickness: pieces.iter().map(|piece| piece.step.thickness).fold(0.0, f32::max),
            texel: settings.texel as f32,
            shapes: shapes(scene),
            pieces,
            worn: Vec::new(),
        };
        run.begin();
        Ok(run)
    }

    /// Puts the next cloth where it starts.
    fn begin(&mut self) {
        let Some(piece) = self.pieces.get(self.worn.len()) else { return };
        let thickness = self.thickness;
        let drawn = self.layers.iter().map(|(mesh, open)| Surface { mesh, thickness, velocities: None, open: *open });
        let surfaces: Vec<_> = drawn.collect();
        let maps = (!surfaces.is_empty()).then(|| BodyMaps::around(self.maps, &surfaces, self.texel));
        let colliders = Colliders::new(maps, self.shapes.clone());
        self.worn.push(match &piece.open {
            None => Worn {
                reference: Reference::new(&piece.model, &piece.step, colliders),
                dressing: None,
                settings: piece.step.clone(),
                stage: DressingStage::Dressed,
                motion: Motion::default(),
            },
            Some(Open { model: open, sewing, .. }) => Worn {
                reference: Reference::new(open, sewing, colliders),
                dressing: Some(Dressing::new(open, sewing)),
                settings: sewing.clone(),
                stage: DressingStage::Sewing,
                motion: Motion::default(),
            },
        });
    }

    /// What the scene is doing.
    pub fn stage(&self) -> Stage {
        match self.worn.last().and_then(|worn| worn.dressing.as_ref()).map(Dressing::stage) {
            None => Stage::Running,
            Some(DressingStage::Sewing) => Stage::Sewing,
            Some(DressingStage::Easing | DressingStage::Yielding) => Stage::Easing,
            Some(DressingStage::Draping) => Stage::Draping,
            Some(DressingStage::Dressed) => Stage::Dressed,
        }
    }

    /// Does one frame of the present cloth; steps that were done.
    pub fn frame(&mut self) -> Result<u32> {
        let is_last = self.worn.len() == self.pieces.len();
        let piece = &mut self.pieces[self.worn.len() - 1];
        let worn = self.worn.last_mut().expect("a scene has a cloth");
        worn.hand_over(piece);
        worn.reference.frame();
        let steps = worn.settings.steps_per_frame;
        let status = worn.reference.status();
        if let Some(particle) = status.first_non_finite {
            return Err(toile::Error::Diverged { step: status.step, particle, count: status.non_finite_count }.into());
        }
        let Some(dressing) = &mut worn.dressing else { return Ok(steps) };
        if matches!(worn.stage, DressingStage::Yielding | DressingStage::Draping) {
            worn.motion.see(status.step, worn.reference.positions().to_vec(), worn.settings.dt);
        }
        dressing.advance(&status, &worn.motion);
        piece.leave_open(dressing.is_left_open());
        if worn.stage == DressingStage::Yielding && dressing.stage() != DressingStage::Yielding {
            piece.let_out_at(worn.motion.positions());
        }
        if dressing.stage() == DressingStage::Dressed && !is_last {
            let (mut positions, normals) = (worn.reference.positions().to_vec(), worn.reference.normals());
            let triangles = piece.model.triangles();
            // As those over it see it.
            let thicknesses: Vec<f32> = self.pieces.iter().map(|piece| piece.step.thickness).collect();
            let way = raised_ways(&thicknesses)[self.worn.len() - 1];
            positions.iter_mut().zip(&normals).for_each(|(position, normal)| *position += *normal * way);
            self.layers.push((Mesh { positions, normals, triangles }, true));
            self.begin();
        }
        Ok(steps)
    }

    /// The cloths that are there, from the inside out.
    pub fn cloths(&self) -> Vec<Look<'_>> {
        self.pieces
            .iter()
            .zip(&self.worn)
            .map(|(piece, worn)| Look {
                name: &piece.name,
                model: piece.model_of(worn.stage),
                settings: worn.settings.clone(),
                status: worn.reference.status(),
            })
            .collect()
    }

    /// How the garments were dressed, in their order.
    pub fn dressings(&self) -> Vec<Dressing> {
        self.worn.iter().filter_map(|worn| worn.dressing.clone()).collect()
    }

    /// How the garments are worn, in their order.
    pub fn verdicts(&self) -> Vec<Verdict> {
        let shapes: Vec<Mesh> = self.shapes.iter().map(|shape| shape.mesh(0.0)).collect();
        let bodies = self.layers.iter().filter(|(_, open)| !open).map(|(mesh, _)| mesh);
        let body = Solid::of(bodies.chain(&shapes));
        let dressed = self.pieces.iter().zip(&self.worn);
        let verdict = |(piece, Worn { reference, dressing, motion, .. }): (&Piece, &Worn)| {
            let judged =
                Judged::new(&piece.model, reference.positions(), motion.velocities(), dressing.as_ref()?.is_at_rest());
            Some(Verdict::of(&judged, &body))
        };
        dressed.filter_map(verdict).collect()
    }

    /// The cloths, in their order.
    pub fn states(&self) -> Vec<State> {
        let state = |worn: &Worn| State {
            positions: worn.reference.positions().to_vec(),
            normals: worn.reference.normals(),
            touching: worn.reference.contacts().iter().map(|contact| contact.touching).collect(),
        };
        self.worn.iter().map(state).collect()
    }
}

impl Worn {
    /// Merges seams that are closed, and ends the easing, before the next frame.
    fn hand_over(&mut self, piece: &Piece) {
        let Some(wanted) = self.dressing.as_ref().map(Dressing::stage) else { return };
        if self.stage == DressingStage::Sewing && wanted != DressingStage::Sewing {
            let open = piece.open.as_ref().expect("a garment is open before it is sewn");
            self.go_on(DressingStage::Easing, piece, &open.merge);
        }
        let is_sewn = matches!(self.stage, DressingStage::Easing | DressingStage::Yielding);
        if is_sewn && wanted != self.stage {
            let next = if wanted == DressingStage::Yielding { wanted } else { DressingStage::Draping };
            self.go_on(next, piece, &Merge::identity(piece.model.particle_count()));
        }
    }

    fn go_on(&mut self, stage: DressingStage, piece: &Piece, merge: &Merge) {
        self.settings = piece.settings_of(stage);
        self.reference = self.reference.clone().sewn(&piece.model, &self.settings, merge);
        self.stage = stage;
    }
}
