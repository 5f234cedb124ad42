//! The arrays that follow from springs and quads: links, limits, colours, rows of quads.

use crate::cloth::colouring::{Pair, sort_by_colour};
use crate::cloth::soften::soften;
use crate::mesh::geometry::corners;
use crate::{Arrays, Csr, Limit, Link, Spring, SpringKind};
use toile_scene::Rule;

/// Part of the threshold that the limits of a rule hold [1]. Sweeps of hierarchical ones end before they converge; what is left goes on top.
pub(crate) const fn aim(rule: Rule) -> f32 {
    if matches!(rule, Rule::Hierarchical) { 0.6 } else { 1.0 }
}

/// A length [m] after an elongation [1].
pub(crate) fn stretched(length: f32, elongation: f32) -> f32 {
    (1.0 + elongation) * length
}

impl Arrays {
    /// Fills what follows from springs, seam pairs and quads.
    pub(crate) fn complete(mut self) -> Self {
        let count = self.positions.len();
        self.links = self.links_of_springs();
        if let Some(step) = self.step_wanted {
            soften(&mut self.links, &self.inverse_masses, step);
        }
        let mut limits: Vec<Limit> = self.spring_limits().collect();
        let above = self.above();
        let pairs: Vec<Pair> = self.limited().map(|s| Pair { ends: s.ends, family: family(s, &above) }).collect();
        self.limit_colours = sort_by_colour(&mut limits, &pairs, count);
        self.limits = limits;
        if self.attachments.row_count() == 0 {
            self.attachments = Csr::from_rows((0..count).map(|_| []));
        }
        let pairs: Vec<Pair> = self.seam_pairs.iter().map(|p| Pair { ends: p.ends, family: None }).collect();
        self.seam_colours = sort_by_colour(&mut self.seam_pairs, &pairs, count);
        let mut rows = vec![Vec::new(); count];
        for (q, quad) in self.quads.iter().enumerate() {
            for &corner in corners(quad) {
                rows[corner as usize].push(q as u32);
            }
        }
        self.particle_quads = Csr::from_rows(rows);
        self
    }

    /// The springs that have a limit.
    fn limited(&self) -> impl Iterator<Item = &Spring> {
        self.springs.iter().filter(|s| matches!(s.kind, SpringKind::Structural | SpringKind::Shear))
    }

    /// Limits of the springs that have one, in their order.
    pub(crate) fn spring_limits(&self) -> impl Iterator<Item = Limit> {
        let aim = aim(self.rule);
        self.limited().map(move |s| Limit {
            ends: s.ends,
            rest_length: s.rest_length,
            max_length: stretched(s.rest_length, aim * s.threshold),
        })
    }

    /// For each particle its neighbour in the next row: particles are numbered row by row.
    fn above(&self) -> Vec<Option<u32>> {
        let mut above = vec![None; self.positions.len()];
        for spring in self.springs.iter().filter(|s| s.kind == SpringKind::Structural) {
            let [a, b] = spring.ends;
            if b > a + 1 {
                above[a as usize] = Some(b);
            }
        }
        above
    }

    fn links_of_springs(&self) -> Csr<Link> {
        let mut rows = vec![Vec::new(); self.positions.len()];
        for spring in &self.springs {
            let [a, b] = spring.ends;
            for (here, other) in [(a, b), (b, a)] {
                rows[here as usize].push(Link { other, rest_length: spring.rest_length, stiffness: spring.stiffness });
            }
        }
        Csr::from_rows(rows)
    }
}

/// Direction of a structural or shear spring as the numbering row by row tells it: the diagonals to both sides of the next row, along the
/// row, and to the next row. Exact on a grid; elsewhere no more than a good guess, which is all that colouring needs. Diagonals come
/// first: where cloth whips around, each colour is drawn out again by those after it, and diagonals least by warp and weft.
fn family(spring: &Spring, above: &[Option<u32>]) -> Option<u32> {
    let [a, b] = spring.ends;
    match (spring.kind, above[a as usize]) {
        (SpringKind::Shear, Some(above)) if b < above => Some(0),
        (SpringKind::Shear, Some(_)) => Some(1),
        (SpringKind::Structural, _) if b == a + 1 => Some(2),
        (SpringKind::Structural, _) => Some(3),
        _ => None,
    }
}
