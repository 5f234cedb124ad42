//! What the two kinds of maps tell of a body in poses whose limbs hide one another, drawn and sampled by the device, against the exact mesh.

use crate::page::{Block, Cell, Table};
use glam::{DMat3, DVec3, Vec3};
use std::time::Instant;
use toile::Colliders;
use toile::gpu::contents::{Encode, constant, uniform, with_w};
use toile::gpu::{BodyMaps, MapSpace, Surface};
use toile::model::{Arrays, MapBox, Model, SideBox, Solid, StepSettings};
use toile::scene::{MapKind, Mesh, Settings};
use toile_kernels::Kernel;
use toile_lab::fixtures::woman;
use toile_lab::kernels::{Compiled, Inputs};
use toile_lab::motion::Made;
use toile_lab::scenes::{fabric, square};
use toile_lab::{DrawnMaps, Gpu, Lab, LabError, Run, max_and_p99};

/// How far inside and outside of the surface the points lie [m].
const SHELL: [f64; 2] = [-0.02, 0.03];
/// Nearer to the surface than this a side is not judged [m].
const UNDECIDED: f64 = 0.002;
/// Within this distance outside the error of the distance counts [m].
const NEAR: f64 = 0.01;
/// Farther outside than this a point that is told inside is a false contact [m].
const FAR: f64 = 0.01;
/// A surface that looks at another one within these distances faces it [m].
const FACING: [f64; 4] = [0.02, 0.04, 0.06, 0.08];

/// The maps that are compared.
pub const KINDS: [(&str, MapKind); 2] = [("two sides", MapKind::Sides), ("layers on three axes", MapKind::Layers)];

/// Points around a body, and where they really are.
#[derive(Clone, Debug)]
pub struct Surroundings {
    points: Vec<Vec3>,
    /// Distance to the surface [m], negative inside.
    distances: Vec<f64>,
    /// Whether the surface there looks at another one.
    facing: Vec<bool>,
}

/// What maps tell of points, against where they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Told {
    /// Part of the points farther than 2 mm from the surface that are told on its other side [1].
    pub wrong_side: f64,
    /// The same, of those between surfaces that face one another [1].
    pub wrong_side_facing: f64,
    /// Mean error of the distance of points outside within 1 cm between such surfaces [m].
    pub error_mean: f64,
    /// Error that 99 of 100 of them do not exceed [m].
    pub error_p99: f64,
    /// Part of the points more than 1 cm outside between such surfaces that are told inside [1].
    pub false_contacts: f64,
}

impl Surroundings {
    /// So many seeded points from 20 mm inside to 30 mm outside of a body, even by area.
    pub fn new(body: &Mesh, count: usize, seed: u64) -> Self {
        let solid = Solid::of([body]);
        let mut random = fastrand::Rng::with_seed(seed);
        let corners = |triangle: &[u32; 3]| triangle.map(|i| body.positions[i as usize].as_dvec3());
        let mut area = 0.0;
        let sum = |triangle: &[u32; 3]| {
            let [a, b, c] = corners(triangle);
            area += (b - a).cross(c - a).length();
            area
        };
        let areas: Vec<f64> = body.triangles.iter().map(sum).collect();
        let mut around = Self { points: Vec::new(), distances: Vec::new(), facing: Vec::new() };
        for _ in 0..count {
            let place = random.f64() * area;
            let index = areas.partition_point(|sum| *sum < place).min(areas.len() - 1);
            let [a, b, c] = corners(&body.triangles[index]);
            let [mut s, mut t] = [random.f64(), random.f64()];
            if s + t > 1.0 {
                [s, t] = [1.0 - s, 1.0 - t];
            }
            let normal = (b - a).cross(c - a).normalize_or(DVec3::Y);
            let foot = a + (b - a) * s + (c - a) * t;
            let point = (foot + normal * (SHELL[0] + (SHELL[1] - SHELL[0]) * random.f64())).as_vec3();
            let exact = point.as_dvec3();
            let distance = solid.distance(exact);
            around.points.push(point);
            around.distances.push(if solid.holds(exact) { -distance } else { distance });
            // Straight out another surface is nearer than the one that it left.
            let is_faced = |reach: &f64| solid.distance(foot + normal * *reach) < reach - 0.01;
            around.facing.push(FACING.iter().any(is_faced));
        }
        around
    }
}

/// Draws maps of a body on the device and samples them there.
///
/// # Errors
/// [`LabError::Toile`] when they do not fit the device.
pub fn told(gpu: &Gpu, body: &Mesh, around: &Surroundings, kind: MapKind) -> Result<Told, LabError> {
    Ok(Told::of(around, &probes(gpu, body, around, kind)?))
}

