//! The life of the GPU simulation on the CPU.

use crate::limits::{self, part};
use crate::maps::BodyMaps;
use crate::step::PolishState;
use crate::{Contact, Lag, Particles, Probe, digest, frame, step};
use glam::{Vec3, Vec4};
use toile_model::{Merge, Model, PinTarget, ShapeStep, Status, StepSettings};
use toile_scene::{Polish, Rule, Shape};

/// What the cloth collides with. The default is nothing: then no contact kernel runs.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Colliders {
    /// Maps of a body mesh; the papers' have the thickness of the cloth in them.
    pub maps: Option<BodyMaps>,
    /// Analytic shapes, without thickness.
    pub shapes: Vec<Shape>,
}

impl Colliders {
    /// Maps, shapes, or both.
    pub fn new(maps: Option<BodyMaps>, shapes: Vec<Shape>) -> Self {
        Self { maps, shapes }
    }

    /// Whether there is any body.
    fn any(&self) -> bool {
        self.maps.is_some() || !self.shapes.is_empty()
    }
}

/// A simulation on the CPU, for snapshot tests and for machines without adapter. It gives the same answer everywhere.
///
/// ```
/// use glam::vec3;
/// use toile_model::{Arrays, Model, StepSettings};
/// use toile_reference::{Colliders, Reference};
/// use toile_scene::{Fabric, Rule, Settings};
///
/// let model = Model::new(Arrays::of_particles(vec![vec3(0.0, 1.0, 0.0)], vec![0.001])).expect("a particle is a model");
/// let mut settings = StepSettings::new(&Settings::new(Fabric::preset("cotton").expect("a preset")), &model);
/// settings.dt = 0.01;
/// settings.steps_per_frame = 10;
/// settings.gravity = vec3(0.0, -10.0, 0.0);
/// settings.damping = 0.0;
/// settings.rule = Rule::Predictive;
/// let mut reference = Reference::new(&model, &settings, Colliders::default());
/// reference.frame();
/// assert_eq!(reference.status().step, 10);
/// assert!((reference.velocities()[0] - vec3(0.0, -1.0, 0.0)).length() < 1e-6);
/// ```
#[derive(Clone, Debug)]
pub struct Reference {
    model: Model,
    settings: StepSettings,
    colliders: Colliders,
    particles: Particles,
    /// Contacts of the last step, shape [particle_count]; empty without body.
    contacts: Vec<Contact>,
    /// What the particles saw in this step, shape [particle_count]; empty without body.
    probes: Vec<Probe>,
    /// The same of the quads, shape [quad_count].
    quad_probes: Vec<Probe>,
    /// What limits gave each particle in the last step [m/s], shape [particle_count].
    pulls: Vec<Vec3>,
    polish: PolishState,
    step: u64,
}

impl Reference {
    /// A simulation of `model` at rest.
    pub fn new(model: &Model, settings: &StepSettings, colliders: Colliders) -> Self {
        let contact_count = if colliders.any() { model.positions.len() } else { 0 };
        Self {
            particles: Particles::new(model),
            contacts: vec![Contact::default(); contact_count],
            probes: Vec::new(),
            quad_probes: Vec::new(),
            pulls: vec![Vec3::ZERO; model.positions.len()],
            model: model.clone(),
            settings: settings.clone(),
            colliders,
            polish: PolishState::default(),
            step: 0,
        }
    }

    /// The handover: the same state in the sewn model, whose particles `merge` makes from those of this one. Contacts,
    /// what limits gave and what a polish counts start anew; the number of steps and with it the time go on.
    pub fn sewn(self, model: &Model, settings: &StepSettings, merge: &Merge) -> Self {
        let mut sewn = Self::new(model, settings, self.colliders);
        frame::merge_particles(&self.particles, &merge.members, &mut sewn.particles);
        sewn.step = self.step;
        sewn
    }

    /// Takes maps that show the bodies as they will be at the end of the coming steps.
    ///
    /// # Panics
    /// When the simulation has no maps yet.
    pub fn set_maps(&mut self, maps: BodyMaps) {
        assert!(self.colliders.maps.is_some(), "a simulation without maps does not get any later");
        self.colliders.maps = Some(maps);
    }

