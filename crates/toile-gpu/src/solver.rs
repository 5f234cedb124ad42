//! The solver: records the passes of a plan.

use crate::buffers::{Buffers, Start, aligned, shape_entry};
use crate::contents::{encoded, uniform};
use crate::limits::check_limits;
use crate::status::StatusReader;
use crate::step_params::{Counts, step_params};
#[cfg(feature = "native-wait")]
use crate::timing::{PassTime, Timer};
use crate::{BodyMaps, GpuError, Kernels, Maps, Pass, Plan, Program};
use glam::DMat4;
#[cfg(feature = "native-wait")]
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use toile_kernels::{Kernel, Role, structs};
use toile_model::{Merge, Model, PinTarget, Status, StepSettings};
use toile_scene::Shape;
use wgpu::util::DeviceExt;

/// Bytes from one entry of the dispatches to the next: three words for the dispatch, and one that fills the vec4.
const DISPATCH_STRIDE: u64 = 16;

/// One cloth on a device.
#[derive(Debug)]
pub struct Solver {
    settings: StepSettings,
    plan: Plan,
    buffers: Buffers,
    /// Triangles to draw: no kernel of a step reads them.
    indices: Arc<wgpu::Buffer>,
    bound: Vec<BoundProgram>,
    step_dispatches: Vec<Dispatch>,
    frame_dispatches: Vec<Dispatch>,
    shapes: Vec<Shape>,
    /// Whether the device has still to hear of them; of those that move it hears in every step.
    shapes_are_new: bool,
    counts: Counts,
    maps: Option<Arc<BodyMaps>>,
    status: StatusReader,
    step: u64,
    kernels: Kernels,
}

/// Where a step stands, for the uniforms that change with it.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    /// Among the steps that are recorded together.
    recorded: u32,
    /// Steps that follow it in the interval of the maps.
    left: u32,
}

/// A pipeline and what is bound to it.
#[derive(Debug)]
struct BoundProgram {
    kernel: Kernel,
    program: Program,
    group: wgpu::BindGroup,
}

/// A pass of the plan as it is recorded: everything about it is resolved.
#[derive(Clone, Copy, Debug)]
struct Dispatch {
    /// Its place among the bound programs.
    bound: usize,
    offset: Offset,
    work: Work,
}

/// The dynamic offset of a dispatch.
#[derive(Clone, Copy, Debug)]
enum Offset {
    None,
    Fixed(u32),
    /// So many bytes for each of the steps that are left in the interval of the maps.
    PerStepLeft(u32),
    /// So many bytes for each step that was recorded before it with the same shapes.
    PerStep(u32),
}

/// How many workgroups a dispatch has.
#[derive(Clone, Copy, Debug)]
enum Work {
    Direct([u32; 2]),
    /// What a kernel wrote at so many bytes of its dispatches.
    Indirect(u64),
}

