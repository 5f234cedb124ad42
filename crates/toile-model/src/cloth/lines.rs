//! Lines of cloth that go straight on from particle to particle, across closed seams too.

use crate::NO_CORNER;
use crate::cloth::flat_cloth::Cloth;
use crate::mesh::elements::{Side, sectors, sides};
use crate::mesh::fan::opposite_neighbours;
use crate::mesh::geometry::corners;
use std::collections::HashSet;

/// A diagonal goes straight on where its direction changes by no more than the angle with this cosine [1].
const STRAIGHT: f64 = 0.866;

const NONE: u32 = u32::MAX;

/// All lines of one kind.
pub(crate) struct Lines {
    edges: Vec<Edge>,
    /// Where each step goes on: step 2·k leads along edge k from its first end to its second, step 2·k + 1 back.
    next: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Edge {
    /// Particles of the sewn cloth.
    ends: [u32; 2],
    /// The same two in their panel.
    flat_ends: [u32; 2],
}

/// All edges that go straight on.
struct Chain {
    steps: Vec<Edge>,
    is_ring: bool,
}

/// A part of a chain, on which no particle comes twice.
pub(crate) struct Line {
    /// Particles of the sewn cloth, one after the other.
    pub(crate) particles: Vec<u32>,
    steps: Vec<Edge>,
}

impl Cloth<'_> {
    /// The lines along the sides of the elements: on a grid warp and weft.
    pub(crate) fn side_lines(&self) -> Lines {
        let sides = sides(self.elements, |i| self.member_of[i as usize]);
        let edges: Vec<Edge> = sides.chunk_by(|a, b| a.ends == b.ends).map(|group| self.edge(group)).collect();
        let step = |from: u32, to: u32| {
            let ends = [from.min(to), from.max(to)];
            let edge = edges.binary_search_by_key(&ends, |e| e.ends).expect("neighbours have a side in common") as u32;
            2 * edge + u32::from(from > to)
        };
        let mut next = vec![NONE; 2 * edges.len()];
        let sectors = sectors(self.elements, self.flat, self.particle_count, |i| self.member_of[i as usize]);
        for particle in 0..self.particle_count as u32 {
            for [a, b] in opposite_neighbours(sectors.row(particle as usize)) {
                next[step(a, particle) as usize] = step(particle, b);
                next[step(b, particle) as usize] = step(particle, a);
            }
        }
        Lines { next, edges }
    }

    /// The side that elements share.
    fn edge(&self, group: &[Side]) -> Edge {
        let flat_ends = |side: &Side| {
            let element = &self.elements[side.element as usize];
            let loop_ = corners(element);
            let corner = side.corner as usize;
            let [a, b] = [loop_[corner], loop_[(corner + 1) % loop_.len()]];
            if self.member_of[a as usize] == side.ends[0] { [a, b] } else { [b, a] }
        };
        Edge { ends: group[0].ends, flat_ends: flat_ends(&group[0]) }
    }

    /// The lines along the diagonals of the quads; they end at seams.
    pub(crate) fn diagonal_lines(&self) -> Lines {
        let mut edges = Vec::new();
        for element in self.elements {
            let &[a, b, c, d] = element;
            if d == NO_CORNER {
                continue;
            }
            for flat_ends in [[a, c], [b, d]] {
                let ends = flat_ends.map(|i| self.member_of[i as usize]);
                edges.push(Edge { ends, flat_ends });
            }
        }
        let mut leaving = vec![Vec::new(); self.flat.len()];
        for (k, edge) in edges.iter().enumerate() {
            let [from, to] = edge.flat_ends;
            leaving[from as usize].push(2 * k as u32);
            leaving[to as usize].push(2 * k as u32 + 1);
        }
        let mut next = vec![NONE; 2 * edges.len()];
        let heading = |step: u32| {
            let [from, to] = edges[step as usize / 2].flat_ends.map(|i| self.flat[i as usize]);
            if step.is_multiple_of(2) { (to - from).normalize() } else { (from - to).normalize() }
        };
        for steps in &leaving {
            let bend = |i: u32, j: u32| heading(i).dot(heading(j));
            let straightest =
                |i: u32| steps.iter().copied().filter(|&j| j != i).min_by(|&j, &k| bend(i, j).total_cmp(&bend(i, k)));
            for &i in steps {
                if let Some(j) = straightest(i).filter(|&j| straightest(j) == Some(i) && bend(i, j) < -STRAIGHT) {
                    next[i as usize ^ 1] = j;
                }
            }
        }
        Lines { next, edges }
    }
}

