//! One cloth, simulated on the caller's device.

use crate::{Error, Frame, Strain};
#[cfg(feature = "native-wait")]
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use toile_gpu::{BodyMaps, Kernels, Mark, Plan, Solver};
#[cfg(feature = "native-wait")]
use toile_gpu::{Kernel, PassTime, Timer};
use toile_model::{Merge, Model, ModelError, PinTarget, Status, StepSettings};
use toile_scene::Shape;

/// What a cloth collides with.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Colliders {
    /// Mesh bodies and inner garments, as maps.
    pub maps: Option<Arc<BodyMaps>>,
    /// Analytic shapes; their order does not matter.
    pub shapes: Vec<Shape>,
}

impl Colliders {
    /// Maps, shapes, or both.
    pub fn new(maps: Option<Arc<BodyMaps>>, shapes: Vec<Shape>) -> Self {
        Self { maps, shapes }
    }
}

/// One cloth, simulated on the caller's device.
///
/// ```no_run
/// # fn host(device: &wgpu::Device, queue: &wgpu::Queue, sheet: &toile::scene::Sheet, settings: &toile::scene::Settings)
/// # -> Result<(), toile::Error> {
/// use toile::model::{Model, StepSettings};
///
/// let model = Model::from_sheet(sheet, settings);
/// let step = StepSettings::new(settings, &model);
/// let mut cloth = toile::Cloth::new(device, &model, &step, Default::default())?;
/// for _ in 0..60 {
///     let mut encoder = device.create_command_encoder(&Default::default());
///     cloth.record(device, &mut encoder);
///     // Draw cloth.frame() with the same encoder, then:
///     queue.submit([encoder.finish()]);
///     cloth.status()?;
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Cloth {
    solver: Solver,
    frame: Frame,
}

impl Cloth {
    /// A cloth at the start of its model; `kernels` is a device, or what other cloths on it use: their pipelines, and the buffers of equal models.
    ///
    /// # Errors
    /// [`Error::Model`] when a number of the step or of a shape is out of its range, or the step is none of this model's: see
    /// [`StepSettings::check_with`](toile_model::StepSettings::check_with). [`Error::Gpu`] when the model does not fit the device, or the device has
    /// less than the default limits of WebGPU.
    pub fn new(
        kernels: impl Into<Kernels>,
        model: &Model,
        settings: &StepSettings,
        colliders: Colliders,
    ) -> Result<Self, Error> {
        let kernels = kernels.into();
        settings.check_with(model)?;
        colliders.shapes.iter().try_for_each(Shape::check).map_err(ModelError::from)?;
        let solver = Solver::new(&kernels, model, settings, colliders.maps, colliders.shapes)?;
        let indices = solver.indices().clone();
        let frame = Frame {
            positions: solver.positions().clone(),
            normals: solver.normals().clone(),
            index_count: (indices.size() / size_of::<u32>() as u64) as u32,
            indices,
            particle_count: model.particle_count(),
        };
        Ok(Self { solver, frame })
    }

    /// Records one frame into the caller's encoder: its steps, then normals and status. What is recorded counts as done, so an encoder that
    /// is dropped loses its frame.
    pub fn record(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) {
        self.solver.record_frame(device, encoder);
    }

    /// Records the handover to the sewn model: joined particles become one, with their momentum; then its normals and status.
    ///
    /// # Errors
    /// [`Error::Gpu`] when the sewn model does not fit the device.
    pub fn sewn(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        model: &Model,
        merge: &Merge,
        settings: &StepSettings,
    ) -> Result<Self, Error> {
        let colliders = Colliders::new(self.solver.maps().cloned(), self.solver.shapes().to_vec());
        let mut sewn = Self::new(self.solver.kernels(), model, settings, colliders)?;
        sewn.solver.record_merge(device, encoder, &self.solver, merge);
        sewn.solver.record_outputs(encoder);
        Ok(sewn)
    }