/// What maps tell of the points around a body: eight words each.
fn probes(gpu: &Gpu, body: &Mesh, around: &Surroundings, kind: MapKind) -> Result<Vec<f32>, LabError> {
    let settings = settings();
    let drawn = DrawnMaps::draw(gpu, kind, &[(body, 0.0)], settings.texel as f32)?;
    let count = around.points.len();
    let model = Model::new(Arrays::of_particles(around.points.clone(), vec![1.0; count]))?;
    let sampled = Sampled { step: StepSettings::new(&settings, &model), model, drawn };
    let kernel = match kind {
        MapKind::Sides => Kernel::SampleSides,
        MapKind::Layers => Kernel::SampleLayers,
    };
    let compiled = Compiled::new(gpu, kernel, &kernel.source()).expect("the kernel compiles");
    let written = compiled.run(gpu, count as u32, &sampled)?;
    Ok(written["probes"].iter().map(|word| f32::from_bits(*word)).collect())
}

/// Radius of the ball that two sides see as well as any body [m].
const BALL_RADIUS: f32 = 0.25;
/// The surface is nearer than this to the points that are judged around the ball [m].
const TOUCHING: f64 = 0.005;
/// Smallest part of the normal along z that the bands around a ball have, from its rim to its middle [1].
const BANDS: [f64; 4] = [0.0, 0.05, 0.2, 0.5];

/// What maps tell in a band around a ball, of points within 5 mm of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BallTold {
    /// The part of the normal along z that it begins and ends with [1].
    pub slant: [f64; 2],
    /// Part of the points farther than 2 mm from the surface that are told on its other side [1].
    pub wrong_side: f64,
    /// Part of the points that see nothing [1].
    pub unseen: f64,
    /// Error of the distance that 99 of 100 of the others do not exceed [m].
    pub error_p99: f64,
    /// Angle between the true normal and the one that is told that 99 of 100 of them do not exceed [rad].
    pub angle_p99: f64,
}

/// What maps tell of a ball of 25 cm, from its rim, as a camera along z sees it, to its middle. No body is seen better from two sides.
///
/// # Errors
/// [`LabError::Toile`] when they do not fit the device.
pub fn told_of_ball(gpu: &Gpu, count: usize, seed: u64, kind: MapKind) -> Result<Vec<BallTold>, LabError> {
    let ball = Mesh::sphere(Vec3::ZERO, BALL_RADIUS, 96);
    let around = Surroundings::new(&ball, count, seed);
    let probes = probes(gpu, &ball, &around, kind)?;
    let slant_of = |point: &Vec3| f64::from(point.z.abs() / point.length());
    let ends = BANDS[1..].iter().copied().chain([1.0]);
    let band = |(first, last): (f64, f64)| {
        let (mut judged, mut wrong, mut near, mut unseen) = (0u32, 0u32, 0u32, 0u32);
        let (mut errors, mut angles) = (Vec::new(), Vec::new());
        let seen = around.points.iter().zip(&around.distances).zip(probes.chunks_exact(8));
        for ((point, &distance), probe) in seen.filter(|((point, _), _)| (first..=last).contains(&slant_of(point))) {
            let (hit, told) = (probe[7] > 0.0, f64::from(probe[3]));
            if distance.abs() > UNDECIDED {
                judged += 1;
                wrong += u32::from((hit && told < 0.0) != (distance < 0.0));
            }
            if distance.abs() < TOUCHING {
                near += 1;
                unseen += u32::from(!hit);
                if hit {
                    errors.push((told - distance).abs());
                    angles.push(f64::from(Vec3::from_slice(probe).angle_between(*point)));
                }
            }
        }
        let part = |some: u32, all: u32| f64::from(some) / f64::from(all.max(1));
        let p99 = |values| max_and_p99(values).map_or(0.0, |[_, p99]| p99);
        BallTold {
            slant: [first, last],
            wrong_side: part(wrong, judged),
            unseen: part(unseen, near),
            error_p99: p99(errors),
            angle_p99: p99(angles),
        }
    };
    Ok(BANDS.into_iter().zip(ends).map(band).collect())
}

