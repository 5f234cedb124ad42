//! The solver: records the passes of a plan.

use crate::buffers::{Buffers, DISPATCH_STRIDE, MOVING_UNIFORM_STRIDE, moving_entries, uniform_bytes};
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

/// Where a step stands, for the uniforms that change with it.
#[derive(Clone, Copy, Debug, Default)]
struct Place {
    /// Among the steps that are recorded together.
    recorded: u32,
    /// Steps that follow it in the interval of the maps.
    left: u32,
}

/// Names of the buffers whose contents carry over from step to step.
const STATE: [&str; 5] = ["positions", "velocities", "contacts", "limit_impulses", "polish_state"];

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
        self.record_sphere(device, encoder, count);
        let mut compute = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        let mut last = None;
        for index in 0..count {
            let place = Place { recorded: index, left: interval - steps.start - index - 1 };
            for pass in &self.plan.step {
                self.dispatch(&mut compute, pass, place, &mut last);
            }
        }
        self.step += u64::from(count);
    }

    /// The buffers whose contents carry over from step to step, and their names: all that a saved simulation needs. Usage `COPY_SRC` and `COPY_DST`.
    pub fn state(&self) -> impl Iterator<Item = (&'static str, &wgpu::Buffer)> {
        STATE.iter().filter_map(|name| Some((*name, self.buffers.find(name)?)))
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
            self.dispatch(&mut compute, pass, Place::default(), &mut last);
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
        queue.submit([encoder.finish()]);
        let mut times: BTreeMap<Kernel, PassTime> = BTreeMap::new();
        for pass in &self.plan.step {
            let time = times.entry(pass.kernel).or_default();
            time.milliseconds += timer
                .milliseconds(device, queue, |compute| self.dispatch(compute, pass, Place::default(), &mut None))?;
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
    pub fn status(&mut self) -> Option<Status> {
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

    /// Goes on from a step: for a state that another solver left there. Shapes stand where they are then.
    pub fn set_step(&mut self, step: u64) {
        self.step = step;
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
    fn dispatch(&self, compute: &mut wgpu::ComputePass<'_>, pass: &Pass, place: Place, last: &mut Option<Kernel>) {
        let bound = &self.programs[&pass.kernel];
        if last.replace(pass.kernel) != Some(pass.kernel) {
            compute.set_pipeline(bound.program.pipeline());
        }
        let step = if bound.program.interface().binding("lag").is_some() { place.left } else { place.recorded };
        let entry = pass.span.unwrap_or(step);
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

    /// Records the entries of a uniform that moves from step to step.
    fn record_moving_uniform(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        name: &str,
        entries: impl Iterator<Item = Vec<u8>>,
    ) {
        let bytes = moving_entries(entries);
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
