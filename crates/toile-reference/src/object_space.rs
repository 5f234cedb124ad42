//! Collision in object space, the classic way, as a baseline for what the maps do. D §7, W §6.

use crate::Probe;
use glam::Vec3;
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::TriMesh;
use toile_model::StepSettings;
use toile_scene::Mesh;

/// How deep under the surface a face still answers [m]; what is deeper has passed through unseen.
const DEPTH: f64 = 0.03;

/// Below this part of the height are the legs; beyond this part of it from the middle are the arms.
const LEGS: f32 = 0.46;
const ARMS: f32 = 0.115;

/// A body as D and W §6 test it in object space: its parts, each a tree of bounding boxes whose leaves are faces with their normals.
#[derive(Clone, Debug)]
pub struct ObjectSpace {
    parts: Vec<TriMesh>,
}

impl ObjectSpace {
    /// Torso, two arms and two legs of a standing body, by the places of its faces: where a person of that height has them.
    pub fn standing(body: &Mesh) -> Self {
        let Some([low, high]) = body.bounds() else { return Self { parts: Vec::new() } };
        let [height, middle] = [high.y - low.y, 0.5 * (low.x + high.x)];
        let part = |triangle: &[u32; 3]| {
            let centre = triangle.iter().map(|i| body.positions[*i as usize]).sum::<Vec3>() / 3.0;
            let right = usize::from(centre.x > middle);
            if (centre.x - middle).abs() > ARMS * height {
                1 + right
            } else if centre.y - low.y < LEGS * height {
                3 + right
            } else {
                0
            }
        };
        let faces_of = |wanted: usize| body.triangles.iter().filter(|t| part(t) == wanted).copied().collect();
        Self::of_parts(body, (0..5).map(faces_of))
    }

    /// A body of one part.
    pub fn whole(body: &Mesh) -> Self {
        Self::of_parts(body, [body.triangles.clone()])
    }

    fn of_parts(body: &Mesh, parts: impl IntoIterator<Item = Vec<[u32; 3]>>) -> Self {
        let vertices: Vec<Vector> = body.positions.iter().map(|p| vector(*p)).collect();
        let tree = |faces: Vec<[u32; 3]>| TriMesh::new(vertices.clone(), faces).ok();
        Self { parts: parts.into_iter().filter_map(tree).collect() }
    }

    /// Number of parts that have faces.
    pub fn part_count(&self) -> usize {
        self.parts.len()
    }

    /// The face next to each point, with the cloth's thickness on it, or none within reach of the coming move. All arrays have the shape
    /// [point_count].
    pub fn probes(&self, positions: &[Vec3], velocities: &[Vec3], settings: &StepSettings) -> Vec<Probe> {
        positions
            .iter()
            .zip(velocities)
            .map(|(position, velocity)| self.probe(*position, *velocity, settings))
            .collect()
    }

    fn probe(&self, position: Vec3, velocity: Vec3, settings: &StepSettings) -> Probe {
        if !(position.is_finite() && velocity.is_finite()) {
            return Probe::default();
        }
        let point = vector(position);
        let travel = f64::from(velocity.length() * settings.dt);
        let mut reach = DEPTH.max(f64::from(settings.thickness + settings.contact_margin)) + travel;
        let mut probe = Probe::default();
        for part in &self.parts {
            let found = part.project_local_point_and_get_location_with_max_dist(point, false, reach);
            let Some((projection, (face, _))) = found else { continue };
            let Some(normal) = part.triangle(face).normal() else { continue };
            let way = point - projection.point;
            reach = way.length();
            let normal = Vec3::new(normal.x as f32, normal.y as f32, normal.z as f32);
            let distance = way.dot(vector(normal)) as f32 - settings.thickness;
            probe = Probe { normal, distance, velocity: Vec3::ZERO, hit: true };
        }
        probe
    }
}

fn vector(point: Vec3) -> Vector {
    let point = point.as_dvec3();
    Vector::new(point.x, point.y, point.z)
}
