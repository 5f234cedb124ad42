//! The life of a sheet on the CPU with its collision either in image space or in object space, and the time of both parts.

use glam::Vec3;
use std::time::{Duration, Instant};
use toile::model::{Model, StepSettings};
use toile_reference::maps::BodyMaps;
use toile_reference::{Contact, Lag, Midpoints, ObjectSpace, Particles, Probe, frame, limits, step};

/// Where collision is tested.
#[derive(Clone, Debug)]
pub enum Collision {
    /// In the maps of the body: particles and quad midpoints. D §5.
    Image(BodyMaps),
    /// Against the faces of the body: particles alone, as in D §7.
    Object(ObjectSpace),
}

/// A sheet under the hierarchical rule, at rest body, no seams, no wind: the steps of [`toile_reference::Reference`] with a clock.
#[derive(Debug)]
pub struct Life<'a> {
    model: &'a Model,
    settings: StepSettings,
    collision: &'a Collision,
    particles: Particles,
    contacts: Vec<Contact>,
    probes: Vec<Probe>,
    quad_probes: Vec<Probe>,
    pulls: Vec<Vec3>,
    /// Steps done.
    pub steps: u32,
    /// Time of collision detection and response so far.
    pub collision_time: Duration,
    /// Time of everything so far.
    pub time: Duration,
}

impl<'a> Life<'a> {
    /// A sheet at the start of its model.
    pub fn new(model: &'a Model, settings: &StepSettings, collision: &'a Collision) -> Self {
        Self {
            model,
            settings: settings.clone(),
            collision,
            particles: Particles::new(model),
            contacts: vec![Contact::default(); model.positions.len()],
            probes: Vec::new(),
            quad_probes: Vec::new(),
            pulls: vec![Vec3::ZERO; model.positions.len()],
            steps: 0,
            collision_time: Duration::ZERO,
            time: Duration::ZERO,
        }
    }

    /// Does a step.
    pub fn step(&mut self) {
        let start = Instant::now();
        let Self { model, settings, particles, .. } = self;
        let dt = settings.dt;
        let mut forces = step::spring_forces(particles, &model.links, settings);
        step::reaction(&mut forces, particles, &self.contacts, settings);
        step::euler(&mut particles.velocities, &forces, &particles.inverse_masses, dt);
        limits::warm_start(particles, settings, &mut self.pulls);
        for sweep in 0..self.settings.sweeps {
            let Self { model, settings, particles, pulls, .. } = self;
            limits::sweep(particles, model, settings, None, pulls);
            self.collide(sweep == 0);
        }
        limits::guard(&mut self.particles, self.model, &self.settings, &self.probes);
        step::move_particles(&mut self.particles.positions, &self.particles.velocities, dt);
        self.steps += 1;
        self.time += start.elapsed();
    }

    /// The points look at the body in the first sweep of a step.
    fn collide(&mut self, looks: bool) {
        let start = Instant::now();
        let Self { model, settings, particles, probes, quad_probes, .. } = self;
        let midpoints = match self.collision {
            Collision::Image(_) => step::quad_midpoints(&particles.positions, &particles.velocities, &model.quads),
            Collision::Object(_) => {
                let nothing = vec![glam::Vec3::ZERO; model.quads.len()];
                Midpoints { positions: nothing.clone(), velocities: nothing }
            }
        };
        if looks {
            (*probes, *quad_probes) = match self.collision {
                Collision::Image(maps) => {
                    let look = |positions: &[glam::Vec3], velocities: &[glam::Vec3]| {
                        step::sample_body_maps(positions, velocities, maps, Lag::default(), settings)
                    };
                    let own = look(&particles.positions, &particles.velocities);
                    (own, look(&midpoints.positions, &midpoints.velocities))
                }
                Collision::Object(body) => {
                    let own = body.probes(&particles.positions, &particles.velocities, settings);
                    (own, vec![Probe::default(); model.quads.len()])
                }
            };
        }
        let probes = step::Probes { particles: probes, quads: quad_probes };
        self.contacts = step::collide(particles, &model.particle_quads, &midpoints, probes, settings);
        self.collision_time += start.elapsed();
    }

    /// The particles.
    pub fn particles(&self) -> &Particles {
        &self.particles
    }

    /// Contacts of the last step.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Mean speed [m/s], the root of the mean square; NaN once a particle is not finite.
    pub fn speed(&self) -> f64 {
        if frame::particle_status(&self.particles).non_finite_count > 0 {
            return f64::NAN;
        }
        let squares = self.particles.velocities.iter().map(|v| f64::from(v.length_squared()));
        (squares.sum::<f64>() / self.particles.velocities.len() as f64).sqrt()
    }
}
