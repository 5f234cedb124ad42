//! The solver: records the passes of a plan.

use crate::buffers::{Buffers, DISPATCH_STRIDE, MOVING_UNIFORM_STRIDE, uniform_bytes};
use crate::limits::check_limits;
use crate::status::StatusReader;
use crate::timing::{PassTime, Timer};
use crate::{BodyMaps, GpuError, Pass, Plan, Program};
use std::collections::BTreeMap;
use std::ops::Range;
use toile_kernels::{Kernel, structs};
use toile_model::{Maps, Merge, Model, Needs, Status, StepSettings};
use toile_scene::Sphere;
use wgpu::util::DeviceExt;

/// The buffers whose contents carry over from step to step.
const STATE: [&str; 6] = ["positions", "velocities", "normals", "contacts", "limit_impulses", "polish_state"];

/// What a cloth collides with.
#[derive(Clone, Debug, Default)]
pub struct Colliders<'a> {
    /// Mesh bodies and inner garments, as maps.
    pub maps: Option<&'a BodyMaps>,
    /// An analytic sphere.
    pub sphere: Option<Sphere>,
}

/// One cloth on a device.
#[derive(Debug)]
pub struct Solver {
    settings: StepSettings,
    plan: Plan,
    buffers: Buffers,
    programs: BTreeMap<Kernel, BoundProgram>,
    sphere: Option<Sphere>,
    sphere_after_maps: bool,
    particle_count: u32,
    status: StatusReader,
    step: u64,
}

#[derive(Debug)]
struct BoundProgram {
    program: Program,
    group: wgpu::BindGroup,
}

impl Solver {
    /// Builds the pipelines and buffers that the model needs, and nothing else.
    ///
    /// # Errors
    /// [`GpuError::BufferTooLarge`] when the model does not fit the device, [`GpuError::LimitTooLow`] when the kernels do not.
    ///
    /// # Panics
    /// As [`Needs::new`].
    pub fn new(
        device: &wgpu::Device,
        model: &Model,
        settings: &StepSettings,
        colliders: Colliders<'_>,
    ) -> Result<Self, GpuError> {
        Self::with_programs(device, model, settings, colliders, |kernel| Program::new(device, kernel))
    }

    /// A solver of another model, which shares the pipelines of this one: none is compiled that this one has.
    ///
    /// # Errors
    /// As [`Solver::new`].
    pub fn new_alike(
        &self,
        device: &wgpu::Device,
        model: &Model,
        settings: &StepSettings,
        colliders: Colliders<'_>,
    ) -> Result<Self, GpuError> {
        Self::with_programs(device, model, settings, colliders, |kernel| match self.programs.get(&kernel) {
            Some(known) => known.program.clone(),
            None => Program::new(device, kernel),
        })
    }

