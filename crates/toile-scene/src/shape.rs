//! Shapes that the cloth meets exactly, without maps.

use crate::{Mesh, RigidMotion};
use glam::{DMat3, DQuat, DVec3, Vec3};

/// Parallels of a sphere in pictures and files.
const SPHERE_PARALLELS: u32 = 48;

/// Parts of an eighth of a turn around the edges of a box there.
const BOX_ARCS: u32 = 6;

/// Side of the square that stands for a plane there [m].
const PLANE_SIDE: f64 = 2.0;

/// An analytic shape.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Shape {
    /// What it is.
    pub form: Form,
    /// Centre [m] before it moves.
    pub centre: DVec3,
    /// How it moves.
    pub motion: ShapeMotion,
}

/// What a shape is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// A sphere.
    Sphere {
        /// Radius [m], positive.
        radius: f64,
    },
    /// All that lies within a radius of a straight line between two ends.
    Capsule {
        /// From the centre to one of the ends [m], before it turns; not zero.
        half_axis: DVec3,
        /// Radius [m], positive.
        radius: f64,
    },
    /// All that lies behind a plane through the centre, without end.
    Plane {
        /// Unit normal, outward, before it turns.
        normal: DVec3,
    },
    /// A box around the centre, its edges and corners rounded.
    Box {
        /// Half of its extents with the rounding [m], positive.
        half_size: DVec3,
        /// How it is turned before it moves.
        rotation: DQuat,
        /// Radius of its edges and corners [m], 0 to the smallest of the half extents.
        radius: f64,
    },
}

/// How a shape moves.
#[derive(Clone, Debug, PartialEq)]
pub enum ShapeMotion {
    /// Not at all.
    Still,
    /// There and back: centre + amplitude·(1 − cos(2π·time/period))/2, which starts at rest.
    Swing {
        /// Farthest displacement from the centre at time 0 [m].
        amplitude: DVec3,
        /// Time of one swing there and back [s], positive.
        period: f64,
    },
    /// By keys: the centre is displaced by their translation, and the shape turns about its centre by their rotation.
    Keys(RigidMotion),
}

impl Shape {
    /// A sphere at rest: its centre and its radius [m].
    pub fn sphere(centre: DVec3, radius: f64) -> Self {
        Self { form: Form::Sphere { radius }, centre, motion: ShapeMotion::Still }
    }

    /// A capsule at rest: the ends of its line and its radius [m].
    pub fn capsule(ends: [DVec3; 2], radius: f64) -> Self {
        let half_axis = 0.5 * (ends[1] - ends[0]);
        Self { form: Form::Capsule { half_axis, radius }, centre: ends[0] + half_axis, motion: ShapeMotion::Still }
    }

    /// A plane at rest: a point on it [m], and its normal, outward, of any length but zero.
    pub fn plane(point: DVec3, normal: DVec3) -> Self {
        Self { form: Form::Plane { normal: normal.normalize() }, centre: point, motion: ShapeMotion::Still }
    }

    /// A box at rest, along the axes: its centre, its extents and the radius of its edges and corners [m].
    pub fn cuboid(centre: DVec3, size: DVec3, radius: f64) -> Self {
        let form = Form::Box { half_size: 0.5 * size, rotation: DQuat::IDENTITY, radius };
        Self { form, centre, motion: ShapeMotion::Still }
    }

    /// Whether it never moves.
    pub fn is_still(&self) -> bool {
        self.motion == ShapeMotion::Still
    }

    /// Centre [m] and velocity [m/s] at a time [s].
    pub fn at(&self, time: f64) -> (DVec3, DVec3) {
        match &self.motion {
            ShapeMotion::Still => (self.centre, DVec3::ZERO),
            ShapeMotion::Swing { amplitude, period } => {
                let rate = std::f64::consts::TAU / period;
                let (sin, cos) = (rate * time).sin_cos();
                (self.centre + *amplitude * (0.5 * (1.0 - cos)), *amplitude * (0.5 * rate * sin))
            }
            ShapeMotion::Keys(keys) => (self.centre + keys.at(time).0, keys.velocity(time).0),
        }
    }

    /// How it is turned about its centre at a time [s].
    pub fn turn(&self, time: f64) -> DQuat {
        match &self.motion {
            ShapeMotion::Still | ShapeMotion::Swing { .. } => DQuat::IDENTITY,
            ShapeMotion::Keys(keys) => keys.at(time).1,
        }
    }

