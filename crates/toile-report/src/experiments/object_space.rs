//! Image space against object space. D table 1, W table 1.

mod life;

pub use life::{Collision, Life};

use crate::Experiment;
use crate::page::{Axis, Block, Cell, Plot, Section, Series, SeriesStyle, Table};
use glam::{DVec3, Vec3};
use std::time::Instant;
use toile::model::{Model, StepSettings};
use toile::scene::{MapKind, Mesh, Settings};
use toile_lab::scenes::{body, fabric, square};
use toile_lab::{Lab, LabError};
use toile_reference::maps::{BodyMaps, Surface};
use toile_reference::{ExactDistance, ObjectSpace, step};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "object_space", title: "Image space against object space", minutes: [0.2, 0.9], run };

/// Mean speed below which the cloth counts as at rest [m/s].
const REST_SPEED: f64 = 0.03;

/// What one way of testing came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Steps until rest, or as many as were allowed.
    pub steps: u32,
    /// Whether it came to rest.
    pub rests: bool,
    /// Time of a step [ms], and of its collision detection and response.
    pub step_ms: f64,
    /// Of that, collision detection and response [ms].
    pub collision_ms: f64,
    /// Deepest particle under the surface of the body [mm]; negative is outside.
    pub particle_depth: f64,
    /// Deepest quad midpoint [mm].
    pub midpoint_depth: f64,
    /// Part of the touching particles that are farther than thickness + 2 texels from the body [1].
    pub false_contacts: f64,
    /// Number of touching particles.
    pub contacts: usize,
}

/// Drops a square sheet of 1 m and n × n particles on a body, level, 1 cm above its top, until it rests or `steps_max` are done.
pub fn compare(mesh: &Mesh, collision: &Collision, n: u32, steps_max: u32) -> Comparison {
    let (settings, model, mut step) = over(mesh, n);
    step.damping = 4.0;
    let mut life = Life::new(&model, &step, collision);
    let mut rests = false;
    while life.steps < steps_max && !rests {
        life.step();
        rests = life.steps > steps_max / 4 && life.steps.is_multiple_of(16) && life.speed() < REST_SPEED;
    }
    let exact = ExactDistance::new(mesh);
    let particles = life.particles();
    let middles = step::quad_midpoints(&particles.positions, &particles.velocities, &model.quads);
    let deepest = |points: &[Vec3]| {
        1e3 * exact.penetrations(points.iter().map(|p| p.as_dvec3())).map_or(f64::NAN, |summary| summary.max)
    };
    let touching: Vec<Vec3> =
        life.contacts().iter().zip(&particles.positions).filter(|(c, _)| c.touching).map(|(_, p)| *p).collect();
    let far = -(f64::from(step.thickness) + 2.0 * settings.texel);
    let false_count = touching.iter().filter(|p| exact.penetration(p.as_dvec3()) < far).count();
    let per_step = |time: std::time::Duration| 1e3 * time.as_secs_f64() / f64::from(life.steps);
    Comparison {
        steps: life.steps,
        rests,
        step_ms: per_step(life.time),
        collision_ms: per_step(life.collision_time),
        particle_depth: deepest(&particles.positions),
        midpoint_depth: deepest(&middles.positions),
        false_contacts: false_count as f64 / touching.len().max(1) as f64,
        contacts: touching.len(),
    }
}

/// Maps of a kind of a body with the thickness of the cloth of the sheets.
pub fn image(mesh: &Mesh, kind: MapKind) -> Collision {
    let settings = Settings::new(fabric());
    let thickness = settings.fabric.thickness as f32;
    let surface = Surface { mesh, thickness, velocities: None, open: false };
    Collision::Image(BodyMaps::around(kind, &[surface], settings.texel as f32))
}

/// Settings, model and step of a sheet above a body.
fn over(mesh: &Mesh, n: u32) -> (Settings, Model, StepSettings) {
    let settings = Settings::new(fabric());
    let [low, high] = mesh.bounds().map_or([Vec3::ZERO; 2], |bounds| bounds);
    let middle = low.midpoint(high).as_dvec3();
    let corner = DVec3::new(middle.x - 0.5, f64::from(high.y) + 0.01 + settings.fabric.thickness, middle.z + 0.5);
    let model = Model::from_sheet(&square(n, 1.0, corner, DVec3::NEG_Z, Vec::new()), &settings);
    let step = StepSettings::new(&settings, &model);
    (settings, model, step)
}

