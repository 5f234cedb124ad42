//! What the maps of a body cost in accuracy, against its exact mesh: by texel, coding, and how the thickness is added.

use crate::page::{Axis, Block, Cell, Plot, Series, SeriesStyle, Table};
use glam::{DVec3, Vec3};
use toile::model::{MapBox, StepSettings};
use toile::scene::{Mesh, Settings};
use toile_lab::scenes::body;
use toile_lab::{Lab, LabError};
use toile_reference::ExactDistance;
use toile_reference::maps::{SideMaps, Surface, render_sides_in};
use toile_reference::step::sample_sides;

/// Distance that the cloth keeps from the body [m]: the tolerance of D §5.4.
const THICKNESS: f64 = 0.005;
/// How far inside and outside of the body's surface the points lie [m].
const SHELL: [f64; 2] = [-0.01, 0.025];
/// A point outside that is moved farther than this is moved by a false contact [m].
const FALSE_MOVE: f64 = 1e-3;

/// How the texels hold depths and normals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coding {
    /// As floats.
    Float,
    /// As the papers do: depths of 24 bits (D eq. 10), normals as colours of 8 bits (D eq. 6 and 7, W eq. 7 and 8).
    EightBit,
}

/// How the maps show the thickness of the cloth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Offset {
    /// The vertices are moved out along their normals.
    Normals,
    /// As D §5.4 does: the depths are moved, and layers of texels are added around the silhouette, as many as make the thickness but at
    /// least one.
    PixelLayers,
}

/// How the body is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probing {
    /// Edge length of a texel [m].
    pub texel: f64,
    /// How the texels hold what they show.
    pub coding: Coding,
    /// How they show the thickness.
    pub offset: Offset,
}

/// Points near a body, and where they stand to its exact mesh.
#[derive(Clone, Debug)]
pub struct Shell {
    points: Vec<Vec3>,
    /// How deep each lies below the surface that is everywhere the thickness away from the mesh [m].
    depths: Vec<f64>,
    /// Whether a camera of the maps sees where the mesh is nearest.
    seen: Vec<bool>,
}

/// What points near a body meet, against the surface that is everywhere the thickness away from the exact mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapError {
    /// Mean depth below that surface that the points inside it still have after the answer [m].
    pub depth_mean: f64,
    /// Depth that 99 of 100 of them do not exceed [m].
    pub depth_p99: f64,
    /// The same, of those whose nearest place on the mesh is seen by a camera [m].
    pub depth_p99_seen: f64,
    /// Part of the points outside it that are moved all the same, by more than 1 mm [1].
    pub false_contacts: f64,
    /// The same, of those whose nearest place on the mesh is seen by a camera [1].
    pub false_contacts_seen: f64,
}

impl Shell {
    /// So many seeded points around the surface, even by area.
    pub fn new(body: &Mesh, count: usize, seed: u64) -> Self {
        let exact = ExactDistance::new(body);
        let points = points_near(body, count, seed);
        let fine = 0.002;
        let maps = draw(body, Probing { texel: fine, coding: Coding::Float, offset: Offset::Normals }, 0.0);
        let place = |point: &Vec3| {
            let point = point.as_dvec3();
            let depth = exact.penetration(point);
            // The way out of the mesh is against the gradient of the depth.
            let reach = 1e-5;
            let gradient = DVec3::AXES.map(|axis| (exact.penetration(point + axis * reach) - depth) / reach);
            let nearest = point - DVec3::from_array(gradient).normalize_or_zero() * depth;
            (depth + THICKNESS, is_seen(&maps, nearest))
        };
        let (depths, seen) = points.iter().map(place).unzip();
        Self { points, depths, seen }
    }
}

