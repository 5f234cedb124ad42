//! The pieces of a mesh: what hangs together by edges that two triangles share, and how large it is.

use crate::body::disjoint::Disjoint;
use glam::{DVec3, Vec3};
use std::collections::HashMap;

/// Square of a rim's length over the area [1] from which on an open piece is a sheet. A disc has 4π, a hemisphere 2π, a body
/// with open soles less than 1.
pub(crate) const SHEET_RIM: f64 = 8.0;

/// Volume over area^1.5 [1] below which a sheet has no inside by which to turn it.
const HOLLOW: f64 = 0.01;

/// No triangle.
pub(crate) const NONE: u32 = u32::MAX;

/// Marks a neighbour that is wound against its triangle.
pub(crate) const AGAINST: u32 = 1 << 31;

/// The pieces of a mesh.
pub(crate) struct Pieces {
    /// The triangle across each side of each triangle, with [`AGAINST`]; [`NONE`] at a rim.
    pub across: Vec<[u32; 3]>,
    /// The piece of each triangle.
    pub of_triangle: Vec<u32>,
    /// Whether a triangle is wound against most of its piece.
    pub is_against: Vec<bool>,
    pub count: usize,
}

impl Pieces {
    pub fn of(triangles: &[[u32; 3]]) -> Self {
        let mut pieces = Self {
            across: across(triangles),
            of_triangle: vec![NONE; triangles.len()],
            is_against: vec![false; triangles.len()],
            count: 0,
        };
        let mut open: Vec<u32> = Vec::new();
        for seed in 0..triangles.len() {
            if pieces.of_triangle[seed] != NONE {
                continue;
            }
            let mut members: Vec<u32> = vec![seed as u32];
            pieces.of_triangle[seed] = pieces.count as u32;
            open.push(seed as u32);
            while let Some(triangle) = open.pop() {
                for across in pieces.across[triangle as usize].into_iter().filter(|across| *across != NONE) {
                    let next = (across & !AGAINST) as usize;
                    if pieces.of_triangle[next] == NONE {
                        pieces.of_triangle[next] = pieces.count as u32;
                        pieces.is_against[next] = pieces.is_against[triangle as usize] ^ (across & AGAINST != 0);
                        open.push(next as u32);
                        members.push(next as u32);
                    }
                }
            }
            let against = members.iter().filter(|member| pieces.is_against[**member as usize]).count();
            if 2 * against > members.len() {
                members.iter().for_each(|member| pieces.is_against[*member as usize] ^= true);
            }
            pieces.count += 1;
        }
        pieces
    }
}

/// The triangle across each side of each triangle, with [`AGAINST`]; [`NONE`] at a rim.
fn across(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let sides = |[a, b, c]: [u32; 3]| [(a, b), (b, c), (c, a)];
    let mut keys: Vec<(u64, u32, u8)> = Vec::with_capacity(3 * triangles.len());
    for (triangle, corners) in triangles.iter().enumerate() {
        for (side, (a, b)) in (0..).zip(sides(*corners)) {
            keys.push(((u64::from(a.min(b)) << 32) | u64::from(a.max(b)), triangle as u32, side));
        }
    }
    keys.sort_unstable();
    let mut across = vec![[NONE; 3]; triangles.len()];
    for edge in keys.chunk_by(|a, b| a.0 == b.0) {
        let [(_, first, first_side), (_, second, second_side)] = *edge else { continue };
        let start = |triangle: u32, side: u8| sides(triangles[triangle as usize])[side as usize].0;
        let against = if start(first, first_side) == start(second, second_side) { AGAINST } else { 0 };
        across[first as usize][first_side as usize] = second | against;
        across[second as usize][second_side as usize] = first | against;
    }
    across
}

/// What is known of a piece.
#[derive(Clone, Debug)]
pub(crate) struct Measure {
    pub triangle_count: usize,
    pub low: DVec3,
    pub high: DVec3,
    pub area: f64,
    /// Volume [m³] between the piece and its own middle; negative where it faces inward.
    volume: f64,
    /// Length of its longest rim [m].
    pub rim: f64,
}

