//! Layered maps: the device draws them bit for bit as the reference does, and they see limbs, overlaps, holes and large triangles.

use glam::{Vec3, vec3};
use toile_gpu::{BodyMaps, Kernel, MapSpace, MapsFault, Surface};
use toile_lab::DrawnMaps;
use toile_lab::fixtures::{body, free_particle, settings};
use toile_lab::shapes::without_triangles;
use toile_model::{MapBox, StepSettings};
use toile_reference::maps::{self, LayerMaps, draw_layers};
use toile_reference::step::sample_body_maps;
use toile_reference::{ExactDistance, Lag};
use toile_scene::{MapKind, Mesh};
use toile_workspace::gpu;

const TEXEL: f32 = 0.005;

/// Meshes, each with whether it is open by what it is, and the velocities of their vertices where they move.
struct Scene {
    name: &'static str,
    meshes: Vec<(Mesh, bool)>,
    velocities: Option<Vec<Vec<Vec3>>>,
}

impl Scene {
    fn still(name: &'static str, meshes: Vec<Mesh>) -> Self {
        Self { name, meshes: meshes.into_iter().map(|mesh| (mesh, false)).collect(), velocities: None }
    }

    /// The box around all, or a part of it.
    fn map_box(&self, texel: f32) -> MapBox {
        let bounds = self.meshes.iter().filter_map(|(mesh, _)| mesh.bounds());
        let around = bounds.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        MapBox::around(around.expect("a scene has vertices"), texel)
    }

    fn surfaces(&self) -> Vec<maps::Surface<'_>> {
        let velocities = |k: usize| self.velocities.as_ref().map(|all| all[k].as_slice());
        let all = self.meshes.iter().enumerate();
        all.map(|(k, (mesh, open))| maps::Surface { mesh, thickness: 0.0, velocities: velocities(k), open: *open })
            .collect()
    }

    fn space(&self, map_box: MapBox) -> MapSpace {
        let area = self.meshes.iter().map(|(mesh, _)| mesh.area()).sum();
        let mut space = MapSpace::new(MapKind::Layers, map_box, area);
        space.moving = self.velocities.is_some();
        space
    }

    /// What the device draws into maps.
    fn drawn(&self, maps: BodyMaps) -> DrawnMaps {
        let texel = maps.space().map_box.texel;
        let uploaded: Vec<Surface> = self
            .surfaces()
            .iter()
            .map(|surface| {
                let velocities = surface.velocities.map(|all| {
                    let padded: Vec<_> = all.iter().map(|v| v.extend(0.0)).collect();
                    gpu().upload(bytemuck::cast_slice(&padded), wgpu::BufferUsages::STORAGE)
                });
                let mut uploaded = Surface::new(&gpu().device, surface.mesh, texel);
                uploaded.velocities = velocities;
                uploaded.open = surface.open;
                uploaded
            })
            .collect();
        let pairs: Vec<_> = uploaded.iter().map(|surface| (surface, 0.0)).collect();
        DrawnMaps::draw_into(gpu(), maps, &pairs).expect("the device answers")
    }
}