impl Solver {
    /// Builds the buffers that the model needs, and those pipelines that nobody has made before; `kernels` is a device, or what others on it use.
    /// The cloth collides with mesh bodies and inner garments, as `maps`, and with `shapes`, whose order does not matter.
    ///
    /// # Errors
    /// [`GpuError::BufferTooLarge`] when the model does not fit the device, [`GpuError::LimitTooLow`] when the kernels do not.
    ///
    /// # Panics
    /// As [`Plan::new`].
    pub fn new(
        kernels: impl Into<Kernels>,
        model: &Model,
        settings: &StepSettings,
        maps: Option<Arc<BodyMaps>>,
        shapes: Vec<Shape>,
    ) -> Result<Self, GpuError> {
        let kernels = kernels.into();
        let device = kernels.device();
        check_limits(device)?;
        let kind = maps.as_ref().map_or(Maps::None, |maps| Maps::of(maps.space().kind, maps.is_moving()));
        let plan = Plan::new(model, settings, kind, !shapes.is_empty());
        let programs: Vec<_> = plan.kernels().into_iter().map(|kernel| (kernel, kernels.program(kernel))).collect();
        let bindings = programs.iter().flat_map(|(_, program)| &program.interface().bindings);
        let start = Start { model, settings, plan: &plan, shapes: &shapes, after_maps: maps.is_some() };
        let buffers = Buffers::new(&kernels, start, bindings)?;
        let bound = |(kernel, program): (Kernel, Program)| {
            let group = bind(device, &program, &buffers, maps.as_deref());
            BoundProgram { kernel, program, group }
        };
        let bound: Vec<_> = programs.into_iter().map(bound).collect();
        let triangles = model.triangles();
        let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let resolved = |passes: &[Pass]| passes.iter().map(|pass| Dispatch::of(pass, &bound, &buffers)).collect();
        Ok(Self {
            settings: settings.clone(),
            step_dispatches: resolved(&plan.step),
            frame_dispatches: resolved(&plan.frame),
            plan,
            indices: kernels.constant("indices", bytemuck::cast_slice(&triangles), usage),
            bound,
            shapes,
            shapes_are_new: false,
            counts: Counts::of(model),
            maps,
            status: StatusReader::new(device),
            step: 0,
            buffers,
            kernels,
        })
    }

    /// Records one frame: its steps, then normals and status.
    pub fn record_frame(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) {
        let steps = self.settings.steps_per_frame;
        self.record_steps(device, encoder, 0..steps, steps);
        self.record_outputs(encoder);
    }

