//! A cloth being simulated, on the GPU or by the reference.

use crate::adapter::Gpu;
use crate::interrupt;
use anyhow::{Context, Result};
use glam::Vec3;
use std::collections::BTreeMap;
use std::sync::Arc;
use toile::gpu::{BodyMaps, Kernel, PassTime, Surface, Timer, readback};
use toile::model::{MapBox, Merge, Model, Status, StepSettings};
use toile::scene::{Mesh, Sphere};
use toile::{Cloth, Colliders};
use toile_reference::Reference;
use toile_reference::maps::{self as reference_maps, render_maps};

/// Steps that are timed pass by pass at the end of a run.
const TIMED_STEPS: u32 = 20;

/// What computes.
pub enum Computer {
    /// A device.
    Gpu(Gpu),
    /// The CPU reference.
    Reference,
}

/// A surface that the cloth collides with, and the thickness that lies on it [m].
pub struct Layer {
    /// The surface.
    pub mesh: Mesh,
    /// Thickness of what lies on it [m].
    pub thickness: f32,
}

/// A cloth being simulated.
pub enum Engine<'a> {
    /// On a device.
    Gpu {
        /// The device.
        gpu: &'a Gpu,
        /// The cloth.
        cloth: Box<Cloth>,
    },
    /// By the reference.
    Reference(Box<Reference>),
}

/// Positions, normals and contacts at the end.
pub struct State {
    /// Positions [m], shape [particle_count].
    pub positions: Vec<Vec3>,
    /// Unit normals, shape [particle_count].
    pub normals: Vec<Vec3>,
    /// Which particles are in contact by the maps, shape [particle_count]; empty without a body.
    pub touching: Vec<bool>,
}

impl Computer {
    /// Name for the metrics.
    pub fn name(&self) -> &str {
        match self {
            Computer::Gpu(gpu) => &gpu.name,
            Computer::Reference => "reference",
        }
    }

    /// A cloth at the start of its model.
    pub fn start(
        &self,
        model: &Model,
        settings: &StepSettings,
        layers: &[Layer],
        sphere: Option<Sphere>,
        texel: f32,
    ) -> Result<Engine<'_>> {
        match self {
            Computer::Gpu(gpu) => {
                let maps = if layers.is_empty() { None } else { Some(Arc::new(draw_maps(gpu, layers, texel)?)) };
                let cloth = Cloth::new(&gpu.device, model, settings, Colliders { maps, sphere })?;
                Ok(Engine::Gpu { gpu, cloth: Box::new(cloth) })
            }
            Computer::Reference => {
                let surfaces: Vec<_> = layers
                    .iter()
                    .map(|layer| reference_maps::Surface {
                        mesh: &layer.mesh,
                        thickness: layer.thickness,
                        velocities: None,
                    })
                    .collect();
                let maps = (!surfaces.is_empty()).then(|| render_maps(&surfaces, texel));
                let colliders = toile_reference::Colliders { maps, sphere };
                Ok(Engine::Reference(Box::new(Reference::new(model, settings, colliders))))
            }
        }
    }
}

/// The status of a cloth at the end of the frame that was waited for. One of an earlier frame, or none, would look like a calm cloth.
pub fn status(cloth: &mut Cloth) -> Result<Status> {
    let status = cloth.status()?.filter(|status| status.step == cloth.step());
    status.context("the device gave no status of the last frame: it may be lost")
}

fn draw_maps(gpu: &Gpu, layers: &[Layer], texel: f32) -> Result<BodyMaps> {
    let bounds = layers
        .iter()
        .filter_map(|layer| layer.mesh.bounds().map(|[low, high]| [low - layer.thickness, high + layer.thickness]))
        .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
        .unwrap_or_default();
    let map_box = MapBox::around(bounds, texel);
    let maps = BodyMaps::new(&gpu.device, map_box, false)?;
    let surfaces: Vec<_> = layers.iter().map(|l| (Surface::new(&gpu.device, &l.mesh), l.thickness)).collect();
    let drawn: Vec<_> = surfaces.iter().map(|(surface, thickness)| (surface, *thickness)).collect();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    maps.record(&gpu.device, &mut encoder, map_box, &drawn);
    gpu.queue.submit([encoder.finish()]);
    Ok(maps)
}

