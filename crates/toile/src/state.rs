//! The whole state of a simulation as bytes, from which it goes on bit for bit.

use crate::clock::Clock;
use crate::dressed::{Bounds, Done, Dressed};
use crate::fitting::Fitting;
use crate::outfit::Outfit;
use crate::pins::Pins;
use crate::simulation::{Phase, Simulation};
use crate::stage::Stage;
use crate::{Cloth, Colliders, Error};
use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};
#[cfg(feature = "native-wait")]
use toile_gpu::readback;
use toile_model::{Dressing, DressingStage, Motion, Piece, Status, digest_of};

/// What the bytes begin with; another layout has another number.
const MAGIC: &[u8] = b"toile state 6\n";

/// The whole state of a simulation.
#[derive(Debug, Serialize, Deserialize)]
struct State {
    pieces: Vec<Identity>,
    stage: SavedStage,
    asked_seconds: f64,
    done_parts: u64,
    /// Boxes around the garments when they were dressed, where the maps stand around them.
    garment_bounds: Vec<[[f32; 3]; 2]>,
    /// How far bodies that move stand from where their motion has them.
    place: [f64; 3],
    /// The middle of a body that the host skins, as it was seen last.
    middle: Option<[f32; 3]>,
    cloths: Vec<SavedCloth>,
}

/// Which cloth a state is of.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Identity {
    name: String,
    particle_count: u32,
    digest: u64,
    /// Whether its seams stayed open and it is worn as its open model.
    is_left_open: bool,
    /// By how much its limits are let out [1].
    let_out: Vec<f32>,
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum SavedStage {
    Dressing,
    Posing,
    Running,
}

#[derive(Debug, Serialize, Deserialize)]
struct SavedCloth {
    /// How far it is dressed; `None` once all go together.
    dressing: Option<SavedDressing>,
    step: u64,
    status: Option<Status>,
    /// Contents of the buffers that carry over from step to step, by name.
    buffers: Vec<(String, Vec<u32>)>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
struct SavedDressing {
    dressing: Dressing,
    /// The stage that the cloth has been handed over for.
    stage: DressingStage,
    /// The step of the last status that was heard.
    heard: Option<u64>,
    /// How the particles of a garment that is dressed moved at last [m/s].
    velocities: Vec<[f32; 3]>,
}

impl Simulation {
    /// The whole state as bytes: of garments that are being dressed, on the way or in the run. Waits for the device; what was recorded must
    /// have been submitted.
    ///
    /// # Errors
    /// [`Error::Gpu`] when the device is lost, [`Error::Diverged`] when a particle is not finite.
    #[cfg(feature = "native-wait")]
    pub fn save(&self, queue: &wgpu::Queue) -> Result<Vec<u8>, Error> {
        let save = |cloth: &Cloth, dressing: Option<SavedDressing>| -> Result<SavedCloth, Error> {
            let read = |(name, buffer): (&'static str, &wgpu::Buffer)| {
                let bytes = readback::read_buffer(&self.device, queue, buffer)?;
                Ok((name.to_owned(), bytemuck::pod_collect_to_vec(&bytes)))
            };
            Ok(SavedCloth {
                dressing,
                step: cloth.step(),
                buffers: cloth.state().map(read).collect::<Result<_, Error>>()?,
                status: cloth.status()?,
            })
        };
        let (stage, garment_bounds, cloths) = match &self.phase {
            Phase::Dressing(dressed) => {
                let done = dressed.done.iter().map(|Done { cloth, dressing, velocities, .. }| {
                    let (dressing, stage) = (dressing.clone(), DressingStage::Draping);
                    let velocities = velocities.iter().map(Vec3::to_array).collect();
                    (cloth, SavedDressing { dressing, stage, heard: Some(cloth.step()), velocities })
                });
                let fitting = dressed.fitting.iter().map(|Fitting { cloth, dressing, heard, stage, .. }| {
                    let (dressing, velocities) = (dressing.clone(), Vec::new());
                    (cloth, SavedDressing { dressing, stage: *stage, heard: *heard, velocities })
                });
                let cloths = done.chain(fitting).map(|(cloth, dressing)| save(cloth, Some(dressing)));
                (SavedStage::Dressing, Vec::new(), cloths.collect::<Result<_, _>>()?)
            }
            Phase::Together { outfit, stage, garment_bounds } => {
                let stage = if *stage == Stage::Running { SavedStage::Running } else { SavedStage::Posing };
                let bounds = garment_bounds.iter().map(|bounds| bounds.map(|corner| corner.to_array())).collect();
                (stage, bounds, outfit.cloths().map(|cloth| save(cloth, None)).collect::<Result<_, _>>()?)
            }
        };
        let state = State {
            pieces: self.pieces.iter().map(Identity::of).collect(),
            stage,
            asked_seconds: self.clock.asked(),
            done_parts: self.clock.done(),
            garment_bounds,
            place: self.place().to_array(),
            middle: match &self.phase {
                Phase::Dressing(_) => None,
                Phase::Together { outfit, .. } => outfit.middle().map(|middle| middle.to_array()),
            },
            cloths,
        };
        let body = postcard::to_stdvec(&state).map_err(|error| Error::State(error.to_string()))?;
        let mut bytes = MAGIC.to_vec();
        bytes.extend(digest_of(&body).to_le_bytes());
        bytes.extend(body);
        Ok(bytes)
    }

