//! Which particles are on the wrong side of a body.

use super::solid::Solid;
use crate::Model;
use glam::Vec3;

/// A particle that is deeper than this is on the wrong side [m]; what is less deep is pressed.
const DEEP: f64 = 0.01;
/// No limb that cloth lies around is thinner [m]: a side of a cell is a chord there, whose middle is deeper than its ends.
const LIMB_RADIUS: f64 = 0.03;

/// How deep a point is inside a body when it is deeper than `least` [m].
fn depth(body: &Solid, point: Vec3, least: f64) -> Option<f64> {
    let point = point.as_dvec3();
    // The distance is the cheaper one, and most points are near.
    let distance = body.distance(point);
    (distance > least && distance.is_finite() && body.holds(point)).then_some(distance)
}

/// The particles of a cloth that are on the wrong side of a body, ascending, and how deep that goes [m].
///
/// Those are particles more than a centimetre inside it, by the winding number of its surfaces there, and the ends of springs whose middle is:
/// cloth that went through a limb hangs through it. It is a measure of the moment: a particle inside a closed surface crossed it an odd
/// number of times, however it moved. Cloth that went through a limb as a whole is on neither list; its [`Opening`](crate::Opening) is empty.
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
    ((0..).zip(&crossed).filter(|(_, crossed)| **crossed).map(|(particle, _)| particle).collect(), deepest)
}
