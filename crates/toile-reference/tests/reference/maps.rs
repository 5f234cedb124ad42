//! The papers' maps of meshes against their analytic shapes.

use glam::{Vec3, vec3};
use toile_reference::maps::{SideMaps, Surface, render_sides};
use toile_scene::Mesh;

const CENTRE: Vec3 = vec3(0.3, 0.7, -0.2);

/// World x and y of the centre of each texel with its index.
fn centres(maps: &SideMaps) -> Vec<(usize, f32, f32)> {
    let map_box = maps.map_box;
    let centres = (0..map_box.rows).flat_map(|row| (0..map_box.columns).map(move |column| (column, row)));
    centres
        .map(|(column, row)| {
            (
                (row * map_box.columns + column) as usize,
                map_box.origin_x + (column as f32 + 0.5) * map_box.texel,
                map_box.origin_y - (row as f32 + 0.5) * map_box.texel,
            )
        })
        .collect()
}

/// Largest differences of height [m] and of normal [1] from a sphere of `radius` [m] in the texels of its inner 90 %.
fn sphere_errors(maps: &SideMaps, radius: f32) -> (f32, f32) {
    let range = maps.map_box.z_front - maps.map_box.z_back;
    let mut errors = (0.0_f32, 0.0_f32);
    for (texel, x, y) in centres(maps) {
        let [dx, dy] = [x - CENTRE.x, y - CENTRE.y];
        let reach = dx.hypot(dy) / radius;
        let depths = [maps.depth[0][texel], maps.depth[1][texel]];
        if reach > 1.0 {
            assert_eq!(depths, [1.0, 1.0], "a texel outside the sphere shows something");
        } else if reach < 0.9 {
            let dz = (radius * radius - dx * dx - dy * dy).sqrt();
            let front = maps.map_box.z_front - depths[0] * range;
            let back = maps.map_box.z_back + depths[1] * range;
            errors.0 = errors.0.max((front - CENTRE.z - dz).abs()).max((back - CENTRE.z + dz).abs());
            for (layer, z) in [dz, -dz].into_iter().enumerate() {
                let normal = vec3(dx, dy, z) / radius;
                errors.1 = errors.1.max(maps.normals[layer][texel].distance(normal));
            }
        }
    }
    errors
}

#[test]
fn a_sphere_has_the_depth_and_normals_of_a_sphere() {
    // Flat facets lie up to r·(1 − cos(π/2n))·2 = 0.02 mm inside, at 90 % of the radius 2.3 times that along z.
    let mesh = Mesh::sphere(CENTRE, 0.25, 128);
    let maps = render_sides(&[Surface { mesh: &mesh, thickness: 0.0, velocities: None, open: false }], 0.005);
    let (height, normal) = sphere_errors(&maps, 0.25);
    assert!(height < 1e-4 && normal < 2e-3, "{height} {normal}");
}

#[test]
fn thickness_makes_a_larger_sphere_evenly() {
    let mesh = Mesh::sphere(CENTRE, 0.25, 128);
    let maps = render_sides(&[Surface { mesh: &mesh, thickness: 0.01, velocities: None, open: false }], 0.005);
    let (height, normal) = sphere_errors(&maps, 0.26);
    assert!(height < 1e-4 && normal < 2e-3, "{height} {normal}");
}

#[test]
fn the_oracle_of_the_sphere_sees_swapped_sides() {
    let mesh = Mesh::sphere(CENTRE, 0.25, 128);
    let mut maps = render_sides(&[Surface { mesh: &mesh, thickness: 0.0, velocities: None, open: false }], 0.005);
    maps.normals.swap(0, 1);
    assert!(sphere_errors(&maps, 0.25).1 > 0.5);
}

#[test]
fn row_0_is_the_top_and_column_0_the_left() {
    let [big, flag] = [
        Mesh::cuboid(vec3(-0.1, -0.1, -0.1), vec3(0.1, 0.1, 0.1)),
        Mesh::cuboid(vec3(0.1, 0.1, 0.2), vec3(0.2, 0.3, 0.3)),
    ];
    let surfaces = [&big, &flag].map(|mesh| Surface { mesh, thickness: 0.0, velocities: None, open: false });
    let maps = render_sides(&surfaces, 0.01);
    let range = maps.map_box.z_front - maps.map_box.z_back;
    for (texel, x, y) in centres(&maps) {
        let inside = |low: f32, high: f32, value: f32| value > low + 1e-4 && value < high - 1e-4;
        let expected = if inside(0.1, 0.2, x) && inside(0.1, 0.3, y) {
            Some((0.3, 0.2))
        } else if inside(-0.1, 0.1, x) && inside(-0.1, 0.1, y) {
            Some((0.1, -0.1))
        } else {
            None
        };
        match expected {
            Some((front, back)) => {
                assert!((maps.map_box.z_front - maps.depth[0][texel] * range - front).abs() < 1e-6);
                assert!((maps.map_box.z_back + maps.depth[1][texel] * range - back).abs() < 1e-6);
                assert_eq!((maps.normals[0][texel], maps.normals[1][texel]), (Vec3::Z, Vec3::NEG_Z));
            }
            None => assert_eq!([maps.depth[0][texel], maps.depth[1][texel]], [1.0, 1.0]),
        }
    }
}

#[test]
fn the_nearest_surface_is_seen_whatever_the_order() {
    let [near, far] = [
        Mesh::cuboid(vec3(-0.1, -0.1, 0.1), vec3(0.1, 0.1, 0.2)),
        Mesh::cuboid(vec3(-0.1, -0.1, -0.2), vec3(0.1, 0.1, -0.1)),
    ];
    let surfaces = [&near, &far].map(|mesh| Surface { mesh, thickness: 1e-3, velocities: None, open: false });
    let maps = render_sides(&surfaces, 0.01);
    let turned = render_sides(&[surfaces[1], surfaces[0]], 0.01);
    assert_eq!(maps, turned);
    let texel = 10 * maps.map_box.columns as usize + 10;
    // A tenth of the box lies before each.
    assert!(maps.depth[0][texel] < 0.1 && maps.depth[1][texel] < 0.1);
}

#[test]
fn an_inverted_mesh_still_faces_the_cameras() {
    let mut mesh = Mesh::sphere(CENTRE, 0.25, 32);
    for normal in &mut mesh.normals {
        *normal = -*normal;
    }
    let maps = render_sides(&[Surface { mesh: &mesh, thickness: 0.0, velocities: None, open: false }], 0.01);
    for (texel, ..) in centres(&maps) {
        assert!(maps.normals[0][texel].z >= 0.0 && maps.normals[1][texel].z <= 0.0);
    }
}