/// The table of a ball.
fn of_a_ball(lab: &Lab, count: usize) -> Result<Table, LabError> {
    let caption = format!(
        "What maps with texels of 5 mm tell of a ball of {} cm, from its rim, as a camera along z sees it, to its middle: {count} points as \
         above, the last three columns of those within {} mm of the surface. {}",
        1e2 * BALL_RADIUS,
        1e3 * TOUCHING,
        lab.place()
    );
    let columns = [
        ["maps", ""],
        ["normal along z, from", ""],
        ["to", ""],
        ["wrong side", "%"],
        ["sees nothing", "%"],
        ["error of the distance, p99", "mm"],
        ["error of the normal, p99", "°"],
    ];
    let mut table = Table::new(caption, &columns);
    for (maps, kind) in KINDS {
        for band in told_of_ball(&lab.gpu(), count, lab.seed, kind)? {
            table.push(vec![
                Cell::text(maps),
                Cell::number(band.slant[0]),
                Cell::number(band.slant[1]),
                Cell::number(1e2 * band.wrong_side),
                Cell::number(1e2 * band.unseen),
                Cell::number(1e3 * band.error_p99),
                Cell::number(band.angle_p99.to_degrees()),
            ]);
        }
    }
    Ok(table)
}

impl Told {
    /// What probes of eight words tell: normal, distance, velocity, hit.
    fn of(around: &Surroundings, probes: &[f32]) -> Self {
        let mut wrong = [[0u32; 2]; 2];
        let mut false_contacts = [0u32; 2];
        let mut errors = Vec::new();
        let places = around.distances.iter().zip(&around.facing);
        for ((&distance, &facing), probe) in places.zip(probes.chunks_exact(8)) {
            let (hit, seen) = (probe[7] > 0.0, f64::from(probe[3]));
            let inside = hit && seen < 0.0;
            if distance.abs() > UNDECIDED {
                let is_wrong = u32::from(inside != (distance < 0.0));
                for group in &mut wrong[..=usize::from(facing)] {
                    group[0] += is_wrong;
                    group[1] += 1;
                }
            }
            if facing && distance > FAR {
                false_contacts[0] += u32::from(inside);
                false_contacts[1] += 1;
            }
            // Inside, the nearest face may be one that is buried where parts overlap.
            if facing && hit && distance > 0.0 && distance < NEAR {
                errors.push((seen - distance).abs());
            }
        }
        let part = |[some, all]: [u32; 2]| f64::from(some) / f64::from(all.max(1));
        let error_mean = errors.iter().sum::<f64>() / errors.len().max(1) as f64;
        let [_, error_p99] = max_and_p99(errors).unwrap_or_default();
        Self {
            wrong_side: part(wrong[0]),
            wrong_side_facing: part(wrong[1]),
            error_mean,
            error_p99,
            false_contacts: part(false_contacts),
        }
    }
}

/// Points as the particles of a cloth, and the maps that they look into.
struct Sampled {
    model: Model,
    step: StepSettings,
    drawn: DrawnMaps,
}

impl Inputs for Sampled {
    fn bytes(&self, name: &str) -> Vec<u8> {
        let count = self.model.positions.len();
        match name {
            "positions" => with_w(&self.model.positions, &self.model.inverse_masses),
            "velocities" => with_w(&vec![Vec3::ZERO; count], &self.model.masses),
            "midpoints" => Vec::new(),
            "probes" => vec![0; 32 * count],
            "side_box" => uniform(&SideBox::of(&self.drawn.maps.space().map_box).encode()),
            "layer_box" => uniform(&self.drawn.maps.space().map_box.encode()),
            other => constant(other, &self.model, &self.step, false)
                .unwrap_or_else(|| panic!("sampling names a buffer {other} that points do not have")),
        }
    }

    fn maps(&self, _name: &str) -> Option<&BodyMaps> {
        Some(&self.drawn.maps)
    }
}

/// Settings of a cloth without thickness, so that maps tell the distance to the mesh itself.
fn settings() -> Settings {
    let mut fabric = fabric();
    fabric.thickness = 0.0;
    Settings::new(fabric)
}

/// The built-in body in poses, by name.
pub fn poses() -> Vec<(&'static str, Mesh)> {
    let stride = woman("walk_loop").at(0.033);
    let turned = |degrees: f64| stride.turned(DMat3::from_rotation_y(degrees.to_radians()));
    let made = |made: Made, time| made.of(&woman("walk_loop")).at(time);
    vec![
        ("arms 45° down", woman("apose_to_walk").at(0.0)),
        ("stride", stride.clone()),
        ("stride, turned 45°", turned(45.0)),
        ("stride, turned 90°", turned(90.0)),
        ("arms folded", made(Made::ArmsFolded, 1.7)),
        ("seated", made(Made::Sitting, 2.3)),
    ]
}

