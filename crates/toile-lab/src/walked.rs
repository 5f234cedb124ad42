//! How garments hold over a walk, frame by frame, against the exact moving body.

use crate::{Gpu, LabError, max_and_p99};
use glam::{DMat3, DQuat, DVec3, Vec3};
use std::collections::BTreeSet;
use toile::model::{Fit, Model, NO_CORNER, Solid, crossed_particles};
use toile::scene::{Body, Cloth, MovingMesh};
use toile::{Simulation, Stage};
use toile_reference::ExactDistance;

/// The worst frame of a walk in each respect, over all garments.
#[derive(Clone, Copy, Debug)]
pub struct Worst {
    /// 99th percentile of the elongation of structural and shear springs [1].
    pub elongation_p99: f64,
    /// Largest elongation [1].
    pub elongation_max: f64,
    /// Deepest particle below the surface of the body [m], negative outside.
    pub particles: f64,
    /// Deepest middle of an edge of a face [m].
    pub edges: f64,
    /// Deepest middle of a face [m].
    pub faces: f64,
    /// Most particles on the wrong side of the body.
    pub crossed_count: u32,
}

impl Worst {
    /// Dresses what was fitted, walks for some seconds, and measures each frame of its frame rate.
    ///
    /// # Errors
    /// [`LabError::Toile`] when it cannot be dressed, a particle is not finite, or the device is lost.
    ///
    /// # Panics
    /// When no body moves.
    pub fn of(gpu: &Gpu, fit: &Fit, seconds: f64) -> Result<Self, LabError> {
        let body = moving(fit);
        let rate = fit.scene.settings.frame_rate;
        let mut simulation = Simulation::fitted(&gpu.device, fit)?;
        while simulation.stage()? != Stage::Running {
            advance(gpu, &mut simulation, 1.0 / rate)?;
        }
        let mut worst = Self::NOTHING;
        while simulation.time() < seconds - 0.5 / rate {
            advance(gpu, &mut simulation, 1.0 / rate)?;
            let posed = body.at(simulation.time());
            let (exact, solid) = (ExactDistance::new(&posed), Solid::of([&posed]));
            for worn in simulation.cloths() {
                worst.add(worn.model, &gpu.vec3s(&worn.cloth.frame().positions)?, &exact, &solid);
            }
        }
        Ok(worst)
    }

    const NOTHING: Self = Self {
        elongation_p99: 0.0,
        elongation_max: 0.0,
        particles: f64::NEG_INFINITY,
        edges: f64::NEG_INFINITY,
        faces: f64::NEG_INFINITY,
        crossed_count: 0,
    };

    /// Adds a cloth as it lies in a frame.
    fn add(&mut self, model: &Model, positions: &[Vec3], exact: &ExactDistance, solid: &Solid) {
        let elongations = model.limits.iter().map(|limit| {
            let [a, b] = limit.ends.map(|end| positions[end as usize].as_dvec3());
            a.distance(b) / f64::from(limit.rest_length) - 1.0
        });
        let [max, p99] = max_and_p99(elongations.collect()).unwrap_or_default();
        self.elongation_max = self.elongation_max.max(max);
        self.elongation_p99 = self.elongation_p99.max(p99);
        let deepest = |points: &mut dyn Iterator<Item = DVec3>| {
            points.map(|point| exact.penetration(point)).fold(f64::NEG_INFINITY, f64::max)
        };
        self.particles = self.particles.max(deepest(&mut positions.iter().map(|p| p.as_dvec3())));
        let [edges, faces] = middles(model, positions);
        self.edges = self.edges.max(deepest(&mut edges.into_iter()));
        self.faces = self.faces.max(deepest(&mut faces.into_iter()));
        self.crossed_count = self.crossed_count.max(crossed_particles(model, positions, solid).0.len() as u32);
    }
}

/// What was fitted, turned about y by an angle [rad]: the body, its motion and the panels around it. Nothing else knows of it.
pub fn turned(fit: &Fit, angle: f64) -> Fit {
    let turn = DQuat::from_rotation_y(angle);
    let matrix = DMat3::from_quat(turn);
    let mut fit = fit.clone();
    for body in &mut fit.scene.bodies {
        match body {
            Body::Mesh(mesh) => *mesh = mesh.turned(matrix),
            Body::Moving(moving) => *moving = moving.turned(matrix),
            Body::Shape(_) => {}
        }
    }
    fit.dress_in = fit.dress_in.as_ref().map(|pose| pose.turned(matrix));
    for cloth in &mut fit.scene.cloths {
        let Cloth::Garment(garment) = cloth else { continue };
        for panel in &mut garment.panels {
            panel.placement.rotation = turn * panel.placement.rotation;
            panel.placement.translation = turn * panel.placement.translation;
        }
    }
    fit
}

/// Middles of the edges of a cloth's faces, and of the faces themselves [m]. Between its particles cloth goes straight on, where a body bulges.
pub fn middles(model: &Model, positions: &[Vec3]) -> [Vec<DVec3>; 2] {
    let place = |particle: u32| positions[particle as usize].as_dvec3();
    let mut edges: BTreeSet<[u32; 2]> = BTreeSet::new();
    let mut faces = Vec::with_capacity(model.quads.len());
    for quad in &model.quads {
        let corners = if quad[3] == NO_CORNER { &quad[..3] } else { quad };
        for (&a, &b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            edges.insert([a.min(b), a.max(b)]);
        }
        faces.push(corners.iter().map(|corner| place(*corner)).sum::<DVec3>() / corners.len() as f64);
    }
    [edges.into_iter().map(|[a, b]| place(a).midpoint(place(b))).collect(), faces]
}

fn moving(fit: &Fit) -> &MovingMesh {
    let mut moving = fit.scene.bodies.iter().filter_map(|body| match body {
        Body::Moving(moving) => Some(moving),
        Body::Mesh(_) | Body::Shape(_) => None,
    });
    moving.next().expect("a body that moves")
}

fn advance(gpu: &Gpu, simulation: &mut Simulation, seconds: f64) -> Result<(), LabError> {
    let mut done = Ok(());
    gpu.run(|encoder| done = simulation.advance(encoder, seconds).map(|_| ()))?;
    Ok(done?)
}
