//! A scene that runs: its garments are sewn, eased and draped, then everything goes on together.

use crate::boxes::{Boxes, MapPlan, around_both};
use crate::clock::{Advance, Clock};
use crate::control::{Control, pins_of};
use crate::dressed::{Bounds, Done, Dressed};
use crate::fitting::Fitting;
use crate::kept_maps::maps_of_round;
use crate::layer::raised;
use crate::outfit::{Bodies, Laid, Outfit, Part, Recorder, maps_per_frame};
use crate::pins::Pins;
use crate::stage::Stage;
use crate::{Cloth, Colliders, Error, pose};
use glam::{DVec3, Vec3};
use std::sync::Arc;
use toile_gpu::{BodyMaps, HostVertices, Kernels, MapSpace, Surface};
use toile_model::{DressingStage, Finding, Fit, FitOptions, MapBox, Model, Piece, StepSettings, raised_ways};
use toile_scene::{Body, Cloth as Cut, Mesh, Motion, MovingMesh, Scene, Settings};

/// Time that garments have to hang quietly once the body has gone over to the start of its motion [s].
const WAITING_SECONDS: f64 = 0.5;

/// One cloth of a simulation.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Worn<'a> {
    /// Name of the garment or sheet.
    pub name: &'a str,
    /// What is simulated: the open model of a garment that is being sewn, the sewn one from then on.
    pub model: &'a Model,
    /// It on the device.
    pub cloth: &'a Cloth,
}

/// A scene that runs on the caller's device.
///
/// Garments are sewn, eased and draped one over the other, on bodies that stand still. Then everything goes on together: bodies,
/// their maps, garments and sheets. The host advances it by any seconds and submits what was recorded; nothing here waits.
///
/// ```no_run
/// # fn host(device: &wgpu::Device, queue: &wgpu::Queue, scene: &toile::scene::Scene) -> Result<(), toile::Error> {
/// let mut simulation = toile::Simulation::new(device, scene)?;
/// for _ in 0..1000 {
///     let mut encoder = device.create_command_encoder(&Default::default());
///     simulation.advance(&mut encoder, 1.0 / 144.0)?;
///     // Draw the buffers of simulation.cloths() with the same encoder, then:
///     queue.submit([encoder.finish()]);
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Simulation {
    pub(crate) device: wgpu::Device,
    pub(crate) kernels: Kernels,
    pub(crate) settings: Settings,
    pub(crate) bodies: Bodies,
    /// The way of the body from the pose that garments are sewn in to the start of its motion.
    pub(crate) way: Option<MovingMesh>,
    /// What was found before sewing.
    pub(crate) findings: Vec<Finding>,
    /// Where the maps of the run stand, if its bodies decide that.
    pub(crate) boxes: Option<Boxes>,
    pub(crate) pieces: Vec<Piece>,
    /// What the pieces are made of.
    pub(crate) scene_cloths: Vec<Cut>,
    pub(crate) control: Control,
    /// What the host skins.
    vertices: Option<HostVertices>,
    pub(crate) keeps_maps: bool,
    pub(crate) clock: Clock,
    pub(crate) phase: Phase,
}

/// What a simulation has on the device.
#[derive(Debug)]
pub(crate) enum Phase {
    /// Garments are dressed one after the other.
    Dressing(Box<Dressed>),
    /// All go together: on the way to the start of the motion, or in the run.
    Together {
        outfit: Box<Outfit>,
        stage: Stage,
        /// Boxes around the garments as they were dressed, where the maps stand around them.
        garment_bounds: Vec<[Vec3; 2]>,
    },
}

impl Simulation {
    /// A scene at its start; `kernels` is a device, or the pipelines that other simulations on it use. Before anything is sewn, [`Fit`] looks at how body and panels stand, and mends what it can; see
    /// [`Simulation::findings`]. A body that moves is dressed in the first of these poses that stands clear of the panels, or else in the clearest:
    /// the first of its motion, that without any clip, both with level arms if seams would close around these, those of its clip; it goes over to its
    /// motion in a second. So does a mesh at rest whose arms are in the way of seams: it is dressed with level arms, which then go down.
    ///
    /// # Errors
    /// [`Error::Fit`] when what stands in the way of sewing cannot be mended, [`Error::Model`] when a garment cannot be meshed or a frame would take
    /// too many steps, [`Error::Body`] when a body leads to no place. What does not fit the device is told by [`Simulation::advance`].
    pub fn new(kernels: impl Into<Kernels>, scene: &Scene) -> Result<Self, Error> {
        Self::fitted(kernels, &Fit::new(scene, &FitOptions::default())?)
    }