    /// Angular velocity [rad/s] at a time [s].
    pub fn spin(&self, time: f64) -> DVec3 {
        match &self.motion {
            ShapeMotion::Still | ShapeMotion::Swing { .. } => DVec3::ZERO,
            ShapeMotion::Keys(keys) => keys.velocity(time).1,
        }
    }

    /// How deep a point [m] is inside at a time [s], negative outside [m].
    pub fn depth(&self, point: DVec3, time: f64) -> f64 {
        let from_centre = point - self.at(time).0;
        match self.form {
            Form::Sphere { radius } => radius - from_centre.length(),
            Form::Capsule { half_axis, radius } => {
                let axis = self.turn(time) * half_axis;
                let place = (from_centre.dot(axis) / axis.length_squared()).clamp(-1.0, 1.0);
                radius - (from_centre - axis * place).length()
            }
            Form::Plane { normal } => -from_centre.dot(self.turn(time) * normal),
            Form::Box { half_size, rotation, radius } => {
                let beyond = ((self.turn(time) * rotation).inverse() * from_centre).abs() - (half_size - radius);
                radius - beyond.max(DVec3::ZERO).length() - beyond.max_element().min(0.0)
            }
        }
    }

    /// Its surface at a time [s] as a mesh, to look at; a square of a plane.
    pub fn mesh(&self, time: f64) -> Mesh {
        let centre = self.at(time).0.as_vec3();
        match self.form {
            Form::Sphere { radius } => Mesh::sphere(centre, radius as f32, SPHERE_PARALLELS),
            Form::Capsule { half_axis, radius } => {
                // A sphere around the y axis, its halves drawn apart.
                let mut mesh = Mesh::sphere(Vec3::ZERO, radius as f32, SPHERE_PARALLELS);
                let axis = self.turn(time) * half_axis;
                let turn = DQuat::from_rotation_arc(DVec3::Y, axis.normalize());
                let turned = |vector: Vec3| (turn * vector.as_dvec3()).as_vec3();
                for (position, normal) in mesh.positions.iter_mut().zip(&mut mesh.normals) {
                    let half = if normal.y < 0.0 { -axis } else { axis };
                    *position = turned(*position) + centre + half.as_vec3();
                    *normal = turned(*normal);
                }
                mesh
            }
            Form::Plane { normal } => {
                let normal = self.turn(time) * normal;
                let turn = DQuat::from_rotation_arc(DVec3::Y, normal);
                let corner = |x: f64, z: f64| centre + (turn * DVec3::new(x, 0.0, z) * (0.5 * PLANE_SIDE)).as_vec3();
                Mesh {
                    positions: vec![corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0)],
                    normals: vec![normal.as_vec3(); 4],
                    triangles: vec![[0, 1, 2], [0, 2, 3]],
                }
            }
            Form::Box { half_size, rotation, radius } => {
                let half_size = half_size.as_vec3();
                let mesh = match radius as f32 {
                    0.0 => Mesh::cuboid(-half_size, half_size),
                    radius => rounded_cuboid(half_size - radius, radius),
                };
                let mut mesh = mesh.turned(DMat3::from_quat(self.turn(time) * rotation));
                mesh.positions.iter_mut().for_each(|position| *position += centre);
                mesh
            }
        }
    }

    /// The word that scenes have for its form.
    pub fn name(&self) -> &'static str {
        match self.form {
            Form::Sphere { .. } => "sphere",
            Form::Capsule { .. } => "capsule",
            Form::Plane { .. } => "plane",
            Form::Box { .. } => "box",
        }
    }
}