/// Whether maps show a place of the surface, within what a slope of three and the texels' size make of the depth.
fn is_seen(maps: &SideMaps, place: DVec3) -> bool {
    let map_box = maps.map_box;
    let texel = f64::from(map_box.texel);
    let column = ((place.x - f64::from(map_box.origin_x)) / texel).floor();
    let row = ((f64::from(map_box.origin_y) - place.y) / texel).floor();
    if !(column >= 0.0 && row >= 0.0 && column < f64::from(map_box.columns) && row < f64::from(map_box.rows)) {
        return false;
    }
    let index = row as usize * map_box.columns as usize + column as usize;
    let range = f64::from(map_box.z_front - map_box.z_back);
    let front = f64::from(map_box.z_front) - f64::from(maps.depth[0][index]) * range;
    let back = f64::from(map_box.z_back) + f64::from(maps.depth[1][index]) * range;
    [front, back].iter().any(|z| (place.z - z).abs() < 3.0 * texel)
}

/// What the points of a shell meet in the maps of a body, against its exact mesh.
pub fn map_error(body: &Mesh, exact: &ExactDistance, shell: &Shell, probing: Probing) -> MapError {
    let maps = draw(body, probing, THICKNESS);
    let settings = Settings::new(toile_lab::scenes::fabric());
    let step = StepSettings::new(&settings, &toile_lab::fixtures::free_particle());
    let probes = sample_sides(&shell.points, &vec![Vec3::ZERO; shell.points.len()], &maps, &step);
    let mut depths = [Vec::new(), Vec::new()];
    let mut moves = [Vec::new(), Vec::new()];
    for (((point, depth), seen), probe) in shell.points.iter().zip(&shell.depths).zip(&shell.seen).zip(&probes) {
        let pushed = if probe.hit { f64::from(-probe.distance).max(0.0) } else { 0.0 };
        if *depth > 0.0 {
            let end = point.as_dvec3() + probe.normal.as_dvec3() * pushed;
            let left = if pushed > 0.0 { (exact.penetration(end) + THICKNESS).max(0.0) } else { *depth };
            depths[usize::from(*seen)].push(left);
        } else {
            moves[usize::from(*seen)].push(pushed);
        }
    }
    let all = |[hidden, seen]: &[Vec<f64>; 2]| [hidden.as_slice(), seen].concat();
    let p99 = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values.get(values.len() * 99 / 100).copied().unwrap_or(0.0)
    };
    let moved = |ways: &[f64]| ways.iter().filter(|way| **way > FALSE_MOVE).count() as f64 / ways.len().max(1) as f64;
    let inside = all(&depths);
    MapError {
        depth_mean: inside.iter().sum::<f64>() / inside.len().max(1) as f64,
        depth_p99: p99(inside),
        depth_p99_seen: p99(depths[1].clone()),
        false_contacts: moved(&all(&moves)),
        false_contacts_seen: moved(&moves[1]),
    }
}

/// Seeded points in a shell around the surface, even by area.
fn points_near(body: &Mesh, count: usize, seed: u64) -> Vec<Vec3> {
    let corners = |triangle: &[u32; 3]| triangle.map(|i| body.positions[i as usize].as_dvec3());
    let mut area = 0.0;
    let areas: Vec<f64> = body
        .triangles
        .iter()
        .map(|triangle| {
            let [a, b, c] = corners(triangle);
            area += 0.5 * (b - a).cross(c - a).length();
            area
        })
        .collect();
    let mut random = fastrand::Rng::with_seed(seed);
    let point = |_| {
        let place = random.f64() * area;
        let index = areas.partition_point(|sum| *sum < place).min(areas.len() - 1);
        let [a, b, c] = corners(&body.triangles[index]);
        let [mut s, mut t] = [random.f64(), random.f64()];
        if s + t > 1.0 {
            [s, t] = [1.0 - s, 1.0 - t];
        }
        let normal = (b - a).cross(c - a).normalize_or(DVec3::Y);
        let height = SHELL[0] + (SHELL[1] - SHELL[0]) * random.f64();
        (a + (b - a) * s + (c - a) * t + normal * height).as_vec3()
    };
    (0..count).map(point).collect()
}

