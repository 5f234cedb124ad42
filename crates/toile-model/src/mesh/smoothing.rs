//! Better angles in the rim: lattice particles next to it move a little.

use crate::Csr;
use crate::NO_CORNER;
use crate::mesh::geometry::{angle_range, corners};
use glam::DVec2;

/// Elements whose smallest angle is above this are good enough [degrees].
const GOOD_ANGLE: f64 = 40.0;

/// How much a lattice cell counts as better than a triangle of the same angles [degrees]: cells stay near 90°, so that only
/// a bad triangle can bend them.
const CELL_DEBIT: f64 = 30.0;

/// Sweeps over all particles.
const SWEEPS: u32 = 6;

/// Moves each of the `movable` particles to where the worst element around it is best. No element is inverted.
/// Returns whether any moved.
pub(crate) fn smooth(points: &mut [DVec2], elements: &[[u32; 4]], movable: &[u32], spacing: f64) -> bool {
    let mut around: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
    for (e, element) in elements.iter().enumerate() {
        for &corner in corners(element) {
            around[corner as usize].push(e as u32);
        }
    }
    let around = Csr::from_rows(around);
    let mut any = false;
    for sweep in 0..SWEEPS {
        let step = spacing * 0.3 * 0.6_f64.powi(sweep as i32);
        let mut moved = false;
        for &particle in movable {
            let row = around.row(particle as usize);
            let here = points[particle as usize];
            let mut best = (worst(row, elements, points), here);
            if best.0 >= GOOD_ANGLE {
                continue;
            }
            for direction in 0..8 {
                let angle = std::f64::consts::FRAC_PI_4 * f64::from(direction);
                let place = here + step * DVec2::from_angle(angle);
                points[particle as usize] = place;
                let quality = worst(row, elements, points);
                if quality > best.0 + 0.1 {
                    best = (quality, place);
                    moved = true;
                }
            }
            points[particle as usize] = best.1;
        }
        any |= moved;
    }
    any
}

/// Smallest angle in the given elements [degrees], a flat corner counting as small as it is near to 180°.
fn worst(row: &[u32], elements: &[[u32; 4]], points: &[DVec2]) -> f64 {
    row.iter()
        .map(|&e| {
            let element = &elements[e as usize];
            let [low, high] = angle_range(element, points);
            if element[3] == NO_CORNER {
                // An inverted triangle has an angle above 180° and counts as negative.
                low.min(180.0 - high)
            } else {
                low.min(180.0 - high) - CELL_DEBIT
            }
        })
        .fold(f64::INFINITY, f64::min)
}
