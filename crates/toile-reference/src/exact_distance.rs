//! The exact distance to a mesh, for what is measured of a result.

use glam::DVec3;
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQueryWithLocation;
use parry3d_f64::shape::{TriMesh, TriMeshFlags, TrianglePointLocation};
use std::collections::{HashMap, HashSet};
use toile_scene::Mesh;

/// The exact distance to a mesh in f64, with a sign that also holds near holes.
///
/// The sign comes from the angle-weighted pseudo-normal of the nearest feature (Bærentzen and Aanæs 2005). Where that is an
/// edge or vertex at the border of a hole or shared by more than two triangles, a pseudo-normal says nothing; there the
/// winding number decides, which needs all triangles.
pub struct ExactDistance {
    mesh: TriMesh,
    /// Edges, the lower index first, that do not have two triangles.
    open_edges: HashSet<[u32; 2]>,
    /// Vertices of those edges.
    open_vertices: HashSet<u32>,
}

/// How deep points lie inside a mesh [m], positive inside; NaN when a point is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PenetrationSummary {
    /// The deepest point.
    pub max: f64,
    /// The depth that 99 of 100 points do not exceed.
    pub p99: f64,
}

impl ExactDistance {
    /// The distance to a mesh with outward triangles. Vertices at the same place count as one; triangles without area are
    /// left out.
    ///
    /// # Panics
    /// When the mesh has no triangle.
    pub fn new(mesh: &Mesh) -> Self {
        let vertices = mesh.positions.iter().map(|p| vector(p.as_dvec3())).collect();
        let flags = TriMeshFlags::ORIENTED
            | TriMeshFlags::MERGE_DUPLICATE_VERTICES
            | TriMeshFlags::DELETE_DEGENERATE_TRIANGLES
            | TriMeshFlags::DELETE_DUPLICATE_TRIANGLES;
        let mesh = TriMesh::with_flags(vertices, mesh.triangles.clone(), flags)
            .expect("the distance to a mesh needs a triangle");
        let mut triangle_counts: HashMap<[u32; 2], u32> = HashMap::new();
        for triangle in mesh.indices() {
            for side in 0..3 {
                *triangle_counts.entry(edge(triangle, side)).or_default() += 1;
            }
        }
        let open_edges: HashSet<_> =
            triangle_counts.into_iter().filter(|(_, count)| *count != 2).map(|(edge, _)| edge).collect();
        let open_vertices = open_edges.iter().flatten().copied().collect();
        Self { mesh, open_edges, open_vertices }
    }

    /// How deep `point` [m] lies inside the mesh [m]: its distance to the surface, positive inside, negative outside.
    /// NaN for a point that is not finite.
    pub fn penetration(&self, point: DVec3) -> f64 {
        if !point.is_finite() {
            return f64::NAN;
        }
        let point = vector(point);
        let (projection, (triangle, location)) = self.mesh.project_local_point_and_get_location(point, false);
        let distance = (point - projection.point).length();
        let inside =
            if self.is_open(triangle, location) { self.winding_number(point) > 0.5 } else { projection.is_inside };
        if inside { distance } else { -distance }
    }

    /// How deep `points` [m] lie inside the mesh; `None` without points.
    pub fn penetrations(&self, points: impl IntoIterator<Item = DVec3>) -> Option<PenetrationSummary> {
        let mut depths: Vec<f64> = points.into_iter().map(|point| self.penetration(point)).collect();
        // NaN sorts behind every number, so a broken point shows as the maximum.
        depths.sort_by(f64::total_cmp);
        let max = *depths.last()?;
        let rank = (0.99 * depths.len() as f64).ceil() as usize;
        Some(PenetrationSummary { max, p99: depths[rank - 1] })
    }

    fn is_open(&self, triangle: u32, location: TrianglePointLocation) -> bool {
        let triangle = &self.mesh.indices()[triangle as usize];
        match location {
            TrianglePointLocation::OnVertex(corner) => self.open_vertices.contains(&triangle[corner as usize]),
            TrianglePointLocation::OnEdge(side, _) => self.open_edges.contains(&edge(triangle, side as usize)),
            TrianglePointLocation::OnFace(..) | TrianglePointLocation::OnSolid => false,
        }
    }

    /// Part of the full solid angle under which `point` sees the inside of the mesh: 1 inside a closed mesh, 0 outside.
    /// Van Oosterom and Strackee 1983, eq. 8.
    fn winding_number(&self, point: Vector) -> f64 {
        let solid_angle: f64 = self
            .mesh
            .triangles()
            .map(|triangle| {
                let [a, b, c] = [triangle.a - point, triangle.b - point, triangle.c - point];
                let [la, lb, lc] = [a.length(), b.length(), c.length()];
                let volume = a.dot(b.cross(c));
                let spread = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
                2.0 * volume.atan2(spread)
            })
            .sum();
        solid_angle / (4.0 * std::f64::consts::PI)
    }
}

/// Side `side` of a triangle, from corner `side` to the next, the lower index first.
fn edge(triangle: &[u32; 3], side: usize) -> [u32; 2] {
    let [a, b] = [triangle[side], triangle[(side + 1) % 3]];
    [a.min(b), a.max(b)]
}

fn vector(point: DVec3) -> Vector {
    Vector::new(point.x, point.y, point.z)
}
