//! Paths and generated files that several tests share.

use glam::{Vec3, vec3};
use std::f32::consts::{PI, TAU};
use std::path::{Path, PathBuf};
use toile_scene::Mesh;

/// A file of the repository's fixtures.
pub fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(name)
}

/// The folder of real patterns and bodies that lies beside the repository on some machines.
///
/// # Panics
/// Where it does not.
pub fn real_data() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    assert!(folder.is_dir(), "{} is not there", folder.display());
    folder
}

/// A closed ellipsoid 1.6 m tall that stands on the floor.
pub fn ellipsoid() -> Mesh {
    let (around, along) = (12u32, 10u32);
    let radii = vec3(0.25, 0.8, 0.2);
    let centre = vec3(0.0, 0.8, 0.0);
    let mut unit = vec![Vec3::Y];
    for ring in 1..along {
        let polar = PI * ring as f32 / along as f32;
        for step in 0..around {
            let (sin, cos) = (TAU * step as f32 / around as f32).sin_cos();
            unit.push(vec3(polar.sin() * sin, polar.cos(), polar.sin() * cos));
        }
    }
    unit.push(-Vec3::Y);
    let last = unit.len() as u32 - 1;
    let at = |ring: u32, step: u32| 1 + (ring - 1) * around + step % around;
    let mut triangles = Vec::new();
    for step in 0..around {
        triangles.push([0, at(1, step), at(1, step + 1)]);
        triangles.push([last, at(along - 1, step + 1), at(along - 1, step)]);
        for ring in 1..along - 1 {
            let [a, b] = [at(ring, step), at(ring, step + 1)];
            let [c, d] = [at(ring + 1, step + 1), at(ring + 1, step)];
            triangles.push([a, d, c]);
            triangles.push([a, c, b]);
        }
    }
    let positions = unit.iter().map(|p| *p * radii + centre).collect();
    let mut mesh = Mesh { positions, normals: Vec::new(), triangles };
    mesh.normals = mesh.area_weighted_normals();
    mesh
}

/// OBJ text without normals.
pub fn obj_text(mesh: &Mesh) -> String {
    let vertices = mesh.positions.iter().map(|p| format!("v {} {} {}\n", p.x, p.y, p.z));
    let faces = mesh.triangles.iter().map(|t| {
        let [a, b, c] = t.map(|index| index + 1);
        format!("f {a} {b} {c}\n")
    });
    vertices.chain(faces).collect()
}

/// A binary PLY.
pub fn ply_bytes(mesh: &Mesh, big_endian: bool) -> Vec<u8> {
    let encoding = if big_endian { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{encoding}_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions.len(),
        mesh.triangles.len(),
    )
    .into_bytes();
    let order = |word: u32| if big_endian { word.to_be_bytes() } else { word.to_le_bytes() };
    for position in &mesh.positions {
        position.to_array().iter().for_each(|x| bytes.extend(order(x.to_bits())));
        bytes.push(200);
    }
    for triangle in &mesh.triangles {
        bytes.push(3);
        triangle.iter().for_each(|index| bytes.extend(order(*index)));
    }
    bytes
}

/// Two rectangular panels sewn at both sides, with the panels' text to change.
pub fn garment_text() -> String {
    r#"{"pattern": {"panels": {
        "front": {"translation": [-15, 60, 20], "rotation": [0, 0, 0],
            "vertices": [[0, 0], [30, 0], [30, 40], [0, 40]],
            "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]},
                      {"endpoints": [2, 3], "label": "lower_interface"}, {"endpoints": [3, 0]}]},
        "back": {"translation": [-15, 60, -15], "rotation": [0, 0, 0],
            "vertices": [[0, 0], [0, 40], [30, 40], [30, 0]],
            "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]},
                      {"endpoints": [2, 3]}, {"endpoints": [3, 0]}]}},
     "stitches": [[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 2}],
                  [{"panel": "front", "edge": 3}, {"panel": "back", "edge": 0}, "right_wrong"]]},
     "properties": {"units_in_meter": 100}}"#
        .into()
}

/// A value with some of its fields set.
pub fn with<T>(mut value: T, set: impl FnOnce(&mut T)) -> T {
    set(&mut value);
    value
}
