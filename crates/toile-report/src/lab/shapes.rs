//! Simple bodies.

use glam::{DVec3, Vec3};
use toile::scene::Mesh;

/// A sphere of `2·count` meridians and `count` parallels, its triangles outward.
pub fn uv_sphere(centre: Vec3, radius: f32, count: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let columns = 2 * count;
    for row in 0..=count {
        let polar = std::f64::consts::PI * f64::from(row) / f64::from(count);
        for column in 0..=columns {
            // The last column stands exactly on the first, so that no ray passes between them.
            let around = std::f64::consts::TAU * f64::from(column % columns) / f64::from(columns);
            let ring = if row == 0 || row == count { 0.0 } else { polar.sin() };
            let normal = DVec3::new(ring * around.cos(), polar.cos(), ring * around.sin()).as_vec3();
            mesh.normals.push(normal);
            mesh.positions.push(centre + normal * radius);
        }
    }
    for row in 0..count {
        for column in 0..columns {
            let a = row * (columns + 1) + column;
            let [b, c, d] = [a + 1, a + columns + 1, a + columns + 2];
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    mesh
}

/// An axis-aligned box with flat faces: four vertices for each of them.
pub fn box_mesh(low: Vec3, high: Vec3) -> Mesh {
    let mut mesh = Mesh::default();
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