    /// Records steps of an interval of `interval` steps, at whose end the maps of moving bodies show them: a host may stop within an
    /// interval and go on later.
    ///
    /// # Panics
    /// When the steps do not lie in the interval, or the interval is longer than a frame.
    pub fn record_steps(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        steps: Range<u32>,
        interval: u32,
    ) {
        self.solver.record_steps(device, encoder, steps, interval);
    }

    /// Records that the cloth is carried by a rigid transform, with its velocities and what it touched, as if it had always been there: for hosts
    /// that set what they dress elsewhere at once. A [`Simulation`](crate::Simulation) does so by itself where its body jumps.
    pub fn record_carry(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, carry: glam::DMat4) {
        self.solver.record_carry(device, encoder, carry);
    }

    /// Whether it has the passes for these numbers of a step, and room for so many shapes.
    pub(crate) fn has_passes_of(&self, settings: &StepSettings, shape_count: usize) -> bool {
        self.solver.has_passes_of(settings, shape_count)
    }

    /// Records other numbers of a step, of which gravity, wind, damping, friction and reflection may change: they hold for what is recorded from now on.
    /// [`StepSettings::with_numbers_of`] makes them.
    ///
    /// # Panics
    /// When a number is out of its range, anything else changes, or a cloth without air or pressure would get it: passes of a step stay as they are.
    pub fn record_settings(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        settings: &StepSettings,
    ) {
        settings.check().unwrap_or_else(|error| panic!("{error}"));
        self.solver.record_settings(device, encoder, settings);
    }

    /// Takes other numbers of springs and limits: stiffness, rigidity and threshold, from a model of the same cloth. They hold for what is
    /// recorded from now on. Cloths that share the buffers of the model before keep them.
    ///
    /// # Panics
    /// When the model is one of another cloth.
    pub fn set_model(&mut self, model: &Model) {
        self.solver.set_model(model);
    }

    /// Records that the host holds particles, moves them or lets them go, each named once. One that moves keeps the velocity that it gets, so
    /// tell it to stand still once its time is up. One that is held only now is held by the limits; pins of a sheet hold from afar, too.
    ///
    /// # Panics
    /// When a particle does not exist.
    pub fn record_pins(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, pins: &[PinTarget]) {
        self.solver.record_pins(device, encoder, pins);
    }

    /// Has other shapes from the next step on, as many as before. Each moves on the clock of the cloth: its steps so far, times their length.
    ///
    /// # Panics
    /// When there are more shapes than before, or fewer, or a number of one is out of its range.
    pub fn set_shapes(&mut self, shapes: Vec<Shape>) {
        shapes.iter().try_for_each(Shape::check).unwrap_or_else(|error| panic!("{error}"));
        self.solver.set_shapes(shapes);
    }

    /// Records a copy of the state on the device, to which [`Cloth::record_reset`] goes back.
    pub fn record_mark(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) -> Mark {
        self.solver.record_mark(device, encoder)
    }

    /// Records that the cloth goes on from a mark of its own.
    ///
    /// # Panics
    /// When the mark is that of another cloth.
    pub fn record_reset(&mut self, encoder: &mut wgpu::CommandEncoder, mark: &Mark) {
        self.solver.record_reset(encoder, mark);
    }

    /// Records that a cloth of the same model takes the state of this one.
    pub(crate) fn record_state(&self, encoder: &mut wgpu::CommandEncoder, to: &Cloth) {
        for (name, from) in self.solver.state() {
            if let Some((_, to)) = to.solver.state().find(|(known, _)| *known == name) {
                encoder.copy_buffer_to_buffer(from, 0, to, 0, from.size());
            }
        }
    }

    /// The buffers whose contents carry over from step to step, by name.
    pub(crate) fn state(&self) -> impl Iterator<Item = (&'static str, &wgpu::Buffer)> {
        self.solver.state()
    }

    /// Goes on from a state that was written into these buffers.
    pub(crate) fn resume(&mut self, step: u64, status: Option<Status>) {
        self.solver.resume(step, status);
    }

    /// Records normals and status, as the end of a frame whose steps were recorded one by one.
    pub fn record_outputs(&mut self, encoder: &mut wgpu::CommandEncoder) {
        self.solver.record_outputs(encoder);
    }