/// All that lies within a radius of a box around the origin of these half extents [m].
fn rounded_cuboid(core: Vec3, radius: f32) -> Mesh {
    let mut mesh = Mesh::default();
    // The middle of a face stands there twice, so that what is flat lies between.
    let half = |side: f32| {
        (0..=BOX_ARCS).map(move |k| (side, k as f32 / BOX_ARCS as f32 - if side < 0.0 { 1.0 } else { 0.0 }))
    };
    let places: Vec<(f32, f32)> = half(-1.0).chain(half(1.0)).collect();
    let slope = |place: f32| (place * std::f32::consts::FRAC_PI_4).tan();
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        for out in [axis, -axis] {
            let right = Vec3::new(axis.z, axis.x, axis.y);
            let up = out.cross(right);
            let first = mesh.positions.len() as u32;
            for &(v_side, v) in &places {
                for &(u_side, u) in &places {
                    let normal = (out + right * slope(u) + up * slope(v)).normalize();
                    mesh.positions.push((out + right * u_side + up * v_side) * core + normal * radius);
                    mesh.normals.push(normal);
                }
            }
            let width = places.len() as u32;
            for row in 0..width - 1 {
                for a in (0..width - 1).map(|column| first + row * width + column) {
                    mesh.triangles.extend([[a, a + 1, a + width + 1], [a, a + width + 1, a + width]]);
                }
            }
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::{Form, Shape, ShapeMotion};
    use crate::{RigidKey, RigidMotion};
    use glam::{DQuat, DVec3, dvec3};
    use std::f64::consts::PI;

    #[test]
    fn every_motion_has_its_derivative() {
        let key = |time, x, angle| RigidKey {
            time,
            translation: dvec3(x, 0.5, 0.0),
            rotation: DQuat::from_rotation_z(angle),
        };
        let keys = RigidMotion { keys: vec![key(0.0, 0.0, 0.0), key(2.0, 1.0, -3.0)] };
        for motion in [
            ShapeMotion::Still,
            ShapeMotion::Swing { amplitude: dvec3(0.3, -0.1, 0.0), period: 1.3 },
            ShapeMotion::Keys(keys),
        ] {
            let turns = matches!(motion, ShapeMotion::Keys(_));
            let shape = Shape { motion, ..Shape::sphere(dvec3(1.0, 2.0, 3.0), 0.1) };
            let step = 1e-6;
            let [(before, _), (_, velocity), (after, _)] = [0.7 - step, 0.7, 0.7 + step].map(|time| shape.at(time));
            assert!(((after - before) / (2.0 * step)).distance(velocity) < 1e-7, "{shape:?}");
            let spin = if turns { dvec3(0.0, 0.0, -1.5) } else { DVec3::ZERO };
            assert!(shape.spin(0.7).distance(spin) < 1e-12);
        }
    }

    #[test]
    fn the_mesh_of_a_shape_lies_on_its_surface_and_faces_outward() {
        let key = |time, angle| RigidKey {
            time,
            translation: dvec3(0.0, time, 0.0),
            rotation: DQuat::from_rotation_x(angle),
        };
        let motion = ShapeMotion::Keys(RigidMotion { keys: vec![key(0.0, 0.0), key(2.0, 2.0)] });
        let ends = [dvec3(0.1, 0.2, 0.3), dvec3(0.4, -0.5, 0.3)];
        let turned = |radius| {
            let (half_size, rotation) = (dvec3(0.1, 0.2, 0.15), DQuat::from_rotation_z(0.4));
            Shape { form: Form::Box { half_size, rotation, radius }, ..Shape::sphere(DVec3::Y, 0.1) }
        };
        let boxes = [turned(0.0), turned(0.04), turned(0.1)];
        let others = [Shape::sphere(DVec3::X, 0.3), Shape::capsule(ends, 0.1), Shape::plane(ends[0], ends[1])];
        for shape in others.into_iter().chain(boxes) {
            let shape = Shape { motion: motion.clone(), ..shape };
            let mesh = shape.mesh(0.7);
            for (position, normal) in mesh.positions.iter().zip(&mesh.normals) {
                let depth = |way: f32| shape.depth((*position + *normal * way).as_dvec3(), 0.7);
                assert!(depth(0.0).abs() < 1e-6 && (depth(0.01) + 0.01).abs() < 1e-6, "{shape:?}: {position}");
            }
            for triangle in &mesh.triangles {
                let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
                let out = (b - a).cross(c - a);
                assert!(
                    out.length() < 1e-8 || out.dot(mesh.normals[triangle[0] as usize]) > 0.0,
                    "{shape:?} faces outward"
                );
            }
            if let Form::Box { half_size, radius, .. } = shape.form {
                // Steiner: the core, slabs on its faces, quarters of cylinders on its edges, and a ball.
                let core = 2.0 * (half_size - radius);
                let faces = 2.0 * (core.x * core.y + core.y * core.z + core.z * core.x) * radius;
                let edges = PI * radius * radius * core.element_sum();
                let exact = core.element_product() + faces + edges + 4.0 / 3.0 * PI * radius.powi(3);
                let volume = mesh.signed_volume();
                assert!((volume / exact - 1.0).abs() < 5e-3, "{shape:?} is closed: {volume} m³, not {exact}");
            }
        }
    }
}