    /// A scene whose garments are sewn in the first pose of `from`: the same body with another clip.
    ///
    /// # Errors
    /// [`Error::Pose`] when the scene has no such body, and as [`Simulation::new`].
    pub fn dressed_in(kernels: impl Into<Kernels>, scene: &Scene, from: &MovingMesh) -> Result<Self, Error> {
        let mut options = FitOptions::default();
        options.dress_in = Some(from.clone());
        Self::fitted(kernels, &Fit::new(scene, &options)?)
    }

    /// A scene that has been looked at.
    ///
    /// # Errors
    /// [`Error::Pose`] when the pose to dress in is not one of the body that moves, and otherwise as [`Simulation::new`].
    pub fn fitted(kernels: impl Into<Kernels>, fit: &Fit) -> Result<Self, Error> {
        let kernels = kernels.into();
        let scene = &fit.scene;
        let way = pose::way(fit);
        if fit.dress_in.is_some() && way.is_none() {
            return Err(Error::Pose);
        }
        let pieces = Piece::all(scene)?;
        let mut bodies = Bodies::default();
        for body in &scene.bodies {
            match body {
                Body::Mesh(mesh) => bodies.still.push(mesh.clone()),
                Body::Moving(moving) => bodies.moving.push(moving.clone()),
                Body::Shape(shape) => bodies.shapes.push(shape.clone()),
            }
        }
        let hosted = bodies.moving.iter().filter(|body| matches!(body.motion, Motion::Hosted)).count();
        assert!(
            hosted <= 1,
            "a simulation has one body that the host skins, and the scene has {hosted}: give each a simulation of its own"
        );
        let settings = scene.settings.clone();
        let control = Control::of(&settings, &bodies.shapes, &pieces);
        let mut simulation = Self {
            device: kernels.device().clone(),
            kernels,
            way: way.filter(|_| pieces.iter().any(|piece| piece.open.is_some())),
            boxes: None,
            vertices: None,
            keeps_maps: false,
            clock: Clock::default(),
            phase: Phase::Dressing(Box::default()),
            settings,
            bodies,
            findings: fit.findings.clone(),
            scene_cloths: scene.cloths.clone(),
            pieces,
            control,
        };
        if !simulation.bodies.moving.is_empty() {
            // Before any work: a body may lead to no map_box.
            simulation.boxes = Some(simulation.boxes_of_all()?);
        }
        Ok(simulation)
    }

    /// Goes on by `seconds` of the host's time and records what is due into its encoder: whole steps, the rest is kept. While garments are
    /// dressed and while a body goes over to its motion, whole frames are recorded. What is recorded counts as done, so an encoder that is
    /// dropped loses it.
    ///
    /// # Errors
    /// [`Error::Diverged`] when a particle is not finite, [`Error::Gpu`] when what comes next does not fit the device. A garment that cannot be
    /// dressed is none: see [`Simulation::verdicts`].
    ///
    /// # Panics
    /// When the seconds are negative or no number.
    pub fn advance(&mut self, encoder: &mut wgpu::CommandEncoder, seconds: f64) -> Result<Advance, Error> {
        self.advance_by(seconds, &mut |_, record| {
            record(encoder);
            Ok(())
        })
    }

    /// Goes on by `seconds` and says how long that took: bodies and their maps, then all else [ms]. For measuring only: it submits, and waits.
    ///
    /// # Errors
    /// As [`Simulation::advance`].
    #[cfg(feature = "native-wait")]
    pub fn advance_timed(&mut self, queue: &wgpu::Queue, seconds: f64) -> Result<(Advance, [f64; 2]), Error> {
        let device = self.device.clone();
        let mut milliseconds = [0.0; 2];
        let advance = self.advance_by(seconds, &mut |part, record| {
            let start = std::time::Instant::now();
            let mut encoder = device.create_command_encoder(&Default::default());
            record(&mut encoder);
            queue.submit([encoder.finish()]);
            device
                .poll(wgpu::PollType::wait_indefinitely())
                .map_err(|error| toile_gpu::GpuError::Device(error.to_string()))?;
            milliseconds[usize::from(part == Part::Steps)] += 1e3 * start.elapsed().as_secs_f64();
            Ok(())
        })?;
        Ok((advance, milliseconds))
    }