    /// Records steps of an interval of `interval` steps, at whose end the maps of moving bodies show them: a host may stop within an interval and go on
    /// later, with the same bits.
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
        let most = self.settings.steps_per_frame;
        assert!(interval <= most, "an interval of {interval} steps is longer than a frame, which has {most}");
        assert!(steps.start <= steps.end && steps.end <= interval, "steps {steps:?} of an interval of {interval}");
        let count = steps.end - steps.start;
        self.record_shapes(device, encoder, count);
        let mut compute = encoder.begin_compute_pass(&labelled("steps of a cloth"));
        let mut last = usize::MAX;
        for index in 0..count {
            let place = Place { recorded: index, left: interval - steps.start - index - 1 };
            for dispatch in &self.step_dispatches {
                self.dispatch(&mut compute, dispatch, place, &mut last);
            }
        }
        self.step += steps.len() as u64;
    }

    /// The buffers whose contents carry over from step to step, and their names: all that a saved simulation needs. Usage `COPY_SRC` and `COPY_DST`.
    pub fn state(&self) -> impl Iterator<Item = (&'static str, &wgpu::Buffer)> {
        self.buffers.of(Role::State)
    }

    /// Records normals and status of the present state.
    pub fn record_outputs(&mut self, encoder: &mut wgpu::CommandEncoder) {
        let status = self.buffers.get("status");
        encoder.clear_buffer(status, 0, None);
        self.record_of_frame(encoder, |_| true);
        self.status.record(encoder, status, self.buffers.find("polish_state"), self.step);
    }

    /// Records the normals of the present state alone: for maps that are drawn of a cloth within a frame.
    pub fn record_normals(&self, encoder: &mut wgpu::CommandEncoder) {
        self.record_of_frame(encoder, |kernel| kernel == Kernel::ParticleNormals);
    }

    /// Records passes of a frame.
    fn record_of_frame(&self, encoder: &mut wgpu::CommandEncoder, wanted: impl Fn(Kernel) -> bool) {
        let mut compute = encoder.begin_compute_pass(&labelled("outputs of a cloth"));
        let mut last = usize::MAX;
        for dispatch in self.frame_dispatches.iter().filter(|dispatch| wanted(self.bound[dispatch.bound].kernel)) {
            self.dispatch(&mut compute, dispatch, Place::default(), &mut last);
        }
    }

    /// Does one step pass by pass and says what each kernel cost, beside a state copy: the unit in which costs are told. For
    /// measuring only: it submits, and waits after every dispatch.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    #[cfg(feature = "native-wait")]
    pub fn time_step(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        timer: &Timer,
    ) -> Result<BTreeMap<Kernel, PassTime>, GpuError> {
        let mut encoder = device.create_command_encoder(&Default::default());
        self.record_shapes(device, &mut encoder, 1);
        queue.submit([encoder.finish()]);
        let mut times: BTreeMap<Kernel, PassTime> = BTreeMap::new();
        for dispatch in &self.step_dispatches {
            let time = times.entry(self.bound[dispatch.bound].kernel).or_default();
            time.milliseconds += timer.milliseconds(device, queue, |compute| {
                self.dispatch(compute, dispatch, Place::default(), &mut { usize::MAX });
            })?;
            time.dispatches += 1;
        }
        let milliseconds = self.time_state_copy(device, queue, timer)?;
        times.insert(Kernel::StateCopy, PassTime { dispatches: 1, milliseconds });
        self.step += 1;
        Ok(times)
    }

    /// Time of a copy of the whole state [ms].
    #[cfg(feature = "native-wait")]
    fn time_state_copy(&self, device: &wgpu::Device, queue: &wgpu::Queue, timer: &Timer) -> Result<f64, GpuError> {
        let program = self.kernels.program(Kernel::StateCopy);
        let copies = ["position_copies", "velocity_copies"].map(|label| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: self.buffers.get("positions").size(),
                usage: wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        });
        let group = program.bind(device, |binding| {
            match binding.name.as_str() {
                "position_copies" => &copies[0],
                "velocity_copies" => &copies[1],
                name => self.buffers.get(name),
            }
            .as_entire_binding()
        });
        let [x, y] = Pass::over(Kernel::StateCopy, self.counts.particles).workgroups();
        let copy = || {
            timer.milliseconds(device, queue, |compute| {
                compute.set_pipeline(program.pipeline());
                compute.set_bind_group(0, &group, &[]);
                compute.dispatch_workgroups(x, y, 1);
            })
        };
        // Drivers compile a kernel when it is first used, and touch memory when it is first written.
        copy()?;
        copy()
    }

    /// Records the handover from the solver of an open model to this one of the sewn model.
    pub fn record_merge(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        open: &Solver,
        merge: &Merge,
    ) {
        let program = self.kernels.program(Kernel::MergeParticles);
        let words = |label, values: &[u32]| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some(label),
                contents: bytemuck::cast_slice(values),
                usage: wgpu::BufferUsages::STORAGE,
            })
        };
        let offsets = words("member_offsets", &merge.members.offsets);
        let members = words("members", &merge.members.values);
        let group = program.bind(device, |binding| {
            match binding.name.as_str() {
                "member_offsets" => &offsets,
                "members" => &members,
                "open_positions" => open.buffers.get("positions"),
                "open_velocities" => open.buffers.get("velocities"),
                name => self.buffers.get(name),
            }
            .as_entire_binding()
        });
        let pass = Pass::over(Kernel::MergeParticles, self.counts.particles);
        let [x, y] = pass.workgroups();
        let mut compute = encoder.begin_compute_pass(&labelled("handover of a cloth"));
        compute.set_pipeline(program.pipeline());
        compute.set_bind_group(0, &group, &[]);
        compute.dispatch_workgroups(x, y, 1);
        self.step = open.step;
    }

    /// Records that the cloth is carried by a rigid transform, with its velocities and what it touched, as if it had always been there.
    pub fn record_carry(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, carry: DMat4) {
        let program = self.kernels.program(Kernel::CarryParticles);
        let [row_x, row_y, row_z] = [0, 1, 2].map(|row| carry.row(row).as_vec4());
        let carry = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("carry"),
            contents: &uniform(&structs::Carry { row_x, row_y, row_z }),
            usage: wgpu::BufferUsages::UNIFORM,
        });
        // A cloth that meets no body touches nothing: what the kernel turns then is thrown away.
        let nothing = self.buffers.find("contacts").is_none().then(|| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("contacts of no body"),
                size: 2 * self.buffers.get("positions").size(),
                usage: wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            })
        });
        let group = program.bind(device, |binding| match (binding.name.as_str(), &nothing) {
            ("carry", _) => carry.as_entire_binding(),
            ("contacts", Some(nothing)) => nothing.as_entire_binding(),
            (name, _) => self.buffers.binding(name),
        });
        if let Some(pulls) = self.buffers.find("pulls") {
            // They point as the cloth did.
            encoder.clear_buffer(pulls, 0, None);
        }
        let [x, y] = Pass::over(Kernel::CarryParticles, self.counts.particles).workgroups();
        let mut compute = encoder.begin_compute_pass(&labelled("a cloth is carried"));
        compute.set_pipeline(program.pipeline());
        compute.set_bind_group(0, &group, &[]);
        compute.dispatch_workgroups(x, y, 1);
    }

    /// Whether it has the passes for these numbers of a step, and room for so many shapes: others need a solver of their own.
    pub fn has_passes_of(&self, settings: &StepSettings, shape_count: usize) -> bool {
        let has = |kernel| self.bound.iter().any(|bound| bound.kernel == kernel);
        let pressure = settings.wind.map_or(0.0, |wind| wind.pressure);
        (settings.wind.is_none() || has(Kernel::QuadWind))
            && (pressure == 0.0 || has(Kernel::PressureForces))
            && shape_count == self.shapes.len()
    }

    /// Records other numbers of a step: they hold for what is recorded from now on.
    ///
    /// # Panics
    /// When the numbers ask for other passes, buffers or steps than the cloth has.
    pub fn record_settings(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        settings: &StepSettings,
    ) {
        let mut same = self.settings.clone();
        same.gravity = settings.gravity;
        same.wind = settings.wind;
        same.damping = settings.damping;
        same.friction = settings.friction;
        same.reflection = settings.reflection;
        same.law = settings.law;
        assert!(
            same == *settings,
            "gravity, wind, damping, friction and reflection change while a cloth runs, nothing else of its step"
        );
        assert!(
            self.has_passes_of(settings, self.shapes.len()),
            "a cloth without air gets none while it runs, and one without pressure no pressure: begin with a calm, or a small pressure"
        );
        self.settings = settings.clone();
        let numbers = uniform(&step_params(self.counts, settings, self.maps.is_some()));
        record_contents(device, encoder, self.buffers.get("step"), &numbers);
    }

    /// Takes other numbers of springs and limits, from a model that differs in nothing else: they hold for what is recorded from now on. Cloths that share
    /// the buffers of the model before keep them.
    ///
    /// # Panics
    /// When the model has another number of anything.
    pub fn set_model(&mut self, model: &Model) {
        assert_eq!(
            self.counts,
            Counts::of(model),
            "the numbers of a cloth change while it runs, not what it is made of"
        );
        let Self { kernels, plan, settings, shapes, maps, buffers, bound, .. } = self;
        let start = Start { model, settings, plan, shapes, after_maps: maps.is_some() };
        let bindings = bound.iter().flat_map(|bound| &bound.program.interface().bindings);
        buffers.take_constants(kernels, start, bindings);
        for bound in bound {
            bound.group = bind(kernels.device(), &bound.program, buffers, maps.as_deref());
        }
    }

    /// The maps of what it collides with; `None` without any.
    pub fn maps(&self) -> Option<&Arc<BodyMaps>> {
        self.maps.as_ref()
    }

    /// The shapes that it collides with.
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// Has other shapes from the next step on, as many as before.
    ///
    /// # Panics
    /// When there are more shapes than before, or fewer.
    pub fn set_shapes(&mut self, shapes: Vec<Shape>) {
        assert_eq!(shapes.len(), self.shapes.len(), "a cloth keeps as many shapes as it began with");
        self.shapes = shapes;
        self.shapes_are_new = true;
    }

    /// Records that the host holds particles, or lets them go; each is named once.
    ///
    /// # Panics
    /// When a particle does not exist.
    pub fn record_pins(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, pins: &[PinTarget]) {
        if pins.is_empty() {
            return;
        }
        let count = self.counts.particles;
        if let Some(pin) = pins.iter().find(|pin| pin.particle >= count) {
            panic!("particle {} does not exist: the cloth has {count}", pin.particle);
        }
        let program = self.kernels.program(Kernel::SetPins);
        let targets = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("pins"),
            contents: &encoded(pins),
            usage: wgpu::BufferUsages::STORAGE,
        });
        let group = program.bind(device, |binding| match binding.name.as_str() {
            "pins" => targets.as_entire_binding(),
            name => self.buffers.binding(name),
        });
        let [x, y] = Pass::over(Kernel::SetPins, pins.len() as u32).workgroups();
        let mut compute = encoder.begin_compute_pass(&labelled("particles that the host holds"));
        compute.set_pipeline(program.pipeline());
        compute.set_bind_group(0, &group, &[]);
        compute.dispatch_workgroups(x, y, 1);
    }

    /// The newest status that has arrived, without waiting; `None` before the first frame is done.
    pub fn status(&self) -> Option<Status> {
        self.status.latest()
    }

    /// Positions [m] and inverse masses [1/kg] of the particles, vec4 each; usage `VERTEX`, `STORAGE`, `COPY_SRC`, `COPY_DST`.
    pub fn positions(&self) -> &wgpu::Buffer {
        self.buffers.get("positions")
    }

    /// Velocities [m/s] and masses [kg] of the particles, vec4 each.
    pub fn velocities(&self) -> &wgpu::Buffer {
        self.buffers.get("velocities")
    }

    /// Unit normals out of the cloth at the end of the last frame, vec4 each, xyz used.
    pub fn normals(&self) -> &wgpu::Buffer {
        self.buffers.get("normals")
    }

    /// What each particle touched in the last step, two vec4 each; `None` without a body.
    pub fn contacts(&self) -> Option<&wgpu::Buffer> {
        self.buffers.find("contacts")
    }

    /// What limits gave each particle in the last step [m/s], vec4 each, xyz used; `None` unless the rule is
    /// [`Rule::Predictive`](toile_scene::Rule::Predictive) or [`Rule::Hierarchical`](toile_scene::Rule::Hierarchical).
    pub fn pulls(&self) -> Option<&wgpu::Buffer> {
        self.buffers.find("pulls")
    }

    /// Goes on from a state that was written into the buffers of [`Solver::state`]: so many steps are done, and this was reported of them.
    pub fn resume(&mut self, step: u64, status: Option<Status>) {
        self.step = step;
        self.status.resume(status);
    }

    /// The passes of a step and of a frame.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The pipelines that it uses.
    pub fn kernels(&self) -> &Kernels {
        &self.kernels
    }

    /// The numbers of a step.
    pub fn settings(&self) -> &StepSettings {
        &self.settings
    }

    /// Steps recorded so far.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// Particle indices (u32), three per triangle, counter-clockwise seen from outside; usage `INDEX`, `STORAGE`, `COPY_SRC`. Cloths share it.
    pub fn indices(&self) -> &wgpu::Buffer {
        &self.indices
    }

    /// Bytes of all buffers, those that it shares too; maps are counted by [`BodyMaps::bytes`].
    pub fn bytes(&self) -> u64 {
        self.buffers.bytes() + self.indices.size()
    }

    /// Bytes of its buffers but those that it shares; [`Kernels::shared_bytes`] has these, once for all cloths.
    pub fn own_bytes(&self) -> u64 {
        self.bytes() - self.shared().map(wgpu::Buffer::size).sum::<u64>()
    }

    /// The buffers that nothing writes: cloths of the same [`Kernels`] share those that hold the same.
    pub fn shared(&self) -> impl Iterator<Item = &wgpu::Buffer> {
        self.buffers.shared().chain([self.indices()])
    }

    /// Name and bytes of each buffer.
    pub fn buffer_sizes(&self) -> impl Iterator<Item = (&str, u64)> {
        self.buffers.sizes()
    }

    /// `last` is the program whose pipeline is set: most passes are further colours of the same one.
    fn dispatch(&self, compute: &mut wgpu::ComputePass<'_>, dispatch: &Dispatch, place: Place, last: &mut usize) {
        let bound = &self.bound[dispatch.bound];
        let same = std::mem::replace(last, dispatch.bound) == dispatch.bound;
        if !same {
            compute.set_pipeline(bound.program.pipeline());
        }
        match dispatch.offset {
            Offset::None if same => {}
            Offset::None => compute.set_bind_group(0, &bound.group, &[]),
            Offset::Fixed(offset) => compute.set_bind_group(0, &bound.group, &[offset]),
            Offset::PerStepLeft(stride) => compute.set_bind_group(0, &bound.group, &[stride * place.left]),
            Offset::PerStep(stride) => compute.set_bind_group(0, &bound.group, &[stride * place.recorded]),
        }
        match dispatch.work {
            Work::Direct([x, y]) => compute.dispatch_workgroups(x, y, 1),
            Work::Indirect(offset) => {
                let (_, dispatches) =
                    self.buffers.of(Role::Dispatches).next().expect("a plan with grants has dispatches");
                compute.dispatch_workgroups_indirect(dispatches, offset);
            }
        }
    }

    /// Records where shapes are in each of the coming steps: what stands still is told once, for as many steps as there are.
    fn record_shapes(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, count: u32) {
        let still = self.shapes.iter().all(Shape::is_still);
        if count == 0 || (still && !self.shapes_are_new) {
            return;
        }
        self.shapes_are_new = false;
        let count = if still { self.settings.steps_per_frame } else { count };
        let steps = self.step..self.step + u64::from(count);
        let bytes = aligned(steps.map(|step| shape_entry(&self.shapes, step, &self.settings)));
        let Some((_, shapes)) = self.buffers.of(Role::PerStep).next() else { return };
        record_contents(device, encoder, shapes, &bytes);
    }
}

