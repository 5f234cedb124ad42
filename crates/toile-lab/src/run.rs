//! A cloth on the device of a lab: frame by frame, read back, and what its step costs.

use crate::{Lab, LabError};
use glam::{DVec3, Vec3, Vec4};
use std::collections::BTreeMap;
use toile::gpu::{Timer, readback};
use toile::model::{Model, Status, StepSettings};
use toile::scene::{Settings, Sheet};
use toile::{Cloth, Colliders};
use wgpu::util::DeviceExt;

/// A cloth on the device of a lab.
#[derive(Debug)]
pub struct Run {
    /// The cloth.
    pub model: Model,
    /// The numbers of its step.
    pub step: StepSettings,
    /// The simulation.
    pub cloth: Cloth,
    diverged: bool,
}

/// What one step costs.
#[derive(Clone, Debug, PartialEq)]
pub struct StepCost {
    /// Name, dispatches per step and time [ms] of each kernel, in the order of the algorithm.
    pub kernels: Vec<(&'static str, u32, f64)>,
    /// Time of a copy of the whole state [ms]; 0 when the clock was too coarse for it.
    pub state_copy: f64,
}

impl Run {
    /// A cloth at the start of its model.
    ///
    /// # Errors
    /// [`LabError::Toile`] when it does not fit the device.
    pub fn new(lab: &Lab, model: Model, step: StepSettings, colliders: Colliders) -> Result<Self, LabError> {
        let cloth = Cloth::new(&lab.device, &model, &step, colliders)?;
        Ok(Self { model, step, cloth, diverged: false })
    }

    /// A sheet under the settings of its scene.
    ///
    /// # Errors
    /// [`LabError::Toile`] when it does not fit the device.
    pub fn sheet(lab: &Lab, sheet: &Sheet, settings: &Settings, colliders: Colliders) -> Result<Self, LabError> {
        let model = Model::from_sheet(sheet, settings);
        let step = StepSettings::new(settings, &model);
        Self::new(lab, model, step, colliders)
    }

    /// Does a frame and waits for it; `None` once the run has diverged.
    ///
    /// # Errors
    /// [`LabError::Toile`] when the device is lost.
    pub fn frame(&mut self, lab: &Lab) -> Result<Option<Status>, LabError> {
        if self.diverged {
            return Ok(None);
        }
        let mut encoder = lab.device.create_command_encoder(&Default::default());
        self.cloth.record(&lab.device, &mut encoder);
        self.finish(lab, encoder)
    }

    /// Does some steps and waits for them; `None` once the run has diverged.
    ///
    /// # Errors
    /// [`LabError::Toile`] when the device is lost.
    pub fn steps(&mut self, lab: &Lab, count: u32) -> Result<Option<Status>, LabError> {
        if self.diverged {
            return Ok(None);
        }
        let mut encoder = lab.device.create_command_encoder(&Default::default());
        let mut left = count;
        while left > 0 {
            let part = left.min(self.step.steps_per_frame);
            self.cloth.record_steps(&lab.device, &mut encoder, 0..part, part);
            left -= part;
        }
        self.cloth.record_outputs(&mut encoder);
        self.finish(lab, encoder)
    }

    fn finish(&mut self, lab: &Lab, encoder: wgpu::CommandEncoder) -> Result<Option<Status>, LabError> {
        lab.queue.submit([encoder.finish()]);
        lab.wait()?;
        loop {
            match self.cloth.status() {
                Ok(Some(status)) if status.step == self.cloth.step() => return Ok(Some(status)),
                // Another thread that polls the same device may still have the answer in its hands.
                Ok(_) => lab.wait()?,
                Err(toile::Error::Diverged { .. }) => {
                    self.diverged = true;
                    return Ok(None);
                }
                Err(error) => return Err(error.into()),
            }
            std::thread::yield_now();
        }
    }

    /// Whether a particle was not finite, or faster than 1 km/s, at the end of any frame.
    pub fn diverged(&self) -> bool {
        self.diverged
    }

    /// Simulated time [s].
    pub fn time(&self) -> f64 {
        self.cloth.step() as f64 * f64::from(self.step.dt)
    }

    /// Positions [m], shape [particle_count].
    ///
    /// # Errors
    /// [`LabError::Toile`] when the device is lost.
    pub fn positions(&self, lab: &Lab) -> Result<Vec<DVec3>, LabError> {
        lab.read(&self.cloth.frame().positions)
    }