    /// Goes on from a state that [`Simulation::save`] gave of the same scene; whatever this simulation has done is forgotten. It submits what
    /// fills the buffers. After an error the simulation is as it was.
    ///
    /// # Errors
    /// [`Error::State`] when the bytes are damaged or of other cloths, which are named; [`Error::Gpu`] when what it needs does not fit the device.
    pub fn restore(&mut self, queue: &wgpu::Queue, bytes: &[u8]) -> Result<(), Error> {
        let state = decode(bytes)?;
        let mut pieces = self.pieces.clone();
        for (piece, saved) in pieces.iter_mut().zip(&state.pieces) {
            piece.leave_open(saved.is_left_open);
            piece.let_out(&saved.let_out);
        }
        let own: Vec<Identity> = pieces.iter().map(Identity::of).collect();
        for (saved, own) in state.pieces.iter().zip(&own) {
            if saved != own {
                let named =
                    |identity: &Identity| format!("{} with {} particles", identity.name, identity.particle_count);
                return Err(Error::State(format!(
                    "it is of {}, and the scene has {} of other numbers",
                    named(saved),
                    named(own)
                )));
            }
        }
        if state.pieces.len() != own.len() {
            return Err(Error::State(format!("it has {} cloths, and the scene has {}", state.pieces.len(), own.len())));
        }
        let before = std::mem::replace(&mut self.pieces, pieces);
        let phase = match state.stage {
            SavedStage::Dressing => self.restored_dressing(queue, &state),
            SavedStage::Posing => self.restored_together(queue, &state, Stage::Posing),
            SavedStage::Running => self.restored_together(queue, &state, Stage::Running),
        };
        self.phase = phase.inspect_err(|_| self.pieces = before)?;
        self.clock = Clock::new(state.asked_seconds, state.done_parts);
        Ok(())
    }

    fn restored_dressing(&self, queue: &wgpu::Queue, state: &State) -> Result<Phase, Error> {
        let mut dressed = Dressed::default();
        let garments = self.pieces.iter().filter(|piece| piece.open.is_some());
        for (piece, saved) in garments.zip(&state.cloths) {
            let SavedDressing { dressing, stage, heard, velocities } = saved.dressing.clone().ok_or_else(damaged)?;
            let inner: Option<Vec<_>> = dressed.done.iter().map(|done| done.bounds.known()).collect();
            let inner = inner.ok_or_else(damaged)?;
            let maps = self.draw_still_maps(&dressed.done, &inner, &mut |_, record| {
                submit(&self.device, queue, record);
                Ok(())
            })?;
            let model = piece.model_of(stage);
            let colliders = Colliders::new(maps, self.bodies.shapes.clone());
            let mut cloth = Cloth::new(&self.kernels, model, &piece.settings_of(stage), colliders)?;
            saved.write(queue, &mut cloth)?;
            // What the maps of the next garment draw.
            submit(&self.device, queue, &mut |encoder| cloth.record_normals(encoder));
            if dressing.stage() == DressingStage::Dressed {
                let bounds = Bounds::Known(saved.bounds().ok_or_else(damaged)?);
                let velocities = velocities.into_iter().map(Vec3::from_array).collect();
                dressed.done.push(Done { cloth, dressing, velocities, bounds });
            } else {
                // What was seen last are the positions that were saved.
                let motion = match stage {
                    DressingStage::Yielding | DressingStage::Draping => {
                        Motion::begin(saved.step, saved.positions().ok_or_else(damaged)?)
                    }
                    _ => Motion::default(),
                };
                dressed.fitting = Some(Fitting::go_on(cloth, dressing, heard, stage, motion));
            }
        }
        Ok(Phase::Dressing(Box::new(dressed)))
    }