impl Lines {
    /// The lines, cut where a particle would come again, and across each cut a line of up to so many edges to both sides: a ring is held
    /// where it is cut too.
    pub(crate) fn cut(&self, edges_across: usize) -> Vec<Line> {
        let mut lines = Vec::new();
        let mut across = Vec::new();
        for chain in self.chains() {
            let mut start = 0;
            while start < chain.steps.len() {
                // A ring is cut at its beginning; the cut before its last edge is next to that one.
                let is_cut = if chain.is_ring { start + 1 < chain.steps.len() } else { start > 0 };
                if is_cut {
                    across.extend(chain.around(start, edges_across));
                }
                let line = chain.line(start);
                start += line.steps.len();
                lines.push(line);
            }
        }
        lines.extend(across);
        lines
    }

    /// The edges that go straight on, one after the other. Every edge is in just one chain.
    fn chains(&self) -> Vec<Chain> {
        let mut used = vec![false; self.edges.len()];
        let mut chains = Vec::new();
        let begins = |step: &u32| self.next[*step as usize ^ 1] == NONE;
        let steps = 0..2 * self.edges.len() as u32;
        // A ring has no step that begins it: it is taken last, from its first edge on.
        for first in steps.clone().filter(begins).chain(steps) {
            let mut here = first;
            let mut chain = Chain { steps: Vec::new(), is_ring: false };
            while here != NONE && !std::mem::replace(&mut used[here as usize / 2], true) {
                chain.steps.push(self.towards(here));
                here = self.next[here as usize];
            }
            chain.is_ring = here == first;
            if !chain.steps.is_empty() {
                chains.push(chain);
            }
        }
        chains
    }

    /// The edge of a step, its ends in the direction of the step.
    fn towards(&self, step: u32) -> Edge {
        let mut edge = self.edges[step as usize / 2];
        if !step.is_multiple_of(2) {
            edge.ends.reverse();
            edge.flat_ends.reverse();
        }
        edge
    }
}

impl Chain {
    /// From a step on, no particle twice.
    fn line(&self, start: usize) -> Line {
        let first = self.steps[start].ends[0];
        let mut line = Line { particles: vec![first], steps: Vec::new() };
        let mut met = HashSet::from([first]);
        for &edge in &self.steps[start..] {
            if !met.insert(edge.ends[1]) {
                break;
            }
            line.particles.push(edge.ends[1]);
            line.steps.push(edge);
        }
        line
    }

    /// Up to so many edges on both sides of the particle where a step begins, no particle twice.
    fn around(&self, step: usize, edges: usize) -> Option<Line> {
        let count = self.steps.len();
        let edges = if self.is_ring { edges.min((count - 1) / 2) } else { edges.min(step).min(count - step) };
        let steps: Vec<Edge> = (0..2 * edges).map(|k| self.steps[(count + step - edges + k) % count]).collect();
        // Where the chain crosses itself so near to the cut, what is left of it reaches less far.
        (0..edges)
            .map(|less| Self { steps: steps[less..steps.len() - less].to_vec(), is_ring: false })
            .map(|chain| (chain.line(0), chain.steps.len()))
            .find_map(|(line, count)| (line.steps.len() == count).then_some(line))
    }
}