    /// Velocities [m/s], shape [particle_count].
    ///
    /// # Errors
    /// [`LabError::Toile`] when the device is lost.
    pub fn velocities(&self, lab: &Lab) -> Result<Vec<DVec3>, LabError> {
        lab.read(self.cloth.velocities())
    }

    /// Elongations of all structural and shear springs [1], sorted; infinite ones in a run that has diverged.
    ///
    /// # Errors
    /// [`LabError::Toile`] when the device is lost.
    pub fn elongations(&self, lab: &Lab) -> Result<Vec<f64>, LabError> {
        let positions = self.positions(lab)?;
        let mut elongations: Vec<f64> = self
            .model
            .limits
            .iter()
            .map(|limit| {
                let [a, b] = limit.ends.map(|end| positions[end as usize]);
                let elongation = a.distance(b) / f64::from(limit.rest_length) - 1.0;
                if self.diverged || elongation.is_nan() { f64::INFINITY } else { elongation }
            })
            .collect();
        elongations.sort_by(f64::total_cmp);
        Ok(elongations)
    }

    /// What a step costs; see [`StepCost::of`].
    ///
    /// # Errors
    /// [`LabError::Toile`] when the device is lost.
    pub fn cost(&mut self, lab: &Lab, steps: usize) -> Result<StepCost, LabError> {
        Ok(StepCost::of(&lab.device, &lab.queue, &mut self.cloth, steps)?)
    }
}

impl StepCost {
    /// The least cost of each kernel over some steps of a simulation, after one that warms up: what else the machine does only ever adds. The
    /// simulation goes on by these steps, so measure last.
    ///
    /// # Errors
    /// [`toile::Error::Gpu`] when the device is lost.
    pub fn of(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        cloth: &mut Cloth,
        steps: usize,
    ) -> Result<Self, toile::Error> {
        let timer = Timer::new(device, queue)?;
        let mut least = BTreeMap::new();
        let mut dispatches = BTreeMap::new();
        for step in 0..=steps {
            for (kernel, time) in cloth.time_step(device, queue, &timer)? {
                dispatches.insert(kernel, time.dispatches);
                if step > 0 {
                    let least: &mut f64 = least.entry(kernel).or_insert(f64::INFINITY);
                    *least = least.min(time.milliseconds);
                }
            }
        }
        let all = least.into_iter().map(|(kernel, milliseconds)| (kernel.name(), dispatches[&kernel], milliseconds));
        let (copies, kernels): (Vec<_>, Vec<_>) = all.partition(|(name, ..)| *name == "state_copy");
        Ok(Self { kernels, state_copy: copies.first().map_or(0.0, |(.., milliseconds)| *milliseconds) })
    }

    /// Time of a step [ms]; 0 when the clock was too coarse for any of its kernels.
    pub fn milliseconds(&self) -> f64 {
        self.kernels.iter().map(|(_, _, milliseconds)| milliseconds).sum()
    }

    /// Cost of a step [state copies]; `None` when the clock was too coarse for it or for a copy.
    pub fn copies(&self) -> Option<f64> {
        self.in_copies(self.milliseconds())
    }

    /// A time [ms] in state copies; `None` when the clock was too coarse for it or for a copy.
    pub fn in_copies(&self, milliseconds: f64) -> Option<f64> {
        (milliseconds > 0.0 && self.state_copy > 0.0).then(|| milliseconds / self.state_copy)
    }
}

impl Lab {
    /// Reads the xyz of a buffer of vec4 back.
    ///
    /// # Errors
    /// [`LabError::Toile`] when the device is lost.
    pub fn read(&self, buffer: &wgpu::Buffer) -> Result<Vec<DVec3>, LabError> {
        let values = readback::read_vec4s(&self.device, &self.queue, buffer)?;
        Ok(values.into_iter().map(|value| value.truncate().as_dvec3()).collect())
    }

    /// A buffer of vertices with these vectors, vec4 each.
    pub fn vertex_buffer(&self, vectors: &[Vec3]) -> wgpu::Buffer {
        let contents: Vec<Vec4> = vectors.iter().map(|vector| vector.extend(0.0)).collect();
        self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("vertices"),
            contents: bytemuck::cast_slice(&contents),
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE,
        })
    }

    /// Waits until the device has done what was submitted.
    ///
    /// # Errors
    /// [`LabError::Toile`] when the device is lost.
    pub fn wait(&self) -> Result<(), LabError> {
        let lost = |error: wgpu::PollError| toile::gpu::GpuError::Device(error.to_string());
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(lost)?;
        Ok(())
    }
}