impl Engine<'_> {
    /// Does one frame and waits for it.
    pub fn frame(&mut self) -> Result<Status> {
        interrupt::check()?;
        match self {
            Engine::Gpu { gpu, cloth } => {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                cloth.record(&gpu.device, &mut encoder);
                gpu.queue.submit([encoder.finish()]);
                gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
                status(cloth)
            }
            Engine::Reference(reference) => {
                reference.frame();
                let status = reference.status();
                if let Some(particle) = status.first_non_finite {
                    return Err(
                        toile::Error::Diverged { step: status.step, particle, count: status.non_finite_count }.into()
                    );
                }
                Ok(status)
            }
        }
    }

    /// The same cloth with its seams merged.
    pub fn sewn(self, model: &Model, merge: &Merge, settings: &StepSettings) -> Result<Self> {
        match self {
            Engine::Gpu { gpu, cloth } => {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                let sewn = cloth.sewn(&gpu.device, &mut encoder, model, merge, settings)?;
                gpu.queue.submit([encoder.finish()]);
                Ok(Engine::Gpu { gpu, cloth: Box::new(sewn) })
            }
            Engine::Reference(reference) => Ok(Engine::Reference(Box::new(reference.sewn(model, settings, merge)))),
        }
    }

    /// Reads the state back.
    pub fn state(&self) -> Result<State> {
        match self {
            Engine::Gpu { gpu, cloth } => {
                let read = |buffer: &wgpu::Buffer| -> Result<Vec<Vec3>> {
                    let values = readback::read_vec4s(&gpu.device, &gpu.queue, buffer)?;
                    Ok(values.into_iter().map(|v| v.truncate()).collect())
                };
                let touching = match cloth.contacts() {
                    Some(buffer) => {
                        let words = readback::read_vec4s(&gpu.device, &gpu.queue, buffer)?;
                        words.chunks_exact(2).map(|contact| contact[0].w > 0.0).collect()
                    }
                    None => Vec::new(),
                };
                let frame = cloth.frame();
                Ok(State { positions: read(&frame.positions)?, normals: read(&frame.normals)?, touching })
            }
            Engine::Reference(reference) => Ok(State {
                positions: reference.positions().to_vec(),
                normals: reference.normals(),
                touching: reference.contacts().iter().map(|contact| contact.touching).collect(),
            }),
        }
    }

    /// The kernels of a step and the median of what each costs per step [ms]; empty by the reference.
    /// It goes on by a few steps, so call it last.
    pub fn pass_times(&mut self) -> Result<BTreeMap<String, PassTime>> {
        let Engine::Gpu { gpu, cloth } = self else { return Ok(BTreeMap::new()) };
        let timer = Timer::new(&gpu.device, &gpu.queue)?;
        let mut samples: BTreeMap<Kernel, Vec<PassTime>> = BTreeMap::new();
        for _ in 0..TIMED_STEPS {
            for (kernel, time) in cloth.time_step(&gpu.device, &gpu.queue, &timer)? {
                samples.entry(kernel).or_default().push(time);
            }
        }
        let median = |mut times: Vec<PassTime>| {
            times.sort_by(|a, b| a.milliseconds.total_cmp(&b.milliseconds));
            times[times.len() / 2]
        };
        Ok(samples.into_iter().map(|(kernel, times)| (kernel.name().to_owned(), median(times))).collect())
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        match self {
            Engine::Gpu { cloth, .. } => cloth.bytes(),
            Engine::Reference(_) => 0,
        }
    }
}
