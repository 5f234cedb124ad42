//! A triangle mesh.

use glam::{DVec3, Vec3};

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
    /// Smallest and largest corner of the axis-aligned box around all vertices [m]; `None` for a mesh without vertices.
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let first = *self.positions.first()?;
        Some(self.positions.iter().fold([first, first], |[low, high], p| [low.min(*p), high.max(*p)]))
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
