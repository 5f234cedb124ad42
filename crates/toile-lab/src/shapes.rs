//! Simple bodies.

use glam::{DVec3, Vec3};
use toile::scene::Mesh;

/// A mesh without those of its triangles whose centre `lost` names: a scan with holes.
pub fn without_triangles(mesh: &Mesh, lost: impl Fn(Vec3) -> bool) -> Mesh {
    let centre = |t: &[u32; 3]| t.iter().map(|i| mesh.positions[*i as usize]).sum::<Vec3>() / 3.0;
    Mesh { triangles: mesh.triangles.iter().filter(|t| !lost(centre(t))).copied().collect(), ..mesh.clone() }
}

/// A cylinder around the z axis from z = −`height` up to 0, with flat ends and `count` sides [m].
pub fn cylinder(radius: f32, height: f32, count: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let mut ring = |z: f32, normal: Option<Vec3>| {
        let first = mesh.positions.len() as u32;
        for k in 0..count {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(count);
            let outward = DVec3::new(angle.cos(), angle.sin(), 0.0).as_vec3();
            mesh.positions.push(outward * radius + Vec3::Z * z);
            mesh.normals.push(normal.unwrap_or(outward));
        }
        first
    };
    let [top, bottom] = [ring(0.0, Some(Vec3::Z)), ring(-height, Some(Vec3::NEG_Z))];
    let [upper, lower] = [ring(0.0, None), ring(-height, None)];
    for k in 1..count - 1 {
        mesh.triangles.extend([[top, top + k, top + k + 1], [bottom, bottom + k + 1, bottom + k]]);
    }
    for k in 0..count {
        let [a, b, c, d] = [lower + k, lower + (k + 1) % count, upper + k, upper + (k + 1) % count];
        mesh.triangles.extend([[a, b, c], [c, b, d]]);
    }
    mesh
}