    fn advance_by(&mut self, seconds: f64, recorder: &mut Recorder<'_>) -> Result<Advance, Error> {
        if self.stage()? == Stage::Dressed || self.is_over() {
            self.go_together(recorder)?;
        }
        let frame = 1.0 / self.settings.frame_rate;
        let part = match &self.phase {
            Phase::Together { outfit, stage: Stage::Running, .. } => outfit.part_seconds(),
            _ => frame,
        };
        let (parts, mut advance) = self.clock.go_on(seconds, part, frame);
        if let (Phase::Together { outfit, stage: Stage::Running, .. }, Some(vertices)) =
            (&mut self.phase, &self.vertices)
        {
            outfit.give(&self.device, vertices, self.clock.asked(), seconds - advance.dropped_seconds)?;
        }
        advance.step_count = match &mut self.phase {
            Phase::Together { outfit, stage: Stage::Running, .. } => outfit.record(&self.device, parts, recorder)?,
            Phase::Together { outfit, .. } => {
                let per_frame = (frame / outfit.part_seconds()).round() as u64;
                // The way may be over before all that is due is done.
                let last = self.way.as_ref().map_or(0, |way| way_frames(way, frame));
                outfit.record(&self.device, parts.start * per_frame..parts.end.min(last) * per_frame, recorder)?
            }
            Phase::Dressing(_) => {
                let mut steps = 0;
                for _ in parts {
                    steps += self.dress_for_a_frame(recorder)?;
                }
                steps
            }
        };
        Ok(advance)
    }

    /// Has these be the vertices of the body that the host skins, whose scene has a [`MovingMesh::hosted`]: from [`Stage::Running`] on, at the end of each
    /// [`Simulation::advance`], they show it at the time that the host asked for. The host skins before, in the same encoder or one that is
    /// submitted earlier, and sets them once or before each call. Until then it stands as its mesh does.
    ///
    /// # Panics
    /// When the scene has no such body. What is wrong with a buffer is told by [`Simulation::advance`].
    pub fn set_vertices(&mut self, vertices: HostVertices) {
        let is_hosted = |body: &MovingMesh| matches!(body.motion, Motion::Hosted);
        assert!(
            self.bodies.moving.iter().any(is_hosted),
            "vertices of the host are those of a body whose motion is Motion::Hosted, and the scene has none"
        );
        self.vertices = Some(vertices);
    }

    /// What the simulation is doing, as far as the device has reported.
    ///
    /// # Errors
    /// [`Error::Diverged`] when a particle is not finite, [`Error::Maps`] when the maps do not hold all of the bodies, [`Error::Outside`], once for each time, when a body
    /// that the host skins was seen outside of them. The run goes on after it.
    pub fn stage(&mut self) -> Result<Stage, Error> {
        match &mut self.phase {
            Phase::Together { outfit, stage, .. } => {
                for cloth in outfit.cloths() {
                    cloth.status()?;
                }
                if let Some(fault) = outfit.maps_fault() {
                    return Err(fault.into());
                }
                if let Some(outside) = outfit.take_outside() {
                    return Err(Error::Outside { outside });
                }
                Ok(*stage)
            }
            Phase::Dressing(dressed) => {
                let mut garments = self.pieces.iter_mut().filter(|piece| piece.open.is_some());
                let Some(piece) = garments.nth(dressed.done.len()) else {
                    return Ok(if dressed.done.is_empty() { Stage::Running } else { Stage::Dressed });
                };
                let Some(mut fitting) = dressed.fitting.take() else { return Ok(Stage::Sewing) };
                let heard = fitting.hear(piece);
                let stage = fitting.dressing.stage();
                if stage == DressingStage::Dressed && heard.is_ok() {
                    let Fitting { cloth, dressing, motion, .. } = fitting;
                    let velocities = motion.velocities().to_vec();
                    dressed.done.push(Done { cloth, dressing, velocities, bounds: Bounds::Unknown });
                    return self.stage();
                }
                dressed.fitting = Some(fitting);
                heard?;
                Ok(match stage {
                    DressingStage::Sewing => Stage::Sewing,
                    DressingStage::Easing | DressingStage::Yielding => Stage::Easing,
                    DressingStage::Draping | DressingStage::Dressed => Stage::Draping,
                })
            }
        }
    }

