//! A floor that is one piece with the body, as a scan of both is: it is cut off, and the soles are closed.

use crate::body::pieces::{AGAINST, Measure, NONE, Pieces, SHEET_RIM, corners, measure};
use crate::body::sorting::{BEYOND, LEAST_AREA, SHEET_AREA};
use glam::{DVec3, Vec3};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::f64::consts::FRAC_PI_6;

/// Angle between a floor and its triangles [rad], up to which a rough one is flat.
const SLOPE: f64 = FRAC_PI_6;

/// Height of a layer over the size of the body [1], in which a floor is looked for.
const LAYER: f64 = 1.0 / 64.0;

/// Number of layers at the end of a piece in which a floor is looked for.
const LAYERS: usize = 8;

/// Least and largest height over the size of the body [1] by which a floor is cut off above its mean.
const CUT: [f64; 2] = [1.0 / 1024.0, 1.0 / 64.0];

/// Area below the cut over that of the floor [1]. If more lies there, it is no floor: things stand below it.
const BELOW: f64 = 1.15;

/// A floor that was cut off.
#[derive(Debug, PartialEq)]
pub(crate) struct Floor {
    pub triangle_count: usize,
    /// Sides of the box around it [m], the longer one first.
    pub sides: [f64; 2],
}

/// Cuts off the floor of the largest piece that has one, and closes what is left along the cut. Triangles keep their order.
pub(crate) fn cut_off(
    positions: &[Vec3],
    triangles: &mut Vec<[u32; 3]>,
    pieces: &Pieces,
    measures: &[Measure],
) -> Option<Floor> {
    // Whatever its shape, a floor has a rim as long as a sheet of its area has.
    let may_have = |measure: &Measure| measure.rim.powi(2) > 0.5 * SHEET_RIM * SHEET_AREA * measure.area;
    let candidates = (0u32..).zip(measures).filter(|(_, measure)| may_have(measure));
    let (piece, _) = candidates.max_by(|(_, a), (_, b)| a.area.total_cmp(&b.area))?;
    let scan = Scan::of(positions, triangles, pieces, piece);
    let ups = [scan.flattest(), DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|up| [up, -up]);
    let (floor, is_floor) = ups.into_iter().find_map(|up| scan.floor(up))?;
    let fan = closing(triangles, &pieces.across, |triangle| is_floor[triangle]);
    let mut flags = is_floor.iter();
    triangles.retain(|_| flags.next() != Some(&true));
    triangles.extend(fan);
    Some(floor)
}

/// One triangle of a piece.
struct Face {
    number: usize,
    corners: [DVec3; 3],
    area: f64,
    normal: DVec3,
}

/// A piece that may have a floor.
struct Scan<'a> {
    positions: &'a [Vec3],
    triangles: &'a [[u32; 3]],
    across: &'a [[u32; 3]],
    faces: Vec<Face>,
}

impl<'a> Scan<'a> {
    fn of(positions: &'a [Vec3], triangles: &'a [[u32; 3]], pieces: &'a Pieces, piece: u32) -> Self {
        let members = (0..).zip(&pieces.of_triangle).filter(|(_, of)| **of == piece);
        let face = |(number, _): (usize, &u32)| {
            let corners = corners(positions, triangles[number]);
            let doubled = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            Face { number, corners, area: 0.5 * doubled.length(), normal: doubled.normalize_or_zero() }
        };
        let faces = members.map(face).collect();
        Self { positions, triangles, across: &pieces.across, faces }
    }

    /// The direction in which most of the area looks, either way.
    fn flattest(&self) -> DVec3 {
        let turned =
            |axis: DVec3| self.faces.iter().map(|face| face.area * face.normal.dot(axis) * face.normal).sum::<DVec3>();
        let first = DVec3::AXES.into_iter().max_by(|a, b| turned(*a).length().total_cmp(&turned(*b).length()));
        // A few turns suffice: a floor outweighs the rest, or it is not found so.
        (0..8).fold(first.unwrap_or_default(), |axis, _| turned(axis).normalize_or_zero())
    }