/// The maps of a body with a thickness of cloth on it [m].
fn draw(body: &Mesh, probing: Probing, thickness: f64) -> SideMaps {
    let texel = probing.texel as f32;
    let [low, high] = body.bounds().unwrap_or_default();
    // Room for the thickness and for the layers of texels.
    let room = thickness as f32 + texel;
    let map_box = MapBox::around([low - room, high + room], texel);
    let by_normals = probing.offset == Offset::Normals;
    let along_normals = if by_normals { thickness as f32 } else { 0.0 };
    let mut maps =
        render_sides_in(&[Surface { mesh: body, thickness: along_normals, velocities: None, open: false }], map_box);
    if !by_normals {
        add_layers(&mut maps, thickness);
    }
    if probing.coding == Coding::EightBit {
        for layer in 0..2 {
            maps.depth[layer].iter_mut().filter(|depth| **depth < 1.0).for_each(|depth| *depth = in_24_bits(*depth));
            maps.normals[layer].iter_mut().for_each(|normal| *normal = normal.map(|part| in_8_bits(part, 1.0)));
        }
    }
    maps
}

/// Moves the depths towards the cameras by the thickness, and lets the silhouette grow by layers of texels.
fn add_layers(maps: &mut SideMaps, thickness: f64) {
    let map_box = maps.map_box;
    let layers = (thickness / f64::from(map_box.texel)).round().max(1.0) as u32;
    let nearer = thickness as f32 / (map_box.z_front - map_box.z_back);
    let [columns, rows] = [map_box.columns as i64, map_box.rows as i64];
    for side in 0..2 {
        maps.depth[side].iter_mut().filter(|depth| **depth < 1.0).for_each(|depth| *depth = (*depth - nearer).max(0.0));
        for _ in 0..layers {
            let before = maps.depth[side].clone();
            let normals = maps.normals[side].clone();
            for index in 0..before.len() {
                if before[index] < 1.0 {
                    continue;
                }
                let [column, row] = [index as i64 % columns, index as i64 / columns];
                let around = (-1..=1).flat_map(|down| (-1..=1).map(move |right| [column + right, row + down]));
                let seen = around
                    .filter(|[c, r]| (0..columns).contains(c) && (0..rows).contains(r))
                    .map(|[c, r]| (r * columns + c) as usize)
                    .min_by(|a, b| before[*a].total_cmp(&before[*b]));
                if let Some(nearest) = seen.filter(|nearest| before[*nearest] < 1.0) {
                    maps.depth[side][index] = before[nearest];
                    maps.normals[side][index] = normals[nearest];
                }
            }
        }
    }
}

/// A depth of 0 to 1 in a z-buffer of 24 bits. D eq. 10.
fn in_24_bits(depth: f32) -> f32 {
    let steps = f64::from((1 << 24) - 1);
    ((f64::from(depth) * steps).round() / steps) as f32
}

/// A number of −`largest` to `largest` as a colour of 8 bits and back. D eq. 6 and 7.
fn in_8_bits(value: f32, largest: f32) -> f32 {
    let colour = (0.5 * value / largest + 0.5).clamp(0.0, 1.0);
    largest * (2.0 * (colour * 255.0).round() / 255.0 - 1.0)
}

/// Root of the mean square error [m/s] of velocities in colours of 8 bits, even in a cube of ±`speed_max` [m/s]: as W eq. 9 and 10 are
/// printed, where eq. 9 misses a factor that eq. 10 has, and with that factor.
pub fn velocity_error(speed_max: f32, seed: u64) -> [f64; 2] {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut squares = [0.0; 2];
    let count = 30_000;
    for _ in 0..count {
        let value = speed_max * (2.0 * random.f32() - 1.0);
        let colour = (0.5 * value + 0.5 / speed_max).clamp(0.0, 1.0);
        let printed = speed_max * (2.0 * (colour * 255.0).round() / 255.0 - 1.0);
        for (sum, read) in squares.iter_mut().zip([printed, in_8_bits(value, speed_max)]) {
            // Three components of a velocity add up.
            *sum += 3.0 * f64::from(read - value).powi(2);
        }
    }
    squares.map(|sum| (sum / f64::from(count)).sqrt())
}

