//! How a cloth lies on what it wears under it: exact distances in f64, not those of the maps.

use crate::worn::Worn;
use glam::DVec3;
use toile::model::{Solid, crossed_particles};
use toile::scene::{Body, Mesh, Shape};
use toile_lab::{max_and_p99, middles};
use toile_reference::ExactDistance;

/// Everything that a cloth can touch. Built once per run; each finished garment is added for the next one.
pub struct Surfaces {
    bodies: Vec<Exact>,
    solid: Solid,
    garments: Vec<ExactDistance>,
}

/// What is measured of a cloth against them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Deepest particle below the surface of a body [m], negative when all are outside.
    pub penetration_max: f64,
    /// 99th percentile of it [m].
    pub penetration_p99: f64,
    /// Deepest middle of an edge of a face [m].
    pub edge_penetration_max: f64,
    /// Deepest middle of a face [m].
    pub face_penetration_max: f64,
    /// Particles on the wrong side of the bodies.
    pub crossed_count: u32,
    /// Part of the particles that count as touching although they are far from every surface.
    pub false_fraction: f64,
}

/// How far from a surface a particle may touch it in the maps [m]: thickness + 2 texels.
pub fn reach(thickness: f64, texel: f32) -> f64 {
    thickness + 2.0 * f64::from(texel)
}

/// Whether a particle at a point [m], so deep in the bodies [m], is farther than `reach` [m] from them and from the garments below it.
pub fn is_far(point: DVec3, depth: f64, garments: &[ExactDistance], reach: f64) -> bool {
    // A garment has two sides, so only its distance counts.
    depth < -reach && garments.iter().all(|garment| garment.penetration(point).abs() > reach)
}

enum Exact {
    Mesh(Box<ExactDistance>),
    Shape(Shape),
}

impl Exact {
    /// How deep a point [m] is inside at a time [s], negative outside [m].
    fn penetration(&self, point: DVec3, time: f64) -> f64 {
        match self {
            Self::Mesh(mesh) => mesh.penetration(point),
            Self::Shape(shape) => shape.depth(point, time),
        }
    }
}

impl Surfaces {
    /// The bodies of a scene as they stand at a time [s].
    pub fn new(bodies: &[Body], time: f64) -> Self {
        let exact = |body: &Body| match body {
            Body::Mesh(mesh) => Exact::Mesh(Box::new(ExactDistance::new(mesh))),
            Body::Moving(body) => Exact::Mesh(Box::new(ExactDistance::new(&body.at(time)))),
            Body::Shape(shape) => Exact::Shape(shape.clone()),
        };
        let mesh = |body: &Body| match body {
            Body::Mesh(mesh) => mesh.clone(),
            Body::Moving(body) => body.at(time),
            Body::Shape(shape) => shape.mesh(time),
        };
        let solid = Solid::of(&bodies.iter().map(mesh).collect::<Vec<_>>());
        Self { bodies: bodies.iter().map(exact).collect(), solid, garments: Vec::new() }
    }

    /// A garment that later ones lie over.
    pub fn add_garment(&mut self, mesh: &Mesh) {
        self.garments.push(ExactDistance::new(mesh));
    }

    /// Measures a cloth; `None` without a body. `texel` is that of the maps [m].
    pub fn measure(&self, worn: &Worn, texel: f32) -> Option<Contact> {
        let time = worn.status.step as f64 * f64::from(worn.settings.dt);
        let points = || worn.mesh.positions.iter().map(|p| p.as_dvec3());
        let depth = |point| self.bodies.iter().map(|body| body.penetration(point, time)).reduce(f64::max);
        let depths: Vec<f64> = points().filter_map(depth).collect();
        let reach = reach(f64::from(worn.settings.thickness), texel);
        let false_count = points()
            .zip(&depths)
            .zip(&worn.touching)
            .filter(|((point, depth), touching)| **touching && is_far(*point, **depth, &self.garments, reach))
            .count();
        let false_fraction = false_count as f64 / depths.len() as f64;
        let [penetration_max, penetration_p99] = max_and_p99(depths)?;
        let [edge_penetration_max, face_penetration_max] = middles(&worn.model, &worn.mesh.positions)
            .map(|points| points.into_iter().filter_map(depth).fold(f64::NEG_INFINITY, f64::max));
        let crossed_count = crossed_particles(&worn.model, &worn.mesh.positions, &self.solid).0.len() as u32;
        Some(Contact {
            penetration_max,
            penetration_p99,
            edge_penetration_max,
            face_penetration_max,
            crossed_count,
            false_fraction,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3, dvec3};

    #[test]
    fn what_lies_on_an_inner_garment_is_not_far() {
        let panel = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            triangles: vec![[0, 1, 2]],
        };
        let garments = [ExactDistance::new(&panel)];
        let reach = reach(0.003, 0.005);
        assert!((reach - 0.013).abs() < 1e-9, "{reach}");
        let far_from_bodies = -0.1;
        for (z, far) in [(0.01, false), (-0.01, false), (0.02, true), (-0.02, true)] {
            assert_eq!(is_far(dvec3(0.2, 0.2, z), far_from_bodies, &garments, reach), far, "{z} m from the garment");
        }
        assert!(is_far(dvec3(0.2, 0.2, 0.01), far_from_bodies, &[], reach), "without the garment");
        assert!(!is_far(dvec3(0.2, 0.2, 0.02), -0.01, &garments, reach), "near a body");
    }
}