    /// The floor at the lower end of a direction, and which triangles of the mesh are part of it.
    fn floor(&self, up: DVec3) -> Option<(Floor, Vec<bool>)> {
        let layer = self.lowest_layer(up)?;
        let is_below = |face: &Face, top: f64| face.corners.iter().all(|corner| corner.dot(up) <= top);
        let (lower, upper): (Vec<&Face>, Vec<&Face>) = self.faces.iter().partition(|face| is_below(face, layer.top));
        let lower_area: f64 = lower.iter().map(|face| face.area).sum();
        if lower_area > BELOW * layer.area {
            return None;
        }
        let mut is_floor = vec![false; self.triangles.len()];
        lower.iter().for_each(|face| is_floor[face.number] = true);
        let mut rest: Vec<[u32; 3]> = upper.iter().map(|face| self.triangles[face.number]).collect();
        rest.extend(closing(self.triangles, self.across, |triangle| is_floor[triangle]));
        let pieces = Pieces::of(&rest);
        let measures = measure(self.positions, &rest, &pieces);
        let solids = (0u32..).zip(&measures).filter(|(_, measure)| !measure.is_sheet());
        let (body, measure) = solids.max_by(|(_, a), (_, b)| a.area.total_cmp(&b.area))?;
        let [low, high] = bounds(&lower);
        let length = measure.length();
        let stands = measure.area > LEAST_AREA * length * length
            && layer.area > SHEET_AREA * length * length
            && (measure.low - low).max(high - measure.high).max_element() > BEYOND * length;
        // What of a rough floor rises above the cut is no part of the body.
        let is_bump = |(face, piece): &(&&Face, &u32)| **piece != body && is_below(face, layer.top + layer.height);
        for (face, _) in upper.iter().zip(&pieces.of_triangle).filter(is_bump) {
            is_floor[face.number] = true;
        }
        let mut sides = (high - low).to_array();
        sides.sort_by(|a, b| b.total_cmp(a));
        let triangle_count = is_floor.iter().filter(|is_floor| **is_floor).count();
        stands.then_some((Floor { triangle_count, sides: [sides[0], sides[1]] }, is_floor))
    }

    /// The flattest of the lowest layers in a direction. A floor may be rough or slant, but lies below all but specks.
    fn lowest_layer(&self, up: DVec3) -> Option<Layer> {
        let (flat, steep): (Vec<&Face>, Vec<&Face>) =
            self.faces.iter().partition(|face| face.normal.dot(up).abs() > SLOPE.cos());
        // What is steep is about the sides of the body.
        let size = steep.iter().map(|face| face.area).sum::<f64>().sqrt();
        let middle = |face: &Face| face.corners.iter().sum::<DVec3>().dot(up) / 3.0;
        let lowest = self.faces.iter().map(middle).fold(f64::INFINITY, f64::min);
        let height = LAYER * size;
        let mut areas = [0.0; LAYERS];
        for face in &flat {
            if let Some(area) = areas.get_mut(((middle(face) - lowest) / height) as usize) {
                *area += face.area;
            }
        }
        let most = (0..LAYERS).max_by(|a, b| areas[*a].total_cmp(&areas[*b]))?;
        let centre = lowest + (most as f64 + 0.5) * height;
        let faces = || flat.iter().filter(|face| (middle(face) - centre).abs() < height);
        let area: f64 = faces().map(|face| face.area).sum();
        let mean = |value: &dyn Fn(f64) -> f64| {
            let of_face = |face: &&&Face| face.corners.iter().map(|corner| value(corner.dot(up) - centre)).sum::<f64>();
            faces().map(|face| face.area * of_face(&face)).sum::<f64>() / (3.0 * area)
        };
        let rise = mean(&|height| height);
        let deviation = mean(&|height| (height - rise).powi(2)).sqrt();
        let top = centre + rise + (3.0 * deviation).clamp(CUT[0] * size, CUT[1] * size);
        (area > SHEET_AREA * size * size && top.is_finite()).then_some(Layer { area, top, height })
    }
}

/// A layer in which a floor may lie.
struct Layer {
    /// Area of what is flat in it [m²].
    area: f64,
    /// Height at which the floor is cut off [m].
    top: f64,
    /// Height of the layer itself [m].
    height: f64,
}

fn bounds(faces: &[&Face]) -> [DVec3; 2] {
    let corners = || faces.iter().flat_map(|face| face.corners);
    [corners().fold(DVec3::INFINITY, DVec3::min), corners().fold(DVec3::NEG_INFINITY, DVec3::max)]
}

/// Triangles that close each loop along a cut: a fan from one of its vertices.
fn closing(triangles: &[[u32; 3]], across: &[[u32; 3]], is_cut: impl Fn(usize) -> bool) -> Vec<[u32; 3]> {
    let ends_at_cut = |across: u32| across != NONE && is_cut((across & !AGAINST) as usize);
    let mut sides: Vec<[u32; 2]> = Vec::new();
    for (number, ([a, b, c], across)) in triangles.iter().zip(across).enumerate() {
        if !is_cut(number) {
            let along =
                [[*a, *b], [*b, *c], [*c, *a]].into_iter().zip(across).filter(|(_, across)| ends_at_cut(**across));
            sides.extend(along.map(|(side, _)| side));
        }
    }
    let mut beside: HashMap<u32, Vec<u32>> = HashMap::new();
    for [a, b] in &sides {
        beside.entry(*a).or_default().push(*b);
        beside.entry(*b).or_default().push(*a);
    }
    let mut pivots: HashMap<u32, u32> = HashMap::new();
    for [start, _] in &sides {
        let mut open = vec![*start];
        while let Some(vertex) = open.pop() {
            if let Entry::Vacant(entry) = pivots.entry(vertex) {
                entry.insert(*start);
                open.extend(&beside[&vertex]);
            }
        }
    }
    let fan = sides.into_iter().map(|[a, b]| [b, a, pivots[&a]]);
    fan.filter(|[b, a, pivot]| a != pivot && b != pivot).collect()
}
