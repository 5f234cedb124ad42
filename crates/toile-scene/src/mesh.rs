//! A triangle mesh.

use glam::{DMat3, DVec3, Vec3};
use std::f64::consts::{PI, TAU};

/// A triangle mesh with one normal per vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions [m], shape [vertex_count].
    pub positions: Vec<Vec3>,
    /// Unit vertex normals pointing outward, shape [vertex_count].
    pub normals: Vec<Vec3>,
    /// Vertex indices of each triangle, counter-clockwise seen from outside, shape [triangle_count].
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// A sphere of so many parallels and twice as many meridians; vertices of the first meridian stand there twice, those of a pole once for
    /// each meridian.
    pub fn sphere(centre: Vec3, radius: f32, parallels: u32) -> Self {
        let mut mesh = Self::default();
        let meridians = 2 * parallels;
        for row in 0..=parallels {
            let polar = PI * f64::from(row) / f64::from(parallels);
            for column in 0..=meridians {
                // The last column stands exactly on the first, so that no ray passes between them.
                let around = TAU * f64::from(column % meridians) / f64::from(meridians);
                let ring = if row == 0 || row == parallels { 0.0 } else { polar.sin() };
                let normal = DVec3::new(ring * around.cos(), polar.cos(), ring * around.sin()).as_vec3();
                mesh.normals.push(normal);
                mesh.positions.push(centre + normal * radius);
            }
        }
        for row in 0..parallels {
            for column in 0..meridians {
                let a = row * (meridians + 1) + column;
                let [b, c, d] = [a + 1, a + meridians + 1, a + meridians + 2];
                // At a pole one of the two has no area.
                if row > 0 {
                    mesh.triangles.push([a, b, c]);
                }
                if row + 1 < parallels {
                    mesh.triangles.push([b, d, c]);
                }
            }
        }
        mesh
    }

    /// An axis-aligned box with flat faces: four vertices for each of them.
    pub fn cuboid(low: Vec3, high: Vec3) -> Self {
        let mut mesh = Self::default();
        let [centre, half] = [(low + high) * 0.5, (high - low) * 0.5];
        for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
            for normal in [axis, -axis] {
                let right = Vec3::new(axis.z, axis.x, axis.y);
                let up = normal.cross(right);
                let first = mesh.positions.len() as u32;
                for (u, v) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                    mesh.positions.push(centre + (normal + right * u + up * v) * half);
                    mesh.normals.push(normal);
                }
                mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            }
        }
        mesh
    }

    /// Smallest and largest corner of the axis-aligned box around all vertices [m]; `None` for a mesh without vertices.
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold([first, first], |[low, high], p| [low.min(*p), high.max(*p)]))
    }

    /// Area of all triangles [m²].
    pub fn area(&self) -> f64 {
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| self.positions[i as usize].as_dvec3());
            0.5 * (b - a).cross(c - a).length()
        };
        self.triangles.iter().map(area).sum()
    }

    /// The mesh turned about the origin.
    pub fn turned(&self, turn: DMat3) -> Self {
        let turned = |v: &Vec3| (turn * v.as_dvec3()).as_vec3();
        Self {
            positions: self.positions.iter().map(turned).collect(),
            normals: self.normals.iter().map(turned).collect(),
            triangles: self.triangles.clone(),
        }
    }

    /// Enclosed volume [m³] by the divergence theorem; negative when the triangles face inward.
    /// Meaningful up to the volume of the missing caps, seen from the centre of the bounds, when the mesh has holes.
    pub fn signed_volume(&self) -> f64 {
        let Some([low, high]) = self.bounds() else { return 0.0 };
        let centre = low.as_dvec3().midpoint(high.as_dvec3());
        self.triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| self.positions[i as usize].as_dvec3() - centre);
                a.dot(b.cross(c)) / 6.0
            })
            .sum()
    }

    /// Unit vertex normals from the triangles, weighted by their area; shape [vertex_count].
    /// A vertex without area gets +y, so that no normal is ever non-finite.
    pub fn area_weighted_normals(&self) -> Vec<Vec3> {
        let mut sums = vec![DVec3::ZERO; self.positions.len()];
        for t in &self.triangles {
            let [a, b, c] = t.map(|i| self.positions[i as usize].as_dvec3());
            let area = (b - a).cross(c - a);
            for i in t {
                sums[*i as usize] += area;
            }
        }
        sums.iter().map(|n| n.try_normalize().unwrap_or(DVec3::Y).as_vec3()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_is_round_and_faces_outward() {
        let mesh = Mesh::sphere(Vec3::new(1.0, 2.0, 3.0), 0.25, 48);
        let exact = 4.0 / 3.0 * PI * 0.25_f64.powi(3);
        assert!((mesh.signed_volume() / exact - 1.0).abs() < 5e-3, "{}", mesh.signed_volume());
        let [low, high] = mesh.bounds().expect("vertices");
        assert!((high - low - Vec3::splat(0.5)).abs().max_element() < 1e-5);
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            (b - a).cross(c - a).length()
        };
        assert!(mesh.triangles.iter().all(|triangle| area(triangle) > 0.0));
        assert_eq!(mesh.triangles.len(), 2 * 96 * 47);
    }

    #[test]
    fn a_cuboid_is_closed_and_faces_outward() {
        let [low, high] = [Vec3::new(-1.0, 0.0, 2.0), Vec3::new(1.0, 3.0, 2.5)];
        let mesh = Mesh::cuboid(low, high);
        assert_eq!(mesh.bounds(), Some([low, high]));
        assert!((mesh.signed_volume() - 3.0).abs() < 1e-6, "{}", mesh.signed_volume());
        let facing = mesh.area_weighted_normals();
        assert!(facing.iter().zip(&mesh.normals).all(|(a, b)| a.distance(*b) < 1e-6));
    }
}
