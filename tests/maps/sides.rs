//! The papers' maps that the device draws are those that the reference casts, and the surface in them is the body with its thickness.

use glam::{Vec3, vec3};
use toile_lab::DrawnMaps;
use toile_lab::fixtures::body;
use toile_lab::shapes::without_triangles;
use toile_model::SideBox;
use toile_reference::ExactDistance;
use toile_reference::maps::{SideMaps, Surface, render_sides};
use toile_scene::{MapKind, Mesh};
use toile_workspace::gpu;

const TEXEL: f32 = 0.005;
const THICKNESS: f32 = 0.004;

/// Depths may differ by this [m]: f32 coordinates of a body of 2 m have steps of 1e-7 m, and a handful of them add up.
const DEPTH_ATOL: f32 = 1e-6;

/// And by the slope of the surface over this part of a texel: rasterisers put vertices on a grid of 1/256 texel.
const DEPTH_RTOL: f32 = 1.0 / 256.0;

/// Unit normals may differ by this: the same grid moves the place where they are interpolated.
const NORMAL_TOLERANCE: f32 = 2e-3;

/// Part of the texels in which another triangle may win, because the border between two passes by the texel's centre within
/// the same grid: most at the rim of holes and in coarse maps.
const EDGE_FRACTION: f32 = 2e-3;

/// How the device's maps differ from the reference's.
#[derive(Debug, Default)]
struct Comparison {
    /// Texels that either sees, on both sides.
    seen: usize,
    /// Texels that only one of them sees.
    edges: usize,
    /// Texels whose depths differ by more than the tolerance.
    deep: usize,
    /// Texels whose normals differ by more than the tolerance.
    turned: usize,
}

impl Comparison {
    fn new(device: &SideMaps, reference: &SideMaps) -> Self {
        assert_eq!(device.map_box, reference.map_box);
        let range = device.map_box.z_front - device.map_box.z_back;
        let mut comparison = Self::default();
        for side in 0..2 {
            for texel in 0..device.depth[side].len() {
                let depths = [device, reference].map(|maps| maps.depth[side][texel]);
                if depths == [1.0, 1.0] {
                    continue;
                }
                comparison.seen += 1;
                if depths.contains(&1.0) {
                    comparison.edges += 1;
                    continue;
                }
                let normals = [device, reference].map(|maps| maps.normals[side][texel]);
                let slope = normals[1].truncate().length() / normals[1].z.abs();
                let tolerance = DEPTH_ATOL + DEPTH_RTOL * device.map_box.texel * slope;
                let error = (depths[0] - depths[1]).abs() * range;
                comparison.deep += usize::from(error.is_nan() || error > tolerance);
                let turn = (normals[0] - normals[1]).length();
                comparison.turned += usize::from(turn.is_nan() || turn > NORMAL_TOLERANCE);
            }
        }
        comparison
    }

    fn agrees(&self) -> bool {
        let few = EDGE_FRACTION * self.seen as f32;
        [self.edges, self.deep, self.turned].into_iter().all(|count| count as f32 <= few)
    }
}

/// Bodies with smooth, flat, real and broken surfaces.
fn bodies() -> Vec<(&'static str, Mesh)> {
    let woman = body();
    let hole = |centre: Vec3| centre.z > 0.0 && centre.distance(vec3(0.0, 1.2, 0.0)) < 0.25;
    vec![
        ("sphere", Mesh::sphere(vec3(0.1, 1.0, 0.0), 0.3, 32)),
        ("box", Mesh::cuboid(vec3(-0.2, 0.1, -0.1), vec3(0.23, 0.5, 0.2))),
        ("body with holes", without_triangles(&woman, hole)),
        ("body", woman),
    ]
}

#[test]
fn the_device_draws_what_the_reference_casts() {
    for (name, mesh) in bodies() {
        for texel in [TEXEL, 3.7 * TEXEL] {
            let layers =
                DrawnMaps::draw(gpu(), MapKind::Sides, &[(&mesh, THICKNESS)], texel).expect("the device answers");
            let reference =
                render_sides(&[Surface { mesh: &mesh, thickness: THICKNESS, velocities: None, open: false }], texel);
            let comparison = Comparison::new(layers.sides(), &reference);
            assert!(comparison.seen > 500 && comparison.agrees(), "{name} at {texel} m: {comparison:?}");
        }
    }
}