    fn with_programs(
        device: &wgpu::Device,
        model: &Model,
        settings: &StepSettings,
        colliders: Colliders<'_>,
        program: impl Fn(Kernel) -> Program,
    ) -> Result<Self, GpuError> {
        check_limits(device)?;
        let maps = match colliders.maps {
            None => Maps::None,
            Some(maps) if maps.is_moving() => Maps::Moving,
            Some(_) => Maps::Still,
        };
        let needs = Needs::new(model, settings, maps, colliders.sphere.is_some());
        let plan = Plan::new(model, &needs, settings);
        let programs: Vec<_> = plan.kernels().into_iter().map(|kernel| (kernel, program(kernel))).collect();
        let bindings = programs.iter().flat_map(|(_, program)| &program.interface().bindings);
        let buffers = Buffers::new(device, model, settings, &plan, bindings)?;
        let bound = |(kernel, program): (Kernel, Program)| {
            let group = program.bind(device, |binding| {
                if let Some(map) = colliders.maps.and_then(|maps| maps.resource(&binding.name)) {
                    return map;
                }
                let buffer = buffers.get(&binding.name);
                let size = match binding.name.as_str() {
                    "span" => moving_size::<structs::Span>(),
                    "ball" => moving_size::<structs::Ball>(),
                    "lag" => moving_size::<structs::Lag>(),
                    // Not "the rest of the buffer": wgpu makes vertex buffers a word longer than asked for, and arrayLength
                    // would count that word, which nobody cleared.
                    _ => wgpu::BufferSize::new(buffer.size()),
                };
                wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset: 0, size })
            });
            (kernel, BoundProgram { program, group })
        };
        let programs = programs.into_iter().map(bound).collect();
        Ok(Self {
            settings: settings.clone(),
            plan,
            programs,
            sphere: colliders.sphere,
            sphere_after_maps: colliders.maps.is_some(),
            particle_count: model.particle_count(),
            status: StatusReader::new(device),
            step: 0,
            buffers,
        })
    }

    /// Records one frame: its steps, then normals and status.
    pub fn record_frame(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) {
        let steps = self.settings.steps_per_frame;
        self.record_steps(device, encoder, 0..steps, steps);
        self.record_outputs(encoder);
    }

    /// Records the steps `steps` of a map interval of `interval` steps: maps of moving bodies show them as they are at its end. A host may
    /// stop within an interval and go on later.
    ///
    /// # Panics
    /// When the steps go beyond the interval, or it has more steps than a frame of the settings.
    pub fn record_steps(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        steps: Range<u32>,
        interval: u32,
    ) {
        let most = self.settings.steps_per_frame;
        assert!(steps.end <= interval && interval <= most, "{steps:?} of {interval} steps, a frame has {most}");
        self.record_sphere(device, encoder, steps.len() as u32);
        self.record_lags(device, encoder, steps.clone(), interval);
        let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        let mut last = None;
        for index in 0..steps.len() as u32 {
            for pass in &self.plan.step {
                self.dispatch(&mut compute, pass, index, &mut last);
            }
        }
        self.step += steps.len() as u64;
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
        let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        let mut last = None;
        for pass in self.plan.frame.iter().filter(|pass| wanted(pass.kernel)) {
            self.dispatch(&mut compute, pass, 0, &mut last);
        }
    }

    /// Does one step pass by pass and says what each kernel cost, beside a state copy: the unit in which costs are told. For
    /// measuring only: it submits, and waits after every dispatch.
    ///
    /// # Errors
    /// [`GpuError::Device`] when the device is lost.
    pub fn time_step(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        timer: &Timer,
    ) -> Result<BTreeMap<Kernel, PassTime>, GpuError> {
        let mut encoder = device.create_command_encoder(&Default::default());
        self.record_sphere(device, &mut encoder, 1);
        self.record_lags(device, &mut encoder, 0..1, 1);
        queue.submit([encoder.finish()]);
        let mut times: BTreeMap<Kernel, PassTime> = BTreeMap::new();
        for pass in &self.plan.step {
            let time = times.entry(pass.kernel).or_default();
            time.milliseconds +=
                timer.milliseconds(device, queue, |compute| self.dispatch(compute, pass, 0, &mut None))?;
            time.dispatches += 1;
        }
        let milliseconds = self.time_state_copy(device, queue, timer)?;
        times.insert(Kernel::StateCopy, PassTime { dispatches: 1, milliseconds });
        self.step += 1;
        Ok(times)
    }

    /// Time of a copy of the whole state [ms].
    fn time_state_copy(&self, device: &wgpu::Device, queue: &wgpu::Queue, timer: &Timer) -> Result<f64, GpuError> {
        let program = Program::new(device, Kernel::StateCopy);
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
        let [x, y] = Pass::over(Kernel::StateCopy, self.particle_count).workgroups();
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
        let program = Program::new(device, Kernel::MergeParticles);
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
        let pass = Pass::over(Kernel::MergeParticles, self.particle_count);
        let [x, y] = pass.workgroups();
        let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        compute.set_pipeline(program.pipeline());
        compute.set_bind_group(0, &group, &[]);
        compute.dispatch_workgroups(x, y, 1);
        self.step = open.step;
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

    /// What each limit pulled with in the last step [N·s], f32 each, zeros up to a whole vec4; `None` unless the rule is
    /// [`Rule::Predictive`](toile_scene::Rule::Predictive) or [`Rule::Hierarchical`](toile_scene::Rule::Hierarchical).
    pub fn limit_impulses(&self) -> Option<&wgpu::Buffer> {
        self.buffers.find("limit_impulses")
    }

    /// The buffers whose contents carry over from step to step, by name: what a state is.
    pub fn state(&self) -> impl Iterator<Item = (&'static str, &wgpu::Buffer)> {
        STATE.iter().filter_map(|name| Some((*name, self.buffers.find(name)?)))
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

    /// The numbers of a step.
    pub fn settings(&self) -> &StepSettings {
        &self.settings
    }

    /// Steps recorded so far.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// Bytes of all buffers; maps are counted by [`BodyMaps::bytes`].
    pub fn bytes(&self) -> u64 {
        self.buffers.bytes()
    }

    /// Name and bytes of each buffer.
    pub fn buffer_sizes(&self) -> impl Iterator<Item = (&str, u64)> {
        self.buffers.sizes()
    }

    /// `last` is the kernel whose pipeline is set: most passes are further colours of the same one.
    fn dispatch(
        &self,
        compute: &mut wgpu::ComputePass<'_>,
        pass: &Pass,
        step_of_frame: u32,
        last: &mut Option<Kernel>,
    ) {
        let bound = &self.programs[&pass.kernel];
        if last.replace(pass.kernel) != Some(pass.kernel) {
            compute.set_pipeline(bound.program.pipeline());
        }
        let entry = pass.span.unwrap_or(step_of_frame);
        if bound.program.has_moving_uniform() {
            compute.set_bind_group(0, &bound.group, &[entry * MOVING_UNIFORM_STRIDE as u32]);
        } else {
            compute.set_bind_group(0, &bound.group, &[]);
        }
        match pass.grant {
            Some(place) => {
                let dispatches = self.buffers.get("sweep_dispatches");
                compute.dispatch_workgroups_indirect(dispatches, DISPATCH_STRIDE * u64::from(place));
            }
            None => {
                let [x, y] = pass.workgroups();
                compute.dispatch_workgroups(x, y, 1);
            }
        }
    }

    /// Records where the sphere is in each of the coming steps.
    fn record_sphere(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, count: u32) {
        let Some(sphere) = &self.sphere else { return };
        let dt = f64::from(self.settings.dt);
        let balls = (0..u64::from(count)).map(|index| {
            let [start, end] = [0, 1].map(|more| (self.step + index + more) as f64 * dt);
            let [centre, next] = [start, end].map(|time| sphere.at(time).0);
            uniform_bytes(&structs::Ball {
                centre: centre.as_vec3(),
                radius: sphere.radius as f32 + self.settings.thickness,
                velocity: ((next - centre) / dt).as_vec3(),
                after_maps: u32::from(self.sphere_after_maps),
                spin: sphere.spin(start).as_vec3(),
            })
        });
        self.record_moving_uniform(device, encoder, "ball", balls);
    }

    /// Records how long before the time of the maps each of the coming steps begins and ends.
    fn record_lags(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, steps: Range<u32>, interval: u32) {
        if self.buffers.find("lag").is_none() {
            return;
        }
        let dt = self.settings.dt;
        let lags = steps.map(|index| {
            let left = interval - index;
            uniform_bytes(&structs::Lag { start: left as f32 * dt, end: (left - 1) as f32 * dt })
        });
        self.record_moving_uniform(device, encoder, "lag", lags);
    }

    /// Records the entries of a uniform that moves from step to step.
    fn record_moving_uniform(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        name: &str,
        entries: impl Iterator<Item = Vec<u8>>,
    ) {
        let mut bytes = Vec::new();
        for entry in entries {
            bytes.extend(entry);
            bytes.resize(bytes.len().next_multiple_of(MOVING_UNIFORM_STRIDE as usize), 0);
        }
        // A buffer of its own, not a queue write: the caller may record several frames before submitting any.
        let upload = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some(name),
            contents: &bytes,
            usage: wgpu::BufferUsages::COPY_SRC,
        });
        encoder.copy_buffer_to_buffer(&upload, 0, self.buffers.get(name), 0, bytes.len() as u64);
    }
}

fn moving_size<T: encase::ShaderType>() -> Option<std::num::NonZeroU64> {
    Some(T::min_size())
}