/// Smooth, flat, real, broken, overlapping, doubled, open, moving and large surfaces.
fn scenes() -> Vec<Scene> {
    let woman = body();
    let hole = |centre: Vec3| centre.z > 0.0 && centre.distance(vec3(0.0, 1.2, 0.0)) < 0.25;
    let ball = Mesh::sphere(vec3(0.1, 1.0, 0.0), 0.3, 32);
    let block = |low: Vec3| Mesh::cuboid(low, low + vec3(0.3, 0.2, 0.25));
    let sheet = without_triangles(&Mesh::cuboid(vec3(-0.3, 1.1, -0.2), vec3(0.4, 1.2, 0.2)), |centre| centre.y < 1.199);
    let turning = |mesh: &Mesh| mesh.positions.iter().map(|p| vec3(p.z, 1.0, -p.x)).collect();
    vec![
        Scene::still("sphere", vec![ball.clone()]),
        Scene::still("floor", vec![Mesh::cuboid(vec3(-1.5, -0.1, -1.5), vec3(1.5, 0.0, 1.5))]),
        // The second begins where the first ends, and the third is the first again.
        Scene::still("blocks", vec![block(Vec3::ZERO), block(vec3(0.1, 0.2, 0.0)), block(Vec3::ZERO)]),
        Scene::still("spheres that overlap", vec![ball.clone(), Mesh::sphere(vec3(0.3, 1.1, 0.1), 0.25, 24)]),
        Scene::still("body with holes", vec![without_triangles(&woman, hole)]),
        Scene {
            name: "sphere under a sheet, which both move",
            velocities: Some(vec![turning(&ball), turning(&sheet)]),
            meshes: vec![(ball, false), (sheet, true)],
        },
        Scene::still("body", vec![woman]),
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

#[test]
fn the_device_draws_what_the_reference_draws() {
    for scene in scenes() {
        for texel in [TEXEL, 3.7 * TEXEL] {
            let map_box = scene.map_box(texel);
            let reference = draw_layers(&scene.surfaces(), map_box).maps;
            let name = scene.name;
            assert!(reference.depths.len() > 300, "{name} at {texel} m: {} layers", reference.depths.len());
            let maps = BodyMaps::new(&gpu().device, &scene.space(map_box)).expect("they fit");
            let device = scene.drawn(maps);
            assert_eq!(difference(device.layers(), &reference), None, "{name} at {texel} m");
            assert_eq!(device.maps.fault(), None, "{name} at {texel} m");
        }
    }
}

/// Mistakes of the kernels that draw and of the one that sorts. No list of crossings becomes a ring by them: a device would never end.
const DRAWING: [(&str, &str); 11] = [
    ("SNAPS: i32 = 64", "SNAPS: i32 = 32"),
    ("end.y < start.y", "end.y <= start.y"),
    ("(low + SNAPS / 2 - 1) >> 6u", "(low + SNAPS / 2 + 63) >> 6u"),
    ("(high - SNAPS / 2) >> 6u", "(high - SNAPS / 2 - 32) >> 6u"),
    ("low_sum >> 10u", "low_sum >> 11u"),
    ("shares = shares.xzy", "shares = shares.xyz"),
    ("select(0u, BEGINS, turned)", "select(BEGINS, 0u, turned)"),
    ("select(0u, OPEN, ", "select(OPEN, 0u, "),
    ("row += part_count", "row += 2 * part_count"),
    ("rows.x + part;", "rows.x;"),
    ("surface_normals[corners.y].xyz * shares.y", "surface_normals[corners.y].xyz * shares.z"),
];
const DRAWING_OF_WHAT_MOVES: (&str, &str) =
    ("surface_velocities[corners.z].xyz * shares.z", "surface_velocities[corners.z].xyz * shares.y");
const SORTING: [(&str, &str); 9] = [
    ("return one.depth < other.depth", "return one.depth > other.depth"),
    ("one.triangle < other.triangle", "one.triangle > other.triangle"),
    ("CROSSINGS_MAX: u32 = 32u", "CROSSINGS_MAX: u32 = 3u"),
    ("begins | ((crossing.kind & BEGINS) << k)", "begins | ((crossing.kind & OPEN) << k)"),
    ("if (crossing.kind & OPEN) == 0u", "if (crossing.kind & OPEN) != 2u + 2u"),
    ("} else if open_count > 0u {", "} else if open_count > 1u {"),
    ("if depth == 1u", "if depth >= 1u"),
    ("var sheet = first + end_count", "var sheet = first"),
    ("end_count | (sheet_count << 16u)", "end_count"),
];

#[test]
fn every_mistake_in_drawing_is_found() {
    let scenes = scenes();
    let expected: Vec<_> =
        scenes.iter().map(|scene| draw_layers(&scene.surfaces(), scene.map_box(TEXEL)).maps).collect();
    let is_found = |draw: &dyn Fn(&str) -> String, sort: &dyn Fn(&str) -> String| {
        scenes.iter().zip(&expected).any(|(scene, expected)| {
            let moving = scene.velocities.is_some();
            let kernel = if moving { Kernel::DrawMovingLayers } else { Kernel::DrawLayers };
            let sources = [draw(&kernel.source()), sort(&Kernel::SortLayers.source())];
            let space = scene.space(scene.map_box(TEXEL));
            let maps = BodyMaps::of_sources(&gpu().device, &space, sources.each_ref().map(String::as_str));
            difference(scene.drawn(maps.expect("they fit")).layers(), expected).is_some()
        })
    };
    let same = |source: &str| source.to_owned();
    assert!(!is_found(&same, &same), "without a mistake nothing differs");
    let with = |source: &str, (right, wrong): (&str, &str)| source.replace(right, wrong);
    for mistake in DRAWING.into_iter().chain([DRAWING_OF_WHAT_MOVES]) {
        assert!(Kernel::DrawMovingLayers.source().contains(mistake.0), "no {}", mistake.0);
        assert!(is_found(&|source| with(source, mistake), &same), "nothing sees {}", mistake.1);
    }
    for mistake in SORTING {
        assert!(Kernel::SortLayers.source().contains(mistake.0), "no {}", mistake.0);
        assert!(is_found(&same, &|source| with(source, mistake)), "nothing sees {}", mistake.1);
    }
}

/// A cut through the body, more surfaces than fit, a vertex without a place: each is told.
#[test]
fn what_does_not_fit_is_told() {
    let told = |meshes: Vec<Mesh>, area: f64| {
        let scene = Scene::still("", meshes);
        let map_box = MapBox::around([Vec3::splat(-0.2), Vec3::splat(0.2)], TEXEL);
        let mut space = scene.space(map_box);
        space.area = area;
        let drawn = scene.drawn(BodyMaps::new(&gpu().device, &space).expect("they fit"));
        drawn.maps.fault()
    };
    let block = Mesh::cuboid(Vec3::splat(-0.15), Vec3::splat(0.15));
    assert_eq!(told(vec![block.clone()], block.area()), None);
    let lost = told(vec![block.clone(); 4], 0.0).expect("four blocks do not fit into the room of none");
    assert!(lost.lost_crossings > 1000 && lost.dropped_triangles == 0, "{lost}");
    let mut broken = block.clone();
    broken.positions[0].x = f32::NAN;
    let mut dropped = MapsFault::default();
    dropped.dropped_triangles = 2;
    assert_eq!(told(vec![broken], block.area()), Some(dropped));
    let slab = |k: u32| Mesh::cuboid(vec3(-0.1, -0.1, 0.01 * k as f32 - 0.1), vec3(0.1, 0.1, 0.01 * k as f32 - 0.095));
    let slabs: Vec<Mesh> = (0..17).map(slab).collect();
    let crowded = told(slabs.clone(), slabs.iter().map(Mesh::area).sum()).expect("34 surfaces one behind the other");
    assert!(crowded.crowded_columns > 1000 && crowded.lost_crossings == 0, "{crowded}");
}

/// Part of the points within 2 mm to 3 cm of the surface that are told on the wrong side [1], and the mean error of the distance within
/// 1 cm [m].
fn errors(kind: MapKind, mesh: &Mesh) -> [f64; 2] {
    let surface = maps::Surface { mesh, thickness: 0.0, velocities: None, open: false };
    let maps = maps::BodyMaps::around(kind, &[surface], TEXEL);
    let exact = ExactDistance::new(mesh);
    let mut step = StepSettings::new(&settings(0.03), &free_particle());
    step.thickness = 0.0;
    let points: Vec<Vec3> = mesh
        .triangles
        .iter()
        .enumerate()
        .step_by(7)
        .map(|(k, triangle)| {
            let [a, b, c] = triangle.map(|i| mesh.positions[i as usize]);
            let out = (b - a).cross(c - a).normalize_or_zero();
            (a + b + c) / 3.0 + out * ((k % 50) as f32 * 1e-3 - 0.02)
        })
        .collect();
    let probes = sample_body_maps(&points, &vec![Vec3::ZERO; points.len()], &maps, Lag::default(), &step);
    let (mut wrong, mut far, mut sum, mut near) = (0, 0, 0.0, 0);
    for (point, probe) in points.iter().zip(&probes) {
        let distance = -exact.penetration(point.as_dvec3());
        if distance.abs() > 0.002 {
            far += 1;
            wrong += u32::from((probe.hit && probe.distance < 0.0) != (distance < 0.0));
        }
        if distance.abs() < 0.01 && probe.hit {
            near += 1;
            sum += (f64::from(probe.distance) - distance).abs();
        }
    }
    assert!(far > 1000 && near > 500, "{far} and {near} points");
    [f64::from(wrong) / f64::from(far), sum / f64::from(near)]
}

/// The answer hangs neither on limbs nor on where the body looks.
#[test]
fn a_body_is_seen_from_every_side_at_any_heading() {
    let woman = body();
    for degrees in [0.0_f32, 45.0, 90.0] {
        let turn = glam::Quat::from_rotation_y(degrees.to_radians());
        let turned = |v: &Vec3| turn * *v;
        let mesh = Mesh {
            positions: woman.positions.iter().map(turned).collect(),
            normals: woman.normals.iter().map(turned).collect(),
            ..woman.clone()
        };
        let [wrong, error] = errors(MapKind::Layers, &mesh);
        // Every triangle counts alike here, so most points stand between fingers and at ears.
        assert!(wrong < 4e-3, "{degrees}°: {wrong} of the points are on the wrong side");
        assert!(error < 6e-4, "{degrees}°: {error} m");
        let [wrong, error] = errors(MapKind::Sides, &mesh);
        assert!(wrong > 8e-3 && error > 1e-3, "{degrees}°: two sides do not see it so: {wrong}, {error} m");
    }
}