    /// Whether there is nothing to dress, or the way to the start of the motion lies behind.
    fn is_over(&self) -> bool {
        match &self.phase {
            Phase::Dressing(_) => self.pieces.iter().all(|piece| piece.open.is_none()),
            Phase::Together { stage, .. } => {
                let frames = self.way.as_ref().map_or(0, |way| way_frames(way, 1.0 / self.settings.frame_rate));
                *stage == Stage::Posing && self.clock.done() >= frames
            }
        }
    }

    /// A frame of the garment that is being dressed; the number of its steps.
    fn dress_for_a_frame(&mut self, recorder: &mut Recorder<'_>) -> Result<u32, Error> {
        let Phase::Dressing(dressed) = &mut self.phase else { return Ok(0) };
        let Some(piece) = self.pieces.iter().filter(|piece| piece.open.is_some()).nth(dressed.done.len()) else {
            return Ok(0);
        };
        if dressed.fitting.is_none() {
            let Some(inner) = dressed.known_bounds(&self.device, recorder)? else { return Ok(0) };
            let Phase::Dressing(dressed) = &self.phase else { return Ok(0) };
            let maps = self.draw_still_maps(&dressed.done, &inner, recorder)?;
            let Phase::Dressing(dressed) = &mut self.phase else { return Ok(0) };
            let colliders = Colliders::new(maps, self.bodies.shapes.clone());
            dressed.fitting = Some(Fitting::new(&self.kernels, piece, colliders)?);
        }
        let Phase::Dressing(dressed) = &mut self.phase else { return Ok(0) };
        let Some(fitting) = &mut dressed.fitting else { return Ok(0) };
        let mut done = Ok(());
        recorder(Part::Steps, &mut |encoder| done = fitting.record(&self.device, encoder, piece))?;
        done?;
        Ok(fitting.cloth.settings().steps_per_frame)
    }

    /// The meshes that garments are dressed on: bodies at rest, and those that move in the pose to dress in.
    pub(crate) fn dressing_meshes(&self) -> Vec<&Mesh> {
        match &self.way {
            // The way of the only mesh.
            Some(way) if self.bodies.moving.is_empty() => vec![&way.mesh],
            Some(way) => self.bodies.still.iter().chain([&way.mesh]).collect(),
            None => self.bodies.still.iter().chain(self.bodies.moving.iter().map(|body| &body.mesh)).collect(),
        }
    }

    /// Maps of everything at rest: the bodies and the garments that are dressed, in boxes of these bounds; `None` where there is nothing.
    pub(crate) fn draw_still_maps(
        &self,
        garments: &[Done],
        garment_bounds: &[[Vec3; 2]],
        recorder: &mut Recorder<'_>,
    ) -> Result<Option<Arc<BodyMaps>>, Error> {
        let meshes = self.dressing_meshes();
        let Some(map_box) = self.still_box(&meshes, garment_bounds) else { return Ok(None) };
        let dressed = self.pieces.iter().filter(|piece| piece.open.is_some());
        let area = meshes.iter().map(|mesh| mesh.area()).sum::<f64>() + inner_area(dressed, garments.len());
        let maps = BodyMaps::new(&self.kernels, &MapSpace::new(self.settings.maps, map_box, area))?;
        let surface = |mesh: &&Mesh| Surface::new(&self.device, mesh, map_box.texel);
        let mut surfaces: Vec<Surface> = meshes.iter().map(surface).collect();
        let thicknesses: Vec<f32> = self.pieces.iter().map(|piece| piece.step.thickness).collect();
        let ways = raised_ways(&thicknesses).into_iter().zip(&self.pieces);
        let ways = ways.filter(|(_, piece)| piece.open.is_some()).map(|(way, _)| way);
        let mut raisings = Vec::new();
        for (done, way) in garments.iter().zip(ways) {
            let frame = done.cloth.frame();
            let mut surface = frame.surface(&self.device);
            raisings.extend(raised(&self.kernels, &mut surface, frame.particle_count, way));
            surfaces.push(surface);
        }
        let thickness = self.thickness();
        let drawn: Vec<_> = surfaces.iter().map(|surface| (surface, thickness)).collect();
        recorder(Part::Maps, &mut |encoder| {
            raisings.iter().for_each(|raised| raised.record(encoder));
            maps.record(&self.device, encoder, map_box, &drawn);
        })?;
        Ok(Some(Arc::new(maps)))
    }

