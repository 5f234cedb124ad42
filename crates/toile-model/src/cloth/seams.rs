//! Seams of the open model: which particles they pull together, and how fast.

use crate::SeamPair;
use glam::Vec3;
use toile_scene::{Garment, Seam};

/// Time in which a seam is to close [s]: 18 frames at 60 frames per second. Twice as fast, cloth is thrown against the body; twice as slow
/// gains nothing. The papers needed 55 to 150 steps (D tables 1 and 2).
const CLOSING_TIME: f64 = 0.3;

/// Smallest closing speed [m/s], so that a pair which starts nearly closed stays closed against its neighbours' pull.
const SLOWEST: f64 = 0.2;

/// Largest closing speed [m/s]: about 4 mm per step at 16 steps per frame and 60 frames per second, less than a texel, so that cloth
/// does not pass through the body between two steps.
const FASTEST: f64 = 4.0;

/// Ends whose two ways of matching differ by less than this part are matched by the winding.
const NEARLY_EQUAL: f64 = 0.1;

/// The pairs of all seams, each pair once, and the names of the seams. `edge_particles[panel][edge]` lists particles from the start
/// of an edge to its end.
pub(crate) fn seam_pairs(
    garment: &Garment,
    edge_particles: &[Vec<Vec<u32>>],
    positions: &[Vec3],
) -> (Vec<SeamPair>, Vec<String>) {
    let mut pairs = Vec::new();
    let mut names = Vec::new();
    for (index, seam) in garment.seams.iter().enumerate() {
        let [one, other] = seam.sides.map(|s| &edge_particles[s.panel][s.edge]);
        let reversed = runs_opposite(seam, one, other, positions);
        let count = one.len();
        for (k, &a) in one.iter().enumerate() {
            let b = other[if reversed { count - 1 - k } else { k }];
            if a == b {
                continue;
            }
            let gap = f64::from(positions[a as usize].distance(positions[b as usize]));
            pairs.push(SeamPair {
                ends: [a.min(b), a.max(b)],
                closing_speed: (gap / CLOSING_TIME).clamp(SLOWEST, FASTEST) as f32,
                seam: index as u32,
            });
        }
        let [one, other] = seam.sides.map(|s| format!("{}.{}", garment.panels[s.panel].name, s.edge));
        names.push(format!("{one} to {other}"));
    }
    // Seams that meet at a corner may pair the same two particles: the first seam keeps them.
    pairs.sort_by_key(|p| (p.ends, p.seam));
    pairs.dedup_by_key(|p| p.ends);
    (pairs, names)
}

/// Whether the second edge runs against the first: as the ends lie nearer to each other, or, when that does not tell, as
/// the winding says. Loops are counter-clockwise seen from outside, so two outsides that meet run opposite.
fn runs_opposite(seam: &Seam, one: &[u32], other: &[u32], positions: &[Vec3]) -> bool {
    let place = |i: u32| positions[i as usize].as_dvec3();
    let ends = |edge: &[u32]| [place(edge[0]), place(edge[edge.len() - 1])];
    let ([a0, a1], [b0, b1]) = (ends(one), ends(other));
    let along = a0.distance_squared(b0) + a1.distance_squared(b1);
    let against = a0.distance_squared(b1) + a1.distance_squared(b0);
    if (along - against).abs() <= NEARLY_EQUAL * along.max(against) { !seam.right_wrong } else { against < along }
}
