//! A sphere as a mesh, for pictures and files; the simulation knows it exactly.

use glam::{DVec3, Vec3};
use std::f64::consts::{PI, TAU};
use toile::scene::Mesh;

/// Segments around the equator.
const MERIDIANS: u32 = 96;
/// Segments from pole to pole.
const PARALLELS: u32 = 48;

/// A sphere [m] of meridians and parallels, with exact normals.
pub fn sphere_mesh(centre: DVec3, radius: f64) -> Mesh {
    let rings = (1..PARALLELS).flat_map(|ring| {
        let (sin, cos) = (PI * f64::from(ring) / f64::from(PARALLELS)).sin_cos();
        (0..MERIDIANS).map(move |meridian| {
            let (x, z) = (TAU * f64::from(meridian) / f64::from(MERIDIANS)).sin_cos();
            DVec3::new(sin * x, cos, sin * z)
        })
    });
    let directions: Vec<DVec3> = [DVec3::Y, DVec3::NEG_Y].into_iter().chain(rings).collect();
    let at = |ring: u32, meridian: u32| match ring {
        0 => 0,
        PARALLELS => 1,
        _ => 2 + (ring - 1) * MERIDIANS + meridian % MERIDIANS,
    };
    let mut triangles = Vec::new();
    for ring in 0..PARALLELS {
        for meridian in 0..MERIDIANS {
            let [a, b] = [at(ring, meridian), at(ring, meridian + 1)];
            let [c, d] = [at(ring + 1, meridian), at(ring + 1, meridian + 1)];
            if ring > 0 {
                triangles.push([a, c, b]);
            }
            if ring + 1 < PARALLELS {
                triangles.push([b, c, d]);
            }
        }
    }
    Mesh {
        positions: directions.iter().map(|d| (centre + *d * radius).as_vec3()).collect(),
        normals: directions.iter().map(|d| d.as_vec3()).collect::<Vec<Vec3>>(),
        triangles,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_closed_and_faces_outward() {
        let mesh = sphere_mesh(DVec3::new(1.0, 2.0, 3.0), 0.25);
        let exact = 4.0 / 3.0 * PI * 0.25f64.powi(3);
        assert!((mesh.signed_volume() / exact - 1.0).abs() < 5e-3, "{}", mesh.signed_volume());
        let [low, high] = mesh.bounds().expect("vertices");
        assert!((high - low - Vec3::splat(0.5)).abs().max_element() < 1e-5);
        // V − E + F = 2, with E = 3F/2 when every edge has two triangles.
        assert_eq!(mesh.positions.len() - mesh.triangles.len() / 2, 2);
    }
}