impl Dispatch {
    fn of(pass: &Pass, bound: &[BoundProgram], buffers: &Buffers) -> Self {
        let place = bound.iter().position(|bound| bound.kernel == pass.kernel).expect("a plan has its kernels");
        let offset = match bound[place].program.offset_role() {
            Some(role @ Role::PerSpan) => Offset::Fixed(buffers.stride(role) * pass.span.unwrap_or_default()),
            Some(role @ Role::PerStepLeft) => Offset::PerStepLeft(buffers.stride(role)),
            Some(role @ Role::PerStep) => Offset::PerStep(buffers.stride(role)),
            _ => Offset::None,
        };
        let work = match pass.grant {
            Some(place) => Work::Indirect(DISPATCH_STRIDE * u64::from(place)),
            None => Work::Direct(pass.workgroups()),
        };
        Self { bound: place, offset, work }
    }
}

/// Records other contents of a buffer. Not a queue write: the caller may record several frames before submitting any.
fn record_contents(device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, buffer: &wgpu::Buffer, contents: &[u8]) {
    let usage = wgpu::BufferUsages::COPY_SRC;
    let upload = device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage });
    encoder.copy_buffer_to_buffer(&upload, 0, buffer, 0, upload.size());
}

/// What a kernel of a plan names: maps, or buffers.
fn bind(device: &wgpu::Device, program: &Program, buffers: &Buffers, maps: Option<&BodyMaps>) -> wgpu::BindGroup {
    program.bind(device, |binding| {
        let map = maps.and_then(|maps| maps.resource(&binding.name));
        map.unwrap_or_else(|| buffers.binding(&binding.name))
    })
}

/// A compute pass with a name that tools of a driver show.
fn labelled(label: &str) -> wgpu::ComputePassDescriptor<'_> {
    wgpu::ComputePassDescriptor { label: Some(label), timestamp_writes: None }
}