    fn restored_together(&self, queue: &wgpu::Queue, state: &State, stage: Stage) -> Result<Phase, Error> {
        if state.cloths.len() != self.pieces.len() || (stage == Stage::Posing && self.way.is_none()) {
            return Err(damaged());
        }
        let bounds: Vec<[Vec3; 2]> = state.garment_bounds.iter().map(|bounds| bounds.map(Vec3::from_array)).collect();
        let mut outfit: Outfit = self.outfit(stage, &bounds)?;
        for (saved, cloth) in state.cloths.iter().zip(outfit.cloths_mut()) {
            saved.write(queue, cloth)?;
        }
        if stage == Stage::Running {
            outfit.know_pins(state.cloths.iter().map(SavedCloth::pins));
            outfit.set_pins(self.control.pins.iter());
            outfit.set_place(DVec3::from_array(state.place));
            if let Some(middle) = state.middle {
                outfit.stand_around(Vec3::from_array(middle));
            }
        }
        if self.keeps_maps && stage == Stage::Running {
            outfit.keep_maps(&self.kernels, &self.bodies.moving[0], &mut |_, record| {
                submit(&self.device, queue, record);
                Ok(())
            })?;
        }
        let frame = 1.0 / self.settings.frame_rate;
        let per_part = if stage == Stage::Running { 1 } else { (frame / outfit.part_seconds()).round() as u64 };
        outfit.resume(state.done_parts * per_part);
        Ok(Phase::Together { outfit: Box::new(outfit), stage, garment_bounds: bounds })
    }
}

/// Submits what is recorded.
fn submit(device: &wgpu::Device, queue: &wgpu::Queue, record: &mut dyn FnMut(&mut wgpu::CommandEncoder)) {
    let mut encoder = device.create_command_encoder(&Default::default());
    record(&mut encoder);
    queue.submit([encoder.finish()]);
}

fn damaged() -> Error {
    Error::State("it is damaged".to_owned())
}

fn decode(bytes: &[u8]) -> Result<State, Error> {
    let rest =
        bytes.strip_prefix(MAGIC).ok_or_else(|| Error::State("it is none of this version of toile".to_owned()))?;
    let (digest, body) = rest.split_first_chunk::<8>().ok_or_else(damaged)?;
    if digest_of(body).to_le_bytes() != *digest {
        return Err(damaged());
    }
    postcard::from_bytes(body).map_err(|_| damaged())
}

impl Identity {
    fn of(piece: &Piece) -> Self {
        let numbers = format!("{:?}", piece.step);
        let digest = piece.model.digest() ^ digest_of(numbers.as_bytes());
        Self {
            name: piece.name.clone(),
            particle_count: piece.model.particle_count(),
            digest,
            is_left_open: piece.is_left_open(),
            let_out: piece.room().to_vec(),
        }
    }
}

impl SavedCloth {
    /// Writes the state into the buffers of a fresh cloth.
    fn write(&self, queue: &wgpu::Queue, cloth: &mut Cloth) -> Result<(), Error> {
        for (name, buffer) in cloth.state() {
            let Some((_, words)) = self.buffers.iter().find(|(known, _)| known == name) else { return Err(damaged()) };
            if 4 * words.len() as u64 != buffer.size() {
                return Err(damaged());
            }
            queue.write_buffer(buffer, 0, bytemuck::cast_slice(words));
        }
        cloth.resume(self.step, self.status);
        Ok(())
    }

    /// Positions of its particles [m], shape [particle_count].
    fn positions(&self) -> Option<Vec<Vec3>> {
        let (_, words) = self.buffers.iter().find(|(name, _)| name == "positions")?;
        let position = |p: &[u32]| Vec3::from_array([p[0], p[1], p[2]].map(f32::from_bits));
        Some(words.chunks_exact(4).map(position).collect())
    }

    /// Its particles that are held, where they are.
    fn pins(&self) -> Pins {
        let words = self.buffers.iter().find(|(name, _)| name == "positions").map(|(_, words)| words.as_slice());
        let particles = (0..).zip(words.unwrap_or_default().chunks_exact(4));
        let held = particles.filter(|(_, particle)| f32::from_bits(particle[3]) == 0.0);
        Pins::held(held.map(|(i, p)| (i, Vec3::from_array([p[0], p[1], p[2]].map(f32::from_bits)).as_dvec3())))
    }

    /// The box around its particles.
    fn bounds(&self) -> Option<[Vec3; 2]> {
        let positions = self.positions()?;
        let corner = |pick: fn(Vec3, Vec3) -> Vec3| positions.iter().copied().reduce(pick);
        Some([corner(Vec3::min)?, corner(Vec3::max)?])
    }
}