    /// The box of maps of surfaces at rest.
    fn still_box(&self, meshes: &[&Mesh], garment_bounds: &[[Vec3; 2]]) -> Option<MapBox> {
        let thickness = self.thickness();
        let bounds = meshes.iter().filter_map(|mesh| mesh.bounds()).chain(garment_bounds.iter().copied());
        let thick = bounds.map(|[low, high]| [low - thickness, high + thickness]);
        Some(MapBox::around(thick.reduce(around_both)?, self.settings.texel as f32))
    }

    /// Largest area of all cloths but the outermost [m²].
    fn under_all(&self) -> f64 {
        inner_area(self.pieces.iter(), self.pieces.len().saturating_sub(1))
    }

    /// That of the thickest cloth [m].
    fn thickness(&self) -> f32 {
        self.pieces.iter().map(|piece| piece.step.thickness).fold(0.0, f32::max)
    }

    /// Where the maps of the run stand, as its bodies decide it.
    pub(crate) fn boxes_of_all(&self) -> Result<Boxes, Error> {
        self.boxes_of(&self.bodies.moving, &bounds_of(&self.bodies.still))
    }

    fn boxes_of(&self, moving: &[MovingMesh], still: &[[Vec3; 2]]) -> Result<Boxes, Error> {
        Boxes::new(moving, still, self.settings.texel as f32, self.thickness(), self.pieces.len() > 1)
    }

    /// Begins what comes after the present phase: the way to the start of the motion, or the run.
    fn go_together(&mut self, recorder: &mut Recorder<'_>) -> Result<(), Error> {
        let begins = matches!(self.phase, Phase::Dressing(_));
        let stage = if begins && self.way.is_some() { Stage::Posing } else { Stage::Running };
        let mut garment_bounds = Vec::new();
        if let Phase::Dressing(dressed) = &mut self.phase
            && self.bodies.moving.is_empty()
            && self.pieces.len() > 1
        {
            // Maps of what nobody moves stand around where it hangs.
            let Some(known) = dressed.known_bounds(&self.device, recorder)? else { return Ok(()) };
            garment_bounds = known;
        }
        let mut outfit = self.outfit(stage, &garment_bounds)?;
        recorder(Part::Steps, &mut |encoder| match &self.phase {
            Phase::Dressing(dressed) => {
                // Garments begin at rest where they hang.
                let garments = self.pieces.iter().zip(outfit.cloths()).filter(|(piece, _)| piece.open.is_some());
                for ((_, cloth), done) in garments.zip(&dressed.done) {
                    let (from, to) = (&done.cloth.frame().positions, &cloth.frame().positions);
                    encoder.copy_buffer_to_buffer(from, 0, to, 0, from.size());
                }
            }
            Phase::Together { outfit: before, .. } => {
                for (from, to) in before.cloths().zip(outfit.cloths()) {
                    from.record_state(encoder, to);
                }
            }
        })?;
        // A renderer may draw them before the first step.
        recorder(Part::Steps, &mut |encoder| outfit.cloths().for_each(|cloth| cloth.record_normals(encoder)))?;
        if self.keeps_maps && stage == Stage::Running {
            outfit.keep_maps(&self.kernels, &self.bodies.moving[0], recorder)?;
        }
        self.clock = Clock::default();
        self.phase = Phase::Together { outfit: Box::new(outfit), stage, garment_bounds };
        Ok(())
    }

