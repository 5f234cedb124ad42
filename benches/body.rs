//! What the triangles of a body cost: a step of a sheet over an ellipsoid of about 1 000, 27 000 and 107 000 triangles, which
//! reads maps of the same size whatever drew them, and the drawing of those maps, done once for a body at rest. The columns
//! of the step are to be the same in every row.
//!
//! `cargo bench --bench body`.

mod support;

use glam::{DVec2, DVec3, Vec3};
use std::sync::Arc;
use std::time::Instant;
use support::Bench;
use toile::gpu::{BodyMaps, MapSpace, Surface};
use toile::model::{MapBox, Model, StepSettings};
use toile::scene::{MapKind, Mesh, Sheet};
use toile::{Cloth, Colliders};
use toile_lab::fixtures::sheet_settings;

/// Parallels of the ellipsoids; the triangles are 4·count².
const PARALLELS: [u32; 3] = [16, 82, 164];
/// Half axes of the ellipsoid [m]: a torso of about human size.
const HALF_AXES: Vec3 = Vec3::new(0.3, 0.8, 0.2);
/// Particles along one side of the sheet.
const SIZE: u32 = 128;
/// Steps that are measured.
const STEPS: usize = 40;
/// Frames before: the sheet must lie on the body, so that contacts are measured, too.
const FRAMES: u32 = 30;

fn main() {
    let bench = Bench::open();
    println!(
        "{:>10} {:>12} {:>14} {:>18} {:>14}",
        "triangles", "step µs", "state copies", "sampling µs", "drawing maps µs"
    );
    for parallels in PARALLELS {
        for kind in [MapKind::Sides, MapKind::Layers] {
            measure(&bench, &ellipsoid(parallels), kind);
        }
    }
}

fn measure(bench: &Bench, body: &Mesh, kind: MapKind) {
    let scene = sheet_settings();
    let bounds = body.bounds().expect("an ellipsoid has vertices");
    let thickness = scene.fabric.thickness as f32;
    let map_box = MapBox::around([bounds[0] - thickness, bounds[1] + thickness], scene.texel as f32);
    let space = MapSpace::new(kind, map_box, body.area());
    let maps = BodyMaps::new(&bench.device, &space).unwrap_or_else(|error| panic!("{error}"));
    let surface = Surface::new(&bench.device, body, map_box.texel);
    let drawing = (0..10)
        .map(|_| run(bench, |encoder| maps.record(&bench.device, encoder, map_box, &[(&surface, thickness)])))
        .fold(f64::INFINITY, f64::min);

    let mut sheet = Sheet::new("sheet", [SIZE, SIZE], DVec2::splat(1.0));
    sheet.corner = DVec3::new(-0.5, 0.82, 0.5);
    sheet.down = DVec3::NEG_Z;
    let model = Model::from_sheet(&sheet, &scene);
    let settings = StepSettings::new(&scene, &model);
    let colliders = Colliders::new(Some(Arc::new(maps)), Vec::new());
    let mut cloth = Cloth::new(&bench.device, &model, &settings, colliders).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..FRAMES {
        run(bench, |encoder| cloth.record(&bench.device, encoder));
    }
    let cost = bench.step_cost(&mut cloth, STEPS);
    let sampling = cost
        .kernels
        .iter()
        .find(|(name, ..)| ["sample_sides", "sample_layers"].contains(name))
        .expect("a body has maps")
        .2;
    println!(
        "{:>10} {:>12.1} {:>14.2} {:>18.1} {:>14.1}",
        body.triangles.len(),
        1e3 * cost.milliseconds(),
        cost.milliseconds() / cost.state_copy,
        1e3 * sampling,
        1e3 * drawing,
    );
}

/// Submits what `record` records, waits until it is done, and says how long that took [ms].
fn run(bench: &Bench, record: impl FnOnce(&mut wgpu::CommandEncoder)) -> f64 {
    let start = Instant::now();
    let mut encoder = bench.device.create_command_encoder(&Default::default());
    record(&mut encoder);
    bench.queue.submit([encoder.finish()]);
    bench.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    1e3 * start.elapsed().as_secs_f64()
}

/// An ellipsoid of meridians and parallels.
fn ellipsoid(parallels: u32) -> Mesh {
    let sphere = Mesh::sphere(Vec3::ZERO, 1.0, parallels);
    Mesh {
        positions: sphere.positions.iter().map(|p| *p * HALF_AXES).collect(),
        normals: sphere.normals.iter().map(|n| (*n / HALF_AXES).normalize()).collect(),
        triangles: sphere.triangles,
    }
}
