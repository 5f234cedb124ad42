//! Who is next to whom in a mesh of quads and triangles.

use crate::Csr;
use crate::mesh::fan::Sector;
use crate::mesh::geometry::{corners, inner_angle};
use glam::DVec2;

/// One side of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Side {
    /// Its particles, the lower index first.
    pub(crate) ends: [u32; 2],
    /// Index of the element.
    pub(crate) element: u32,
    /// Corner of the element where the side starts.
    pub(crate) corner: u32,
}

/// All sides of all elements, those between the same two particles next to each other. Corners that `member_of` makes one are one.
pub(crate) fn sides(elements: &[[u32; 4]], member_of: impl Fn(u32) -> u32) -> Vec<Side> {
    let mut sides = Vec::with_capacity(4 * elements.len());
    for (e, element) in elements.iter().enumerate() {
        let loop_ = corners(element);
        for k in 0..loop_.len() {
            let [a, b] = [loop_[k], loop_[(k + 1) % loop_.len()]].map(&member_of);
            if a != b {
                sides.push(Side { ends: [a.min(b), a.max(b)], element: e as u32, corner: k as u32 });
            }
        }
    }
    sides.sort_unstable();
    sides
}

/// For each of `count` particles its sectors. Corners that `member_of` makes one are one; angles come from the flat panels.
pub(crate) fn sectors(
    elements: &[[u32; 4]],
    flat: &[DVec2],
    count: usize,
    member_of: impl Fn(u32) -> u32,
) -> Csr<Sector> {
    let mut rows: Vec<Vec<Sector>> = vec![Vec::new(); count];
    for element in elements {
        let loop_ = corners(element);
        let corner_count = loop_.len();
        for k in 0..corner_count {
            let [previous, here, next] = [k + corner_count - 1, k, k + 1].map(|j| loop_[j % corner_count]);
            let [to_previous, to_next] = [previous, next].map(|i| flat[i as usize] - flat[here as usize]);
            // Clockwise panels list their corners clockwise in the flat: the inner angle is then the other one.
            let angle = inner_angle(to_previous, to_next);
            let neighbours = [next, previous].map(&member_of);
            if neighbours[0] != neighbours[1] && !neighbours.contains(&member_of(here)) {
                rows[member_of(here) as usize].push(Sector { neighbours, angle: angle.min(360.0 - angle) });
            }
        }
    }
    Csr::from_rows(rows)
}