    /// All cloths together at the start of their models, on the way or in the run. Bodies that stand still have maps around them and around
    /// these boxes.
    pub(crate) fn outfit(&self, stage: Stage, garment_bounds: &[[Vec3; 2]]) -> Result<Outfit, Error> {
        let on_the_way = self.way.as_ref().filter(|_| stage == Stage::Posing);
        let bodies = match on_the_way {
            Some(way) => {
                // Where nothing moves otherwise, it is the way of the only mesh.
                let still = if self.bodies.moving.is_empty() { Vec::new() } else { self.bodies.still.clone() };
                Bodies { moving: vec![way.clone()], still, shapes: self.bodies.shapes.clone() }
            }
            None => self.bodies.clone(),
        };
        let mut still = bounds_of(&bodies.still);
        let boxes = match (on_the_way, &self.boxes) {
            (Some(_), _) => Some(self.boxes_of(&bodies.moving, &still)?),
            (None, Some(known)) => Some(known.clone()),
            (None, None) if self.pieces.len() > 1 => {
                still.extend(garment_bounds);
                still.extend(self.pieces.iter().filter(|piece| piece.open.is_none()).filter_map(Piece::reach));
                Some(self.boxes_of(&[], &still)?)
            }
            (None, None) => None,
        };
        let still_box = self.still_box(&bodies.still.iter().collect::<Vec<_>>(), &[]);
        let rate = self.settings.frame_rate;
        let first = self.pieces.first().map_or(1, |piece| piece.step.steps_per_frame);
        let laid = |piece| {
            let mut pins = Pins::held(pins_of(piece));
            if stage == Stage::Running {
                let index = self.pieces.iter().position(|other| std::ptr::eq(other, piece));
                index.into_iter().for_each(|index| pins.set(&self.control.pins[index]));
            }
            let step = self.step_together(piece, stage, first);
            Laid { model: &piece.model, step, is_worn: piece.open.is_some(), pins }
        };
        let cloths: Vec<Laid<'_>> = self.pieces.iter().map(laid).collect();
        let area = boxes.as_ref().map_or(0.0, Boxes::area)
            + bodies.still.iter().map(Mesh::area).sum::<f64>()
            + self.under_all();
        let maps = MapPlan { kind: self.settings.maps, boxes, still_box, area };
        Outfit::new(&self.kernels, &bodies, &cloths, maps, rate)
    }

    /// The numbers of a step of a piece once all go together, where a frame of the first has so many steps.
    pub(crate) fn step_together(&self, piece: &Piece, stage: Stage, first: u32) -> StepSettings {
        let step = if stage == Stage::Posing { piece.step.easing() } else { piece.step.clone() };
        step.in_parts(maps_per_frame(first, self.settings.frame_rate))
    }

    /// Has the maps of a whole round of the body drawn once, when the run begins, and copied from then on; how many bytes they take. D §7, W §6.
    ///
    /// # Errors
    /// [`Error::Round`] when the scene has not one moving body alone, or its motion does not end as it begins after a whole number of maps.
    ///
    /// # Panics
    /// When the run has begun.
    pub fn keep_maps(&mut self) -> Result<u64, Error> {
        let running = matches!(self.phase, Phase::Together { stage: Stage::Running, .. });
        assert!(!running, "maps are kept from the beginning of the run or not at all");
        let rate = self.settings.frame_rate;
        let first = self.pieces.first().map_or(1, |piece| piece.step.steps_per_frame);
        let interval = 1.0 / rate / f64::from(maps_per_frame(first, rate));
        let ([body], [], Some(boxes)) = (self.bodies.moving.as_slice(), self.bodies.still.as_slice(), &self.boxes)
        else {
            return Err(Error::Round { duration: 0.0, interval });
        };
        let Some(count) = maps_of_round(body, interval) else {
            return Err(Error::Round { duration: body.duration(), interval });
        };
        self.keeps_maps = true;
        let area = boxes.area() + self.under_all();
        let mut space = MapSpace::new(self.settings.maps, boxes.at(0.0, DVec3::ZERO), area);
        space.moving = true;
        Ok(u64::from(count) * space.bytes())
    }
}

/// Frames from the pose that garments are sewn in to the start of the motion.
fn way_frames(way: &MovingMesh, frame: f64) -> u64 {
    ((way.duration() + WAITING_SECONDS) / frame).ceil() as u64
}

/// Largest area of what lies under the outermost of some cloths [m²].
fn inner_area<'a>(pieces: impl Iterator<Item = &'a Piece>, count: usize) -> f64 {
    pieces.take(count).map(Piece::area_max).sum()
}

fn bounds_of(meshes: &[Mesh]) -> Vec<[Vec3; 2]> {
    meshes.iter().filter_map(Mesh::bounds).collect()
}