impl Measure {
    const NOTHING: Self =
        Self { triangle_count: 0, low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, area: 0.0, volume: 0.0, rim: 0.0 };

    pub fn is_sheet(&self) -> bool {
        self.rim * self.rim > SHEET_RIM * self.area
    }

    pub fn is_inward(&self) -> bool {
        let least = if self.is_sheet() { HOLLOW * self.area.powf(1.5) } else { 0.0 };
        self.volume < -least
    }

    /// Extents of the box around it [m], smallest first.
    pub fn extents(&self) -> [f64; 3] {
        let mut extents = (self.high - self.low).to_array();
        extents.sort_by(f64::total_cmp);
        extents
    }

    pub fn length(&self) -> f64 {
        self.extents()[2]
    }
}

pub(crate) fn corners(positions: &[Vec3], triangle: [u32; 3]) -> [DVec3; 3] {
    triangle.map(|corner| positions[corner as usize].as_dvec3())
}

/// Measures the pieces as most of their triangles are wound.
pub(crate) fn measure(positions: &[Vec3], triangles: &[[u32; 3]], pieces: &Pieces) -> Vec<Measure> {
    let mut measures = vec![Measure::NOTHING; pieces.count];
    let mut middles = vec![DVec3::ZERO; pieces.count];
    for (triangle, piece) in triangles.iter().zip(&pieces.of_triangle) {
        let [a, b, c] = corners(positions, *triangle);
        let normal = 0.5 * (b - a).cross(c - a);
        let measure = &mut measures[*piece as usize];
        measure.triangle_count += 1;
        measure.low = measure.low.min(a.min(b).min(c));
        measure.high = measure.high.max(a.max(b).max(c));
        measure.area += normal.length();
        middles[*piece as usize] += normal.length() * (a + b + c) / 3.0;
    }
    middles.iter_mut().zip(&measures).for_each(|(middle, measure)| *middle /= measure.area.max(f64::MIN_POSITIVE));
    let mut rims: Vec<(u32, [u32; 2])> = Vec::new();
    let sided = triangles.iter().zip(&pieces.of_triangle).zip(&pieces.is_against);
    for (((triangle, piece), is_against), across) in sided.zip(&pieces.across) {
        let [a, b, c] = corners(positions, *triangle).map(|corner| corner - middles[*piece as usize]);
        let volume = a.dot(b.cross(c)) / 6.0;
        measures[*piece as usize].volume += if *is_against { -volume } else { volume };
        let [a, b, c] = *triangle;
        let sides = [[a, b], [b, c], [c, a]].into_iter().zip(across);
        rims.extend(sides.filter(|(_, across)| **across == NONE).map(|(side, _)| (*piece, side)));
    }
    rims.sort_unstable();
    for rims in rims.chunk_by(|a, b| a.0 == b.0) {
        measures[rims[0].0 as usize].rim = longest(positions, rims);
    }
    measures
}

/// Length of the longest of the rims of a piece [m].
fn longest(positions: &[Vec3], rims: &[(u32, [u32; 2])]) -> f64 {
    let mut numbers: HashMap<u32, u32> = HashMap::new();
    let mut next = |vertex: u32| {
        let count = numbers.len() as u32;
        *numbers.entry(vertex).or_insert(count)
    };
    let sides: Vec<[u32; 2]> = rims.iter().map(|(_, side)| side.map(&mut next)).collect();
    let mut sets = Disjoint::of(numbers.len());
    sides.iter().for_each(|[a, b]| sets.join(*a, *b));
    let mut lengths = vec![0.0; numbers.len()];
    for ([a, _], (_, side)) in sides.iter().zip(rims) {
        let [start, end] = side.map(|vertex| positions[vertex as usize].as_dvec3());
        lengths[sets.smallest(*a) as usize] += start.distance(end);
    }
    lengths.into_iter().fold(0.0, f64::max)
}