    /// Carries the cloth by the first three rows of a rigid transform, with its velocities and what it touched.
    pub fn carry(&mut self, rows: [Vec4; 3]) {
        frame::carry_particles(&mut self.particles, &mut self.contacts, rows);
        // They point as the cloth did.
        self.pulls.fill(Vec3::ZERO);
    }

    /// Takes other numbers of a step, from the next one on.
    ///
    /// # Panics
    /// When the length of a step changes.
    pub fn set_settings(&mut self, settings: &StepSettings) {
        assert_eq!(settings.dt, self.settings.dt, "the length of a step stays while a cloth runs");
        self.settings = settings.clone();
    }

    /// Takes other numbers of springs and limits, from a model of the same cloth.
    ///
    /// # Panics
    /// When the model has another number of particles.
    pub fn set_model(&mut self, model: &Model) {
        assert_eq!(model.particle_count(), self.model.particle_count(), "a cloth keeps its particles while it runs");
        self.model = model.clone();
    }

    /// Has other shapes from the next step on.
    pub fn set_shapes(&mut self, shapes: Vec<Shape>) {
        self.colliders.shapes = shapes;
    }

    /// Holds particles, or lets them go; each is named once.
    pub fn set_pins(&mut self, pins: &[PinTarget]) {
        frame::set_pins(&mut self.particles, pins);
    }

    /// Does one step, at whose end the maps show the bodies.
    pub fn step(&mut self) {
        self.steps(1);
    }

    /// Does steps; the maps show the bodies at the end of the last of them.
    pub fn steps(&mut self, count: u32) {
        for index in 0..count {
            self.one_step(Lag::of(index, count, self.settings.dt));
        }
    }

    fn one_step(&mut self, lag: Lag) {
        let Self { model, settings, particles, .. } = self;
        let dt = settings.dt;
        let has_body = self.colliders.any();

        let mut forces = step::forces(particles, model, settings);
        if has_body {
            step::reaction(&mut forces, particles, &self.contacts, settings);
        }
        step::euler(&mut particles.velocities, &forces, &particles.inverse_masses, dt);
        limits::warm_start(particles, settings, &mut self.pulls);
        if settings.hold_rate > 0.0 {
            step::hold_edges(particles, &model.holds, &model.held_particles, settings);
        }
        for index in 0..self.settings.sweeps.max(1) {
            self.sweep((index == 0).then_some(lag));
        }
        limits::guard(&mut self.particles, &self.model, &self.settings, &self.probes);
        if let Some(polish) = self.polishes() {
            while self.grants_sweep(polish) {
                self.sweep(None);
                limits::guard(&mut self.particles, &self.model, &self.settings, &self.probes);
            }
        }
        let Self { model, settings, particles, .. } = self;
        step::move_particles(&mut particles.positions, &particles.velocities, dt);
        if settings.rule == Rule::Position {
            for _ in 0..settings.sweeps {
                for colour in &model.limit_colours {
                    step::limit_position(particles, part(&model.limits, colour));
                }
            }
        }
        self.step += 1;
    }

    /// One sweep: seams, limits and bodies take their turns, and the seams once more. Points look at the bodies in the `first` sweep of a step alone,
    /// whose maps lag so.
    fn sweep(&mut self, first: Option<Lag>) {
        let Self { model, settings, particles, contacts, pulls, .. } = self;
        for colour in (0..StepSettings::SEAM_PASSES).flat_map(|_| &model.seam_colours) {
            step::draw_seams(particles, part(&model.seam_pairs, colour), settings.dt);
        }
        let touched = (!contacts.is_empty()).then_some(contacts.as_slice());
        limits::sweep(particles, model, settings, touched, pulls);
        if self.colliders.any() {
            self.collide(first);
        }
        let Self { model, settings, particles, .. } = self;
        for colour in (0..StepSettings::SEAM_PASSES).flat_map(|_| &model.seam_colours) {
            step::close_seams(particles, part(&model.seam_pairs, colour), settings.dt);
        }
    }

