//! All meshes of a picture as one list of triangles.

use super::{Drawn, Material, PictureError};
use glam::{DVec3, Vec3};

/// All meshes as one list of triangles, moved and scaled so that the box around them is centred on the origin and just
/// inside the unit sphere. Lengths below are therefore free of units and no finite input overflows.
pub struct Soup {
    /// Vertex positions, shape [vertex_count].
    pub positions: Vec<Vec3>,
    /// Vertex normals, shape [vertex_count].
    pub normals: Vec<Vec3>,
    /// Vertex indices of each triangle, shape [triangle_count].
    pub triangles: Vec<[u32; 3]>,
    /// Index into `materials`, shape [triangle_count].
    pub triangle_materials: Vec<u32>,
    /// One per drawn mesh.
    pub materials: Vec<Material>,
    /// Half the size of the box.
    pub half: Vec3,
    /// What the camera frames: the vertices, or the upright cylinder in the box that was asked for, which is as wide from all sides.
    pub framed: Vec<Vec3>,
}

impl Soup {
    /// Gathers the meshes and refuses what cannot be drawn. The box is that around them, or the given one.
    pub fn new(drawn: &[Drawn], stage: Option<[Vec3; 2]>) -> Result<Self, PictureError> {
        refuse_non_finite(drawn)?;
        let used = drawn.iter().flat_map(|d| d.mesh.triangles.iter().flatten().map(|i| seen(d, *i)));
        let around = used.fold((DVec3::splat(f64::INFINITY), DVec3::splat(f64::NEG_INFINITY)), |(low, high), p| {
            (low.min(p), high.max(p))
        });
        let (low, high) = stage.map_or(around, |[low, high]| (low.as_dvec3(), high.as_dvec3()));
        let radius = 0.5 * (high - low).length();
        if !radius.is_finite() || radius == 0.0 {
            return Err(PictureError::Empty);
        }
        let centre = 0.5 * (low + high);

        let mut soup = Self {
            positions: Vec::new(),
            normals: Vec::new(),
            triangles: Vec::new(),
            triangle_materials: Vec::new(),
            materials: drawn.iter().map(|d| d.material).collect(),
            half: (0.5 * (high - low) / radius).as_vec3(),
            framed: Vec::new(),
        };
        for (index, drawn) in drawn.iter().enumerate() {
            let mesh = drawn.mesh;
            // Only vertices that a triangle uses: the others may lie far outside the frame.
            let mut places = vec![None; mesh.positions.len()];
            for t in &mesh.triangles {
                let corners = t.map(|i| {
                    *places[i as usize].get_or_insert_with(|| {
                        soup.positions.push(((seen(drawn, i) - centre) / radius).as_vec3());
                        soup.normals.push(mesh.normals[i as usize]);
                        soup.positions.len() as u32 - 1
                    })
                });
                soup.triangles.push(corners);
            }
            soup.triangle_materials.resize(soup.triangles.len(), index as u32);
        }
        soup.framed = if stage.is_some() { upright_cylinder(soup.half) } else { soup.positions.clone() };
        Ok(soup)
    }
}

/// Where a vertex is seen.
fn seen(drawn: &Drawn, vertex: u32) -> DVec3 {
    let [position, normal] = [&drawn.mesh.positions, &drawn.mesh.normals].map(|all| all[vertex as usize].as_dvec3());
    position + normal * f64::from(drawn.thickness)
}

/// Points on the rims of an upright cylinder that is as high as a box and as wide as its wider side.
fn upright_cylinder(half: Vec3) -> Vec<Vec3> {
    let radius = half.x.max(half.z);
    let point = |k: u32| {
        let (sin, cos) = (k as f32 * std::f32::consts::TAU / 72.0).sin_cos();
        [-half.y, half.y].map(|y| Vec3::new(radius * cos, y, radius * sin))
    };
    (0..72).flat_map(point).collect()
}

fn refuse_non_finite(drawn: &[Drawn]) -> Result<(), PictureError> {
    let mut first = None;
    let mut count = 0;
    for (index, Drawn { mesh, .. }) in drawn.iter().enumerate() {
        assert_eq!(mesh.positions.len(), mesh.normals.len(), "a mesh has one normal per vertex");
        for (vertex, (p, n)) in mesh.positions.iter().zip(&mesh.normals).enumerate() {
            if !(p.is_finite() && n.is_finite()) {
                first = first.or(Some((index, vertex)));
                count += 1;
            }
        }
    }
    match first {
        Some((mesh, vertex)) => Err(PictureError::NonFinite { count, mesh, vertex }),
        None => Ok(()),
    }
}
