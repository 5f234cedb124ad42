//! How far a garment is stretched around the body.

use super::place::{Panels, Place};
use crate::Model;
use crate::union_find::UnionFind;
use glam::{DVec2, DVec3, Vec3};
use std::collections::{BTreeMap, HashMap};

/// Distance of the heights at which it is looked at [m].
const HEIGHT_STEP: f64 = 0.02;
/// Cuts that are shorter say nothing about the whole way around [m].
const LEAST_LENGTH: f64 = 0.15;

/// A cut through a garment at one height: one way around the body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Girth {
    pub(crate) place: Place,
    /// Its length now [m].
    pub(crate) length: f64,
    /// Its length in the flat panels [m].
    pub(crate) rest_length: f64,
}

impl Girth {
    /// Elongation of the whole way around [1].
    pub(crate) fn elongation(&self) -> f64 {
        self.length / self.rest_length - 1.0
    }
}

/// The cut that is stretched the most; `None` when there is none long enough. Each triangle tells how long its part of the cut is in the flat
/// panel, by the rest lengths of its sides.
pub(crate) fn tightest(model: &Model, panels: &Panels<'_>, positions: &[Vec3]) -> Option<Girth> {
    let rests: HashMap<[u32; 2], f64> =
        model.limits.iter().map(|limit| (sorted(limit.ends), f64::from(limit.rest_length))).collect();
    let mut levels: BTreeMap<i64, Vec<Piece>> = BTreeMap::new();
    for triangle in model.triangles() {
        let Some(flat) = flat(triangle, &rests) else { continue };
        let corners = triangle.map(|particle| positions[particle as usize].as_dvec3());
        let heights = corners.map(|corner| corner.y / HEIGHT_STEP);
        let (low, high) = (
            heights.iter().copied().fold(f64::INFINITY, f64::min),
            heights.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        );
        if !(high - low).is_finite() || high - low > 1e4 {
            continue;
        }
        for level in low.ceil() as i64..=high.floor() as i64 {
            levels.entry(level).or_default().extend(piece(triangle, corners, flat, level as f64 * HEIGHT_STEP));
        }
    }
    let cuts = levels.into_values().flat_map(|pieces| cuts(&pieces));
    let long = cuts.filter(|cut| cut.rest_length >= LEAST_LENGTH);
    let most = long.max_by(|a, b| (a.length / a.rest_length).total_cmp(&(b.length / b.rest_length)))?;
    let place = panels.place(&most.particles, positions)?;
    Some(Girth { place, length: most.length, rest_length: most.rest_length })
}

/// A triangle's part of a cut, from one of its sides to another.
struct Piece {
    sides: [[u32; 2]; 2],
    length: f64,
    rest_length: f64,
}

struct Cut {
    particles: Vec<u32>,
    length: f64,
    rest_length: f64,
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// A triangle laid flat by the rest lengths of its sides.
fn flat([a, b, c]: [u32; 3], rests: &HashMap<[u32; 2], f64>) -> Option<[DVec2; 3]> {
    let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|side| rests.get(&sorted(side)).copied());
    let (ab, bc, ca) = (ab?, bc?, ca?);
    let x = (ab * ab + ca * ca - bc * bc) / (2.0 * ab);
    Some([DVec2::ZERO, DVec2::new(ab, 0.0), DVec2::new(x, (ca * ca - x * x).max(0.0).sqrt())])
}

fn piece(triangle: [u32; 3], corners: [DVec3; 3], flat: [DVec2; 3], height: f64) -> Option<Piece> {
    // A corner at the height itself counts as above, so that each triangle is cut twice or not at all.
    let mut ends = (0..3).filter_map(|k| {
        let [from, to] = [k, (k + 1) % 3];
        let [below, above] = [corners[from].y, corners[to].y];
        ((below < height) != (above < height)).then(|| {
            let part = (height - below) / (above - below);
            let side = sorted([triangle[from], triangle[to]]);
            (side, corners[from].lerp(corners[to], part), flat[from].lerp(flat[to], part))
        })
    });
    let (one, other) = (ends.next()?, ends.next()?);
    Some(Piece { sides: [one.0, other.0], length: one.1.distance(other.1), rest_length: one.2.distance(other.2) })
}

/// The connected cuts that pieces of one height make.
fn cuts(pieces: &[Piece]) -> Vec<Cut> {
    let mut sides: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    let mut sets = UnionFind::new(pieces.len());
    for (piece, index) in pieces.iter().zip(0..) {
        for side in piece.sides {
            let known = *sides.entry(side).or_insert(index);
            sets.unite(known, index);
        }
    }
    let mut cuts: BTreeMap<u32, Cut> = BTreeMap::new();
    for (piece, index) in pieces.iter().zip(0..) {
        let empty = Cut { particles: Vec::new(), length: 0.0, rest_length: 0.0 };
        let cut = cuts.entry(sets.root(index)).or_insert(empty);
        cut.particles.extend(piece.sides.as_flattened());
        cut.length += piece.length;
        cut.rest_length += piece.rest_length;
    }
    cuts.into_values().collect()
}