/// What maps of a body cost: drawing them, and sampling them once for every point of a sheet of n × n particles that falls on it [state copies of that
/// sheet]; `None` when the clock was too coarse.
///
/// # Errors
/// [`LabError::Toile`] when they do not fit the device.
pub fn cost(lab: &Lab, body: &Mesh, kind: MapKind, n: u32) -> Result<[Option<f64>; 2], LabError> {
    let settings = Settings::new(fabric());
    let gpu = lab.gpu();
    let texel = settings.texel as f32;
    let thickness = settings.fabric.thickness as f32;
    let [low, high] = body.bounds().unwrap_or_default();
    let map_box = MapBox::around([low - thickness, high + thickness], texel);
    let maps = BodyMaps::new(&gpu.device, &MapSpace::new(kind, map_box, body.area()))?;
    let surface = Surface::new(&gpu.device, body, texel);
    let mut drawing = f64::INFINITY;
    for _ in 0..6 {
        let start = Instant::now();
        gpu.run(|encoder| maps.record(&gpu.device, encoder, map_box, &[(&surface, thickness)]))?;
        drawing = drawing.min(1e3 * start.elapsed().as_secs_f64());
    }
    let top = low.midpoint(high).as_dvec3().with_y(f64::from(high.y) + 0.006);
    let sheet = square(n, 1.0, top + DVec3::new(-0.5, 0.0, 0.5), DVec3::NEG_Z, Vec::new());
    let colliders = Colliders::new(Some(maps.into()), Vec::new());
    let mut run = Run::sheet(lab, &sheet, &settings, colliders)?;
    for _ in 0..20 {
        run.frame(lab)?;
    }
    let cost = run.cost(lab, 5)?;
    let sampling = cost.kernels.iter().find(|(name, ..)| name.starts_with("sample_"));
    let sampling = sampling.map_or(0.0, |(_, dispatches, milliseconds)| milliseconds / f64::from(*dispatches));
    Ok([drawing, sampling].map(|milliseconds| cost.in_copies(milliseconds)))
}

pub(super) fn blocks(lab: &mut Lab, progress: [f64; 2]) -> Result<Vec<Block>, LabError> {
    let count = lab.pick(4_000, 40_000);
    let poses = poses();
    let caption = format!(
        "What maps with texels of 5 mm tell of {count} points from {} mm inside to {} mm outside of the built-in body, even by area, by pose. The side is that of the winding number, judged beyond 2 mm; \
         distances are exact. Facing are the points where straight out, within 8 cm, another part of the surface is nearer; errors are those outside within 10 mm of it, \
         false contacts those that are told inside more than 10 mm outside. Maps drawn and sampled by the device. {}",
        -1e3 * SHELL[0],
        1e3 * SHELL[1],
        lab.place()
    );
    let columns = [
        ["pose", ""],
        ["maps", ""],
        ["wrong side", "%"],
        ["wrong side, facing", "%"],
        ["error of the distance, facing, mean", "mm"],
        ["p99", "mm"],
        ["false contacts, facing", "%"],
    ];
    let mut table = Table::new(caption, &columns);
    let gpu = lab.gpu();
    for (index, (name, body)) in poses.iter().enumerate() {
        let share = progress[0] + (progress[1] - progress[0]) * index as f64 / poses.len() as f64;
        lab.say(share, &format!("maps of the body, {name}"))?;
        let around = Surroundings::new(body, count, lab.seed);
        for (maps, kind) in KINDS {
            let told = told(&gpu, body, &around, kind)?;
            let percent = |part: f64| Cell::number(1e2 * part);
            table.push(vec![
                Cell::text(*name),
                Cell::text(maps),
                percent(told.wrong_side),
                percent(told.wrong_side_facing),
                Cell::number(1e3 * told.error_mean),
                Cell::number(1e3 * told.error_p99),
                percent(told.false_contacts),
            ]);
        }
    }
    let n = lab.pick(64, 128);
    let caption = format!(
        "What the maps of the built-in body, arms 45° down ({} triangles), cost with texels of 5 mm: drawing them, and sampling them once for the points of a sheet of {n} × {n} particles that \
         falls on the body, in state copies of that sheet. {}",
        poses[0].1.triangles.len(),
        lab.place()
    );
    let mut costs =
        Table::new(caption, &[["maps", ""], ["drawing", "state copies"], ["sampling once", "state copies"]]);
    for (maps, kind) in KINDS {
        let [drawing, sampling] = cost(lab, &poses[0].1, kind, n)?;
        costs.push(vec![Cell::text(maps), Cell::number_or_missing(drawing), Cell::number_or_missing(sampling)]);
    }
    Ok(vec![Block::Table(table), Block::Table(of_a_ball(lab, count)?), Block::Table(costs)])
}