#[test]
fn several_surfaces_share_the_maps() {
    let [ball, block] =
        [Mesh::sphere(vec3(0.0, 0.2, 0.0), 0.2, 24), Mesh::cuboid(vec3(-0.3, 0.0, 0.0), vec3(0.0, 0.2, 0.3))];
    let layers =
        DrawnMaps::draw(gpu(), MapKind::Sides, &[(&ball, 0.01), (&block, 0.002)], TEXEL).expect("the device answers");
    let surfaces = [
        Surface { mesh: &ball, thickness: 0.01, velocities: None, open: false },
        Surface { mesh: &block, thickness: 0.002, velocities: None, open: false },
    ];
    let comparison = Comparison::new(layers.sides(), &render_sides(&surfaces, TEXEL));
    assert!(comparison.agrees(), "{comparison:?}");
}

/// Saboteurs: another thickness, a normal of the other sign, the back taken for the front.
#[test]
fn wrong_maps_are_found() {
    let ball = Mesh::sphere(vec3(0.1, 1.0, 0.0), 0.3, 32);
    let layers = DrawnMaps::draw(gpu(), MapKind::Sides, &[(&ball, THICKNESS)], TEXEL).expect("the device answers");
    let right = layers.sides();
    let thinner = DrawnMaps::draw_in(gpu(), MapKind::Sides, &[(&ball, 0.9 * THICKNESS)], layers.maps.space().map_box)
        .expect("the device answers");
    assert!(!Comparison::new(right, thinner.sides()).agrees(), "thickness");
    let mut turned = right.clone();
    turned.normals[0].iter_mut().for_each(|normal| normal.x = -normal.x);
    assert!(!Comparison::new(right, &turned).agrees(), "normals");
    let lying = DrawnMaps::draw(
        gpu(),
        MapKind::Sides,
        &[(&Mesh::cuboid(vec3(-0.2, 0.0, -0.1), vec3(0.2, 0.3, 0.3)), 0.0)],
        TEXEL,
    )
    .expect("the device answers");
    let lying = lying.sides();
    let mut swapped = lying.clone();
    swapped.depth.swap(0, 1);
    swapped.normals.swap(0, 1);
    assert!(!Comparison::new(lying, &swapped).agrees(), "sides");
}

/// Distances [m] from the true body to the surface in the maps, sorted.
fn distances(mesh: &Mesh, thickness: f32) -> Vec<f64> {
    let maps = DrawnMaps::draw(gpu(), MapKind::Sides, &[(mesh, thickness)], TEXEL).expect("the device answers");
    let maps = maps.sides();
    let SideBox { origin_x, origin_y, texel, columns, z_front, z_back, .. } = maps.map_box;
    let exact = ExactDistance::new(mesh);
    let mut distances = Vec::new();
    for (side, sign) in [(0, 1.0), (1, -1.0)] {
        let plane = if side == 0 { z_front } else { z_back };
        for index in (0..maps.depth[side].len()).step_by(5) {
            let depth = maps.depth[side][index];
            if depth < 1.0 {
                let x = origin_x + ((index as u32 % columns) as f32 + 0.5) * texel;
                let y = origin_y - ((index as u32 / columns) as f32 + 0.5) * texel;
                let point = vec3(x, y, plane - sign * depth * (z_front - z_back));
                distances.push(-exact.penetration(point.as_dvec3()));
            }
        }
    }
    distances.sort_by(f64::total_cmp);
    distances
}

/// Vertices move out along their normals, so a flat face moves by the thickness times the cosine of the angle between face
/// and vertex normal: a coarse mesh gets less, and between two close surfaces the distance is that to the nearer one.
#[test]
fn the_surface_in_the_maps_keeps_the_thickness_from_the_body() {
    let thickness = f64::from(THICKNESS);
    let of = |sorted: &[f64], part: f64| sorted[((sorted.len() - 1) as f64 * part) as usize];
    // A face of the sphere leans from its vertex normals by at most 3°.
    let ball = distances(&Mesh::sphere(vec3(0.1, 1.0, 0.0), 0.3, 64), THICKNESS);
    assert!(ball[0] > 0.995 * thickness && of(&ball, 1.0) < 1.005 * thickness, "{:?} {:?}", ball[0], of(&ball, 1.0));
    let woman = distances(&body(), THICKNESS);
    let [least, p1, median, most] = [0.0, 0.01, 0.5, 1.0].map(|part| of(&woman, part) / thickness);
    assert!(least > 0.5, "the surface comes as near as {least} of the thickness");
    assert!(p1 > 0.85, "1 of 100 texels is nearer than {p1} of the thickness");
    assert!((median - 1.0).abs() < 0.02, "the middle texel is at {median} of the thickness");
    assert!(most < 1.001, "the surface is as far as {most} of the thickness");
}
