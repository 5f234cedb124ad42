//! Layered maps: the device draws them bit for bit as the reference does, and they see limbs, overlaps, holes and large triangles.

use glam::{Vec3, vec3};
use toile_gpu::{MapSpace, Surface};
use toile_lab::DrawnMaps;
use toile_lab::fixtures::body;
use toile_lab::shapes::without_triangles;
use toile_model::MapBox;
use toile_reference::maps::{self, DrawnLayers, LayerMaps, draw_layers};
use toile_scene::{MapKind, Mesh};
use toile_workspace::gpu;

const TEXEL: f32 = 0.005;

/// Bodies with smooth, flat, real, broken, overlapping and large surfaces.
fn bodies() -> Vec<(&'static str, Mesh)> {
    let woman = body();
    let hole = |centre: Vec3| centre.z > 0.0 && centre.distance(vec3(0.0, 1.2, 0.0)) < 0.25;
    vec![
        ("sphere", Mesh::sphere(vec3(0.1, 1.0, 0.0), 0.3, 32)),
        ("box", Mesh::cuboid(vec3(-0.2, 0.1, -0.1), vec3(0.23, 0.5, 0.2))),
        ("floor", Mesh::cuboid(vec3(-1.5, -0.1, -1.5), vec3(1.5, 0.0, 1.5))),
        ("body with holes", without_triangles(&woman, hole)),
        ("body", woman),
    ]
}

/// Where the device's maps differ from the reference's.
fn difference(device: &LayerMaps, reference: &LayerMaps) -> Option<String> {
    assert_eq!(device.columns.len(), reference.columns.len());
    let layers = |maps: &LayerMaps, column: usize| {
        let found = maps.columns[column];
        let range = found.first as usize..(found.first + found.end_count + found.sheet_count) as usize;
        let bits = |v: Vec3| v.to_array().map(f32::to_bits);
        let layer = |k: usize| {
            let velocity = maps.velocities.as_ref().map(|all| bits(all[k]));
            (maps.depths[k].to_bits(), bits(maps.normals[k]), velocity)
        };
        (found.end_count, found.sheet_count, range.map(layer).collect::<Vec<_>>())
    };
    let column = (0..device.columns.len()).find(|column| layers(device, *column) != layers(reference, *column))?;
    Some(format!("column {column}: {:?} instead of {:?}", layers(device, column), layers(reference, column)))
}

fn drawn(surfaces: &[maps::Surface], map_box: MapBox) -> (DrawnMaps, DrawnLayers) {
    let moving = surfaces.iter().any(|surface| surface.velocities.is_some());
    let uploaded: Vec<Surface> = surfaces
        .iter()
        .map(|surface| {
            let velocities = surface.velocities.map(|all| {
                let padded: Vec<_> = all.iter().map(|v| v.extend(0.0)).collect();
                gpu().upload(bytemuck::cast_slice(&padded), wgpu::BufferUsages::STORAGE)
            });
            let still = Surface::new(&gpu().device, surface.mesh, map_box.texel);
            Surface { velocities, open: surface.open, ..still }
        })
        .collect();
    let area = surfaces.iter().map(|surface| surface.mesh.area()).sum();
    let space = MapSpace { kind: MapKind::Layers, map_box, moving, area };
    let pairs: Vec<_> = uploaded.iter().map(|surface| (surface, 0.0)).collect();
    let device = DrawnMaps::draw_surfaces(gpu(), &pairs, &space).expect("the device answers");
    (device, draw_layers(surfaces, map_box))
}

#[test]
fn the_device_draws_what_the_reference_draws() {
    for (name, mesh) in bodies() {
        for texel in [TEXEL, 3.7 * TEXEL] {
            let map_box = MapBox::around(mesh.bounds().expect("it has vertices"), texel);
            let surface = maps::Surface { mesh: &mesh, thickness: 0.0, velocities: None, open: false };
            let (device, reference) = drawn(&[surface], map_box);
            assert!(reference.maps.depths.len() > 300, "{name} at {texel} m: {} layers", reference.maps.depths.len());
            assert_eq!(difference(device.layers(), &reference.maps), None, "{name} at {texel} m");
            assert_eq!(device.maps.fault(), None, "{name} at {texel} m");
        }
    }
}