pub(super) fn blocks(lab: &mut Lab, progress: [f64; 2]) -> Result<Vec<Block>, LabError> {
    let texels = [0.00125, 0.0025, 0.005, 0.01, 0.02];
    let count = lab.pick(8_000, 100_000);
    let body = body()?;
    let exact = ExactDistance::new(&body);
    lab.say(progress[0], "exact distances to the body")?;
    let shell = Shell::new(&body, count, lab.seed);
    let ways = [
        ("float, along normals", Coding::Float, Offset::Normals),
        ("8 bits, along normals", Coding::EightBit, Offset::Normals),
        ("float, layers of texels", Coding::Float, Offset::PixelLayers),
        ("8 bits, layers of texels", Coding::EightBit, Offset::PixelLayers),
    ];
    let caption = format!(
        "What {count} points meet in the maps of the built-in body, arms away from the trunk ({} triangles); the points lie from {} mm inside \
         to {} mm outside of its surface, even by area. Judged against the exact surface 5 mm outside of the mesh. Maps of floats, or of 24 bits \
         for depth and 8 for normals (D eq. 6, 7 and 10); thickness along the normals, or as D §5.4 adds it, with moved depths and layers of \
         texels. Computed by the CPU reference, seed {}.",
        body.triangles.len(),
        -1e3 * SHELL[0],
        1e3 * SHELL[1],
        lab.seed
    );
    let columns = [
        ["maps", ""],
        ["texel", "mm"],
        ["depth left, mean", "mm"],
        ["p99", "mm"],
        ["p99 where seen", "mm"],
        ["false contacts", "%"],
        ["false contacts where seen", "%"],
    ];
    let figures = "The figures of the plots above, and those of all points: where seen are the points whose nearest place on the mesh a camera of \
                   the maps sees.";
    let mut table = Table::new(figures, &columns);
    let mut depths = Vec::new();
    let mut false_contacts = Vec::new();
    for (index, (name, coding, offset)) in ways.into_iter().enumerate() {
        let mut points: Vec<(f64, MapError)> = Vec::new();
        for (place, texel) in texels.into_iter().enumerate() {
            let share = (index * texels.len() + place) as f64 / (ways.len() * texels.len()) as f64;
            lab.say(progress[0] + (progress[1] - progress[0]) * share, &format!("maps of {} mm", 1e3 * texel))?;
            let error = map_error(&body, &exact, &shell, Probing { texel, coding, offset });
            points.push((1e3 * texel, error));
            table.push(vec![
                Cell::text(name),
                Cell::number(1e3 * texel),
                Cell::number(1e3 * error.depth_mean),
                Cell::number(1e3 * error.depth_p99),
                Cell::number(1e3 * error.depth_p99_seen),
                Cell::number(1e2 * error.false_contacts),
                Cell::number(1e2 * error.false_contacts_seen),
            ]);
        }
        let curve =
            |of: fn(&MapError) -> f64| points.iter().map(move |(texel, error)| [*texel, of(error)]).collect::<Vec<_>>();
        depths.push(Series::new(name, SeriesStyle::LineAndMarks, curve(|error| 1e3 * error.depth_p99_seen)));
        false_contacts.push(Series::new(
            name,
            SeriesStyle::LineAndMarks,
            curve(|error| 1e2 * error.false_contacts_seen),
        ));
    }
    let plot = |series, label, unit| {
        Block::Plot(Plot { caption: caption.clone(), x: Axis::log("texel", "mm"), y: Axis::log(label, unit), series })
    };
    let [printed, corrected] = velocity_error(2.0, lab.seed);
    let velocities = format!(
        "Velocities in colours of 8 bits, even up to 2 m/s along each axis, have an error of {:.1} mm/s (root of the mean square) with the \
         factor that W eq. 10 has and eq. 9 misses, and of {:.0} mm/s as both are printed; floats have none that matters.",
        1e3 * corrected,
        1e3 * printed
    );
    Ok(vec![
        plot(depths, "depth left after the answer, p99 where seen", "mm"),
        plot(false_contacts, "false contacts where seen", "%"),
        Block::Table(table),
        Block::Text(velocities),
    ])
}
