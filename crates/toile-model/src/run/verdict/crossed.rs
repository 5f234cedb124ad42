//! Which particles are on the wrong side of a body.

use super::solid::Solid;
use crate::Model;
use glam::Vec3;
use std::collections::HashMap;

/// A particle that is deeper than this is on the wrong side [m]; what is less deep is pressed.
const DEEP: f64 = 0.01;
/// No limb that cloth lies around is thinner [m]: a side of a cell is a chord there, whose middle is deeper than its ends.
const LIMB_RADIUS: f64 = 0.03;

/// A limb goes through a face that has a point this much deeper than its bend around a limb makes it [m]: of garments that are on none has.
const PIERCED: f64 = 0.005;
/// Points of a face are looked at so far from one another [m].
const APART: f32 = 0.01;

/// Points of a triangle, even over it.
fn points_of([a, b, c]: [Vec3; 3]) -> impl Iterator<Item = Vec3> {
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    let count = (longest / APART).ceil().clamp(1.0, 100.0) as u32;
    let at = move |index: u32| (index as f32 + 1.0 / 3.0) / count as f32;
    (0..count).flat_map(move |i| (0..count - i).map(move |j| a + (b - a) * at(i) + (c - a) * at(j)))
}

/// How deep a point is inside a body when it is deeper than `least` [m].
fn depth(body: &Solid, point: Vec3, least: f64) -> Option<f64> {
    let point = point.as_dvec3();
    // The distance is the cheaper one, and most points are near.
    let distance = body.distance(point);
    (distance > least && distance.is_finite() && body.holds(point)).then_some(distance)
}

/// The particles of a cloth that are on the wrong side of a body, ascending, and how deep that goes [m].
///
/// Those are particles more than a centimetre inside it, by the winding number of its surfaces there, the ends of springs whose middle is, and
/// the corners of faces that a limb goes through: cloth that went through a limb hangs through it, and a wrist goes through a single face. It is
/// a measure of the moment: a particle inside a closed surface crossed it an odd number of times, however it moved. Cloth that went through a
/// limb as a whole is on no such list; its [`Opening`](crate::Opening) is empty.
pub fn crossed_particles(model: &Model, positions: &[Vec3], body: &Solid) -> (Vec<u32>, f64) {
    let mut deepest = 0.0_f64;
    let mut crossed: Vec<bool> = positions
        .iter()
        .map(|point| depth(body, *point, DEEP).inspect(|depth| deepest = deepest.max(*depth)).is_some())
        .collect();
    for limit in &model.limits {
        let ends = limit.ends.map(|end| end as usize);
        let [a, b] = ends.map(|end| positions[end]);
        let rest = f64::from(limit.rest_length);
        // The middle is half of the spring away from where it would come in.
        if f64::from(a.distance(b)) < 2.0 * DEEP {
            continue;
        }
        if let Some(depth) = depth(body, a.midpoint(b), DEEP + rest * rest / (8.0 * LIMB_RADIUS)) {
            deepest = deepest.max(depth);
            ends.into_iter().for_each(|end| crossed[end] = true);
        }
    }
    let rests: HashMap<[u32; 2], f64> =
        model.limits.iter().map(|limit| (limit.ends, f64::from(limit.rest_length))).collect();
    for triangle in model.triangles() {
        let corners = triangle.map(|particle| positions[particle as usize]);
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        if depth(body, middle, 0.5 * PIERCED).is_none() {
            continue;
        }
        let sides = [[0, 1], [1, 2], [2, 0]].map(|[i, j]| {
            let [a, b] = [triangle[i].min(triangle[j]), triangle[i].max(triangle[j])];
            rests.get(&[a, b]).copied().unwrap_or(f64::from(corners[i].distance(corners[j])))
        });
        let side = sides.into_iter().fold(0.0, f64::max);
        let least = PIERCED + side * side / (8.0 * LIMB_RADIUS);
        let points = points_of(corners);
        let deep = points.filter_map(|point| depth(body, point, least)).fold(0.0, f64::max);
        if deep > 0.0 {
            deepest = deepest.max(deep);
            triangle.into_iter().for_each(|particle| crossed[particle as usize] = true);
        }
    }
    ((0..).zip(&crossed).filter(|(_, crossed)| **crossed).map(|(particle, _)| particle).collect(), deepest)
}