    /// The polish, where there are limits to measure.
    fn polishes(&self) -> Option<Polish> {
        self.settings.polish.filter(|_| !self.model.limits.is_empty() && self.settings.sweeps > 0)
    }

    /// Measures what the coming move would do, and says whether a further sweep follows.
    fn grants_sweep(&mut self, polish: Polish) -> bool {
        let Self { model, settings, particles, .. } = self;
        self.polish.elongation_max = step::measure_excess(particles, &model.limits, polish.target as f32, settings.dt);
        step::grant_sweep(&mut self.polish, polish.sweeps)
    }

    fn collide(&mut self, first: Option<Lag>) {
        let midpoints = step::quad_midpoints(&self.particles.positions, &self.particles.velocities, &self.model.quads);
        if let Some(lag) = first {
            self.quad_probes = self.probes_of(&midpoints.positions, &midpoints.velocities, lag);
            self.probes = self.probes_of(&self.particles.positions, &self.particles.velocities, lag);
        }
        let probes = step::Probes { particles: &mut self.probes, quads: &self.quad_probes };
        self.contacts =
            step::collide(&mut self.particles, &self.model.particle_quads, &midpoints, probes, &self.settings);
    }

    fn probes_of(&self, positions: &[Vec3], velocities: &[Vec3], lag: Lag) -> Vec<Probe> {
        let mut probes = match &self.colliders.maps {
            Some(maps) => step::sample_body_maps(positions, velocities, maps, lag, &self.settings),
            None => vec![Probe::default(); positions.len()],
        };
        let shapes = self.colliders.shapes.iter().map(|shape| ShapeStep::of(shape, self.step, &self.settings));
        step::sample_shapes(&mut probes, positions, velocities, &shapes.collect::<Vec<_>>(), &self.settings);
        probes
    }

    /// Does the steps of one frame.
    pub fn frame(&mut self) {
        self.steps(self.settings.steps_per_frame);
    }

    /// What the simulation reports of its state.
    pub fn status(&self) -> Status {
        let particles = frame::particle_status(&self.particles);
        let limits = frame::limit_status(&self.particles.positions, &self.model.limits, self.settings.aim());
        Status {
            step: self.step,
            non_finite_count: particles.non_finite_count,
            first_non_finite: particles.first_non_finite,
            speed_max: particles.speed_max,
            kinetic_energy: frame::total_energy(&particles.energy_partials),
            elongation_max: limits.elongation_max,
            over_long_count: limits.over_long_count,
            longest_limit: frame::longest_limit(&self.particles.positions, &self.model.limits),
            seam_gap_max: frame::seam_status(&self.particles.positions, &self.model.seam_pairs),
            further_sweeps: self.polish.further_sweeps,
            missed_steps: self.polish.missed_steps,
        }
    }

    /// Kinetic energy of all particles that are not pinned [J].
    pub fn kinetic_energy(&self) -> f32 {
        frame::total_energy(&frame::particle_status(&self.particles).energy_partials)
    }

    /// Positions [m], shape [particle_count].
    pub fn positions(&self) -> &[Vec3] {
        &self.particles.positions
    }

    /// Velocities [m/s], shape [particle_count].
    pub fn velocities(&self) -> &[Vec3] {
        &self.particles.velocities
    }

    /// Unit normals on the outside of the cloth, shape [particle_count].
    pub fn normals(&self) -> Vec<Vec3> {
        frame::particle_normals(&self.particles.positions, &self.model.quads, &self.model.particle_quads)
    }

    /// Contacts of the last step, shape [particle_count]; empty without body.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// What limits gave each particle in the last step [m/s], shape [particle_count]; zeros unless the rule is [`Rule::Predictive`] or
    /// [`Rule::Hierarchical`].
    pub fn pulls(&self) -> &[Vec3] {
        &self.pulls
    }

    /// The state as a few rounded numbers, for snapshots that a reviewer can read.
    pub fn digest(&self) -> String {
        digest::digest(&self.model, &self.status(), &self.particles.positions, &self.contacts)
    }
}
