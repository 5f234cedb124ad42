//! What goes through the openings of a garment.

use super::parts::Part;
use super::place::Panels;
use super::solid::Solid;
use crate::Model;
use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// No limb goes through a loop that is shorter than this [m]: the wrist of a small child is 12 cm around.
const LIMB_GIRTH: f64 = 0.12;
/// What goes through an opening has at least this area there [m²]: a wrist of 12 cm has 11 cm², a finger less than 3.
const LIMB_AREA: f64 = 4e-4;
/// Distance of the points that are looked at in an opening [m].
const STEP: f64 = 0.01;
/// So many of them at most, or about that many.
const POINT_COUNT: f64 = 4000.0;

/// A loop in which a garment ends, and what goes through it: neck, hem, cuff, waist.
///
/// The loop is filled by a fan from its centre; what of the fan is inside the body goes through it. Which limb that is, is not said, and a
/// body part that only pokes into the fan counts as going through.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Opening {
    /// Its label, or the panels along it.
    pub name: String,
    /// Its length [m].
    pub girth: f32,
    /// Its centre [m].
    pub centre: [f32; 3],
    /// Number of limbs that go through it; 0 when it is empty.
    pub limb_count: u32,
    /// Area of the body in it [m²].
    pub area: f32,
}

/// The openings of a part of a garment at these positions [m]: none of a flat piece, and none that is too short for a limb.
pub(crate) fn openings(
    model: &Model,
    part: &Part,
    panels: &Panels<'_>,
    positions: &[Vec3],
    body: &Solid,
) -> Vec<Opening> {
    if part.loops.len() < 2 {
        return Vec::new();
    }
    let opening = |particles: &Vec<u32>| {
        let points: Vec<DVec3> = particles.iter().map(|&i| positions[i as usize].as_dvec3()).collect();
        let sides = || points.iter().zip(points.iter().cycle().skip(1));
        let girth: f64 = sides().map(|(a, b)| a.distance(*b)).sum();
        // Written so that NaN is none.
        let is_wide = girth >= LIMB_GIRTH;
        if !is_wide {
            return None;
        }
        // By length, so that it does not depend on how densely the loop is meshed.
        let centre = sides().map(|(a, b)| a.midpoint(*b) * a.distance(*b)).sum::<DVec3>() / girth;
        let [area, limb_count] = filled(centre, sides().map(|(a, b)| [*a, *b]), body);
        Some(Opening {
            name: label(model, particles).unwrap_or_else(|| panels.along(particles)),
            girth: girth as f32,
            centre: centre.as_vec3().to_array(),
            limb_count: limb_count as u32,
            area: area as f32,
        })
    };
    part.loops.iter().filter_map(opening).collect()
}

/// Area of the body in the fan from a centre over sides [m²], and the number of its pieces there that a limb can be.
fn filled(centre: DVec3, sides: impl Iterator<Item = [DVec3; 2]> + Clone, body: &Solid) -> [f64; 2] {
    let area_of = |[a, b]: [DVec3; 2]| 0.5 * (a - centre).cross(b - centre).length();
    let step = STEP.max((sides.clone().map(area_of).sum::<f64>() / POINT_COUNT).sqrt());
    let mut inside: Vec<(DVec3, f64)> = Vec::new();
    for [a, b] in sides {
        let longest = a.distance(centre).max(b.distance(centre)).max(a.distance(b));
        let count = (longest / step).ceil().max(1.0) as u32;
        let share = area_of([a, b]) / f64::from(count * count);
        let at = |u: f64, v: f64| centre + ((a - centre) * u + (b - centre) * v) / f64::from(count);
        for (i, j) in (0..count).flat_map(|i| (0..count - i).map(move |j| (f64::from(i), f64::from(j)))) {
            let third = 1.0 / 3.0;
            let upper = (i + j + 2.0 <= f64::from(count)).then(|| at(i + 2.0 * third, j + 2.0 * third));
            let points = [Some(at(i + third, j + third)), upper];
            inside.extend(points.into_iter().flatten().filter(|point| body.holds(*point)).map(|point| (point, share)));
        }
    }
    let pieces = pieces(&inside, 2.0 * step);
    [inside.iter().map(|(_, share)| share).sum(), pieces.iter().filter(|area| **area >= LIMB_AREA).count() as f64]
}

/// Areas of the pieces that points make which are nearer to each other than a reach [m].
fn pieces(points: &[(DVec3, f64)], reach: f64) -> Vec<f64> {
    let cell = |point: DVec3| (point / reach).floor().as_i64vec3().to_array();
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for (index, (point, _)) in points.iter().enumerate() {
        cells.entry(cell(*point)).or_default().push(index);
    }
    let mut seen = vec![false; points.len()];
    let mut areas = Vec::new();
    for first in 0..points.len() {
        if std::mem::replace(&mut seen[first], true) {
            continue;
        }
        let (mut area, mut open) = (0.0, vec![first]);
        while let Some(index) = open.pop() {
            let (point, share) = points[index];
            area += share;
            let [x, y, z] = cell(point);
            let near = (0..27).map(|k| [x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1]);
            for other in near.filter_map(|place| cells.get(&place)).flatten() {
                if !seen[*other] && points[*other].0.distance(point) < reach {
                    seen[*other] = true;
                    open.push(*other);
                }
            }
        }
        areas.push(area);
    }
    areas
}

/// The label that most particles of a loop have, if most have one.
fn label(model: &Model, particles: &[u32]) -> Option<String> {
    let shared = |hold: &crate::Hold| {
        let held = &model.held_particles[hold.particles.start as usize..hold.particles.end as usize];
        particles.iter().filter(|particle| held.contains(particle)).count()
    };
    let most = model.holds.iter().map(|hold| (shared(hold), hold)).max_by_key(|(count, _)| *count);
    most.filter(|(count, _)| 2 * count > particles.len()).map(|(_, hold)| hold.label.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;
    use std::f64::consts::TAU;
    use toile_scene::Mesh;

    fn around(centre: DVec3, radius: f64, body: &Solid) -> [f64; 2] {
        let at = |k: u32| {
            let angle = TAU * f64::from(k) / 32.0;
            centre + radius * dvec3(angle.cos(), 0.1 * (2.0 * angle).sin(), angle.sin())
        };
        filled(centre, (0..32).map(|k| [at(k), at(k + 1)]), body)
    }

    #[test]
    fn a_loop_counts_the_limbs_that_go_through_it() {
        let legs = [-0.1, 0.1].map(|x| Mesh::cuboid(Vec3::new(x - 0.05, 0.0, -0.05), Vec3::new(x + 0.05, 1.0, 0.05)));
        let body = Solid::of(&legs);
        let [area, count] = around(dvec3(0.0, 0.5, 0.0), 0.3, &body);
        assert!(count == 2.0 && (area - 0.02).abs() < 1e-3, "{area} m² of {count} limbs");
        let [area, count] = around(dvec3(0.1, 0.5, 0.0), 0.08, &body);
        assert!(count == 1.0 && (area - 0.01).abs() < 1e-3, "{area} m² of {count} limbs");
        assert_eq!(around(dvec3(0.1, 1.2, 0.0), 0.08, &body), [0.0, 0.0], "above them");
        assert_eq!(around(dvec3(0.4, 0.5, 0.0), 0.1, &body), [0.0, 0.0], "beside them");
    }
}