/// Time to prepare a body [ms] and of collision detection and response in a step [ms], for a sheet of n × n particles on a sphere of so many
/// parallels, in two sides, in layers on three axes, and in object space.
pub fn cost(parallels: u32, n: u32, steps: u32) -> [[f64; 2]; 3] {
    let mesh = Mesh::sphere(Vec3::ZERO, 0.25, parallels);
    let (_, model, step) = over(&mesh, n);
    let make: [fn(&Mesh) -> Collision; 3] = [
        |mesh| image(mesh, MapKind::Sides),
        |mesh| image(mesh, MapKind::Layers),
        |mesh| Collision::Object(ObjectSpace::whole(mesh)),
    ];
    make.map(|make| {
        let start = Instant::now();
        let collision = make(&mesh);
        let prepared = 1e3 * start.elapsed().as_secs_f64();
        let mut life = Life::new(&model, &step, &collision);
        (0..steps).for_each(|_| life.step());
        [prepared, 1e3 * life.collision_time.as_secs_f64() / f64::from(steps)]
    })
}

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let mesh = body()?;
    let [n, steps_max] = lab.pick([25, 1600], [49, 4800]);
    let caption = format!(
        "A square sheet of 1 m, {n} × {n} particles, 0.2 kg/m², falls level on the head and shoulders of the built-in body ({} triangles): hierarchical limits, two sweeps, 16 steps per frame, thickness 5 mm, until \
         the mean speed is below {REST_SPEED} m/s or {steps_max} steps are done. Image space: maps with texels of 5 mm, the papers' two sides or layers on three axes, particles and quad midpoints. Object space: the nearest face in trees of bounding boxes of torso, arms and legs, \
         particles alone, as in D §7. Both on the CPU reference, one thread; f32 for the maps, f64 for the trees. Depths are exact distances to the mesh, negative outside. False contacts touch although they are farther from the body than thickness and two texels. CPU of this machine.",
        mesh.triangles.len()
    );
    let columns = &[
        ["collision", ""],
        ["parts", ""],
        ["steps", ""],
        ["at rest", ""],
        ["step", "ms"],
        ["of it collision", "ms"],
        ["share of collision", "%"],
        ["contacts", ""],
        ["deepest particle", "mm"],
        ["deepest midpoint", "mm"],
        ["false contacts", "%"],
    ];
    let mut table = Table::new(caption, columns);
    let object = ObjectSpace::standing(&mesh);
    let parts = object.part_count();
    let mut times = Vec::new();
    for (name, collision, parts) in [
        ("two sides", image(&mesh, MapKind::Sides), None),
        ("layers on three axes", image(&mesh, MapKind::Layers), None),
        ("object space", Collision::Object(object), Some(parts)),
    ] {
        lab.say(0.1, &format!("{name}: a sheet on the body"))?;
        let found = compare(&mesh, &collision, n, steps_max);
        times.push(found.collision_ms);
        table.push(vec![
            Cell::text(name),
            parts.map_or(Cell::Missing, |parts| Cell::Count(parts as u64)),
            Cell::Count(u64::from(found.steps)),
            Cell::text(if found.rests { "yes" } else { "no" }),
            Cell::number(found.step_ms),
            Cell::number(found.collision_ms),
            Cell::number(100.0 * found.collision_ms / found.step_ms),
            Cell::Count(found.contacts as u64),
            Cell::number(found.particle_depth),
            Cell::number(found.midpoint_depth),
            Cell::number(100.0 * found.false_contacts),
        ]);
    }
    let parallels = lab.pick(vec![16, 50, 158], vec![16, 28, 50, 89, 158, 280, 500]);
    let caption = format!(
        "Collision detection and response in one step of a sheet of 1 m, {n} × {n} particles, that begins to lie on a sphere of radius 0.25 m, against the number of triangles of the sphere; the same settings. \
         Preparing is drawing the maps, or building the tree. CPU of this machine, one thread."
    );
    let columns = &[
        ["triangles", ""],
        ["two sides", "ms"],
        ["layers on three axes", "ms"],
        ["object space", "ms"],
        ["two sides drawn in", "ms"],
        ["layers drawn in", "ms"],
        ["tree built in", "ms"],
    ];
    let mut costs = Table::new(caption.clone(), columns);
    let mut curves = [Vec::new(), Vec::new(), Vec::new()];
    for parallels in parallels {
        let triangles = 4 * u64::from(parallels) * u64::from(parallels);
        lab.say(0.6, &format!("cost against {triangles} triangles"))?;
        let found = cost(parallels, n, lab.pick(80, 160));
        for (curve, [_, collision]) in curves.iter_mut().zip(found) {
            curve.push([triangles as f64, collision]);
        }
        let [prepared, collision] = [0, 1].map(|part| found.map(|way| Cell::number(way[part])));
        costs.push([Cell::Count(triangles)].into_iter().chain(collision).chain(prepared).collect());
    }
    let [first, last] = [curves[2].first(), curves[2].last()].map(|point| point.map_or(f64::NAN, |[_, ms]| *ms));
    let series = ["two sides", "layers on three axes", "object space"].into_iter().zip(curves);
    let plot = Plot {
        caption,
        x: Axis::log("triangles of the body", ""),
        y: Axis::log("collision in a step", "ms"),
        series: series.map(|(name, points)| Series::new(name, SeriesStyle::LineAndMarks, points)).collect(),
    };
    let lead = format!(
        "The maps against a classic baseline, both on one CPU thread. On the body object space takes {:.2} times the time of layers on three axes for collision, and {:.2} times that of two sides. On a sphere its cost grows by {:.2} over the triangles \
         that were tried; that of the maps does not depend on them. Object space tests half as many points: without midpoints, so that a coarse cloth can cut into the body between its particles.",
        times[2] / times[1],
        times[2] / times[0],
        last / first
    );
    let mut section = EXPERIMENT.section(lead);
    section.blocks = vec![Block::Table(table), Block::Plot(plot), Block::Table(costs)];
    Ok(section)
}