    /// Records the normals of the present state alone: for hosts that draw the cloth within a frame.
    pub fn record_normals(&self, encoder: &mut wgpu::CommandEncoder) {
        self.solver.record_normals(encoder);
    }

    /// Velocities [m/s] and masses [kg] of the particles, vec4 each; usage `VERTEX | STORAGE | COPY_SRC | COPY_DST`.
    pub fn velocities(&self) -> &wgpu::Buffer {
        self.solver.velocities()
    }

    /// The numbers of a step.
    pub fn settings(&self) -> &StepSettings {
        self.solver.settings()
    }

    /// Buffers for a renderer.
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    /// The newest status that has arrived, without waiting; `None` before the first frame is done.
    ///
    /// # Errors
    /// [`Error::Diverged`] when a particle is not finite.
    pub fn status(&self) -> Result<Option<Status>, Error> {
        let status = self.solver.status();
        if let Some(Status { step, non_finite_count: count, first_non_finite: Some(particle), .. }) = status {
            return Err(Error::Diverged { step, particle, count });
        }
        Ok(status)
    }

    /// How far the cloth was stretched at the end of the newest frame whose status has arrived, without waiting; `None` before the
    /// first frame is done.
    ///
    /// # Errors
    /// [`Error::Diverged`] when a particle is not finite.
    pub fn strain(&self) -> Result<Option<Strain>, Error> {
        Ok(self.status()?.map(|status| Strain {
            step: status.step,
            elongation_max: status.elongation_max,
            longest_limit: status.longest_limit,
            over_long_count: status.over_long_count,
            further_sweeps: status.further_sweeps,
            missed_steps: status.missed_steps,
        }))
    }

    /// Does one step pass by pass and says what each kernel cost, beside a copy of the whole state: the unit in which costs are
    /// told. For measuring only: it submits, and waits after every dispatch.
    ///
    /// # Errors
    /// [`Error::Gpu`] when the device is lost.
    #[cfg(feature = "native-wait")]
    pub fn time_step(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        timer: &Timer,
    ) -> Result<BTreeMap<Kernel, PassTime>, Error> {
        Ok(self.solver.time_step(device, queue, timer)?)
    }

    /// The passes of a step and of a frame.
    pub fn plan(&self) -> &Plan {
        self.solver.plan()
    }

    /// What each particle touched in the last step: normal and 1 or 0 (vec4), velocity of the body (vec4); `None` without a body.
    pub fn contacts(&self) -> Option<&wgpu::Buffer> {
        self.solver.contacts()
    }

    /// What limits gave each particle in the last step [m/s], vec4 each, xyz used; `None` unless the rule is
    /// [`Rule::Predictive`](toile_scene::Rule::Predictive) or [`Rule::Hierarchical`](toile_scene::Rule::Hierarchical).
    pub fn pulls(&self) -> Option<&wgpu::Buffer> {
        self.solver.pulls()
    }

    /// The maps of what it collides with; `None` without any.
    pub fn maps(&self) -> Option<&BodyMaps> {
        self.solver.maps().map(Arc::as_ref)
    }

    /// Steps recorded so far.
    pub fn step(&self) -> u64 {
        self.solver.step()
    }

    /// Bytes on the device: all buffers, those that it shares too, and the maps of the bodies.
    pub fn bytes(&self) -> u64 {
        self.solver.bytes() + self.map_bytes()
    }

    /// Bytes on the device but those of the buffers that it shares; [`Kernels::shared_bytes`] has these, once for all cloths.
    pub fn own_bytes(&self) -> u64 {
        self.solver.own_bytes() + self.map_bytes()
    }

    /// The buffers that it shares with cloths that have the same contents.
    pub(crate) fn shared(&self) -> impl Iterator<Item = &wgpu::Buffer> {
        self.solver.shared()
    }

    fn map_bytes(&self) -> u64 {
        self.maps().map_or(0, BodyMaps::bytes)
    }
}
