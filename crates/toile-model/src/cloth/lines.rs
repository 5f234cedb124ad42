//! Lines of cloth that go straight on from particle to particle, across closed seams too.

use crate::mesh::elements::{Side, sectors, sides};
use crate::mesh::fan::opposite_neighbours;
use crate::mesh::geometry::corners;
use crate::{Csr, NO_CORNER, PanelMesh};
use glam::DVec2;
use std::collections::HashSet;
use toile_scene::Threshold;

/// A diagonal goes straight on where its direction changes by no more than the angle with this cosine [1].
const STRAIGHT: f64 = 0.866;

const NONE: u32 = u32::MAX;

/// Flat panels and which of their particles are one.
pub(crate) struct Cloth<'a> {
    /// Elements of all panels.
    pub(crate) elements: &'a [[u32; 4]],
    /// Panel of each element.
    pub(crate) panels: Vec<u32>,
    /// Flat positions [m].
    pub(crate) flat: &'a [DVec2],
    /// The particle of the sewn cloth that each particle of the panels is.
    pub(crate) member_of: &'a [u32],
    /// Number of particles of the sewn cloth.
    pub(crate) particle_count: usize,
    /// Elongation that the fabric allows, by direction.
    pub(crate) threshold: Threshold,
}

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
    /// `None` where two panels share it.
    panel: Option<u32>,
    span: Span,
}

/// The flat cloth between two particles of a line.
#[derive(Clone, Copy)]
pub(crate) struct Span {
    /// Its length [m].
    pub(crate) length: f64,
    /// Elongation that it allows [1].
    pub(crate) threshold: f64,
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

impl<'a> Cloth<'a> {
    /// The panels of an open model, and the particles of the cloth that theirs become.
    pub(crate) fn new(
        elements: &'a [[u32; 4]],
        panels: &[PanelMesh],
        flat: &'a [DVec2],
        member_of: &'a [u32],
        particle_count: usize,
        threshold: Threshold,
    ) -> Self {
        let panels = panels.iter().zip(0..).flat_map(|(mesh, panel)| mesh.quads.clone().map(move |_| panel)).collect();
        Self { elements, panels, flat, member_of, particle_count, threshold }
    }

    /// Open sides of the elements of each panel, as flat particles.
    pub(crate) fn rims(&self) -> Csr<[u32; 2]> {
        let panel_count = self.panels.iter().max().map_or(0, |last| last + 1);
        let mut rows = vec![Vec::new(); panel_count as usize];
        for group in sides(self.elements, |i| i).chunk_by(|a, b| a.ends == b.ends) {
            if let [side] = group {
                rows[self.panels[side.element as usize] as usize].push(side.ends);
            }
        }
        Csr::from_rows(rows)
    }

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

    /// The side that elements share; of two lengths and thresholds the smaller one rules, as for springs.
    fn edge(&self, group: &[Side]) -> Edge {
        let flat_ends = |side: &Side| {
            let element = &self.elements[side.element as usize];
            let loop_ = corners(element);
            let corner = side.corner as usize;
            let [a, b] = [loop_[corner], loop_[(corner + 1) % loop_.len()]];
            if self.member_of[a as usize] == side.ends[0] { [a, b] } else { [b, a] }
        };
        let panel = |side: &Side| self.panels[side.element as usize];
        let first = panel(&group[0]);
        Edge {
            ends: group[0].ends,
            flat_ends: flat_ends(&group[0]),
            panel: group.iter().all(|side| panel(side) == first).then_some(first),
            span: group
                .iter()
                .map(|side| self.straight(flat_ends(side)))
                .reduce(|a, b| Span { length: a.length.min(b.length), threshold: a.threshold.min(b.threshold) })
                .expect("a side has an element"),
        }
    }

    /// Between two particles of a panel.
    fn straight(&self, flat_ends: [u32; 2]) -> Span {
        let [a, b] = flat_ends.map(|i| self.flat[i as usize]);
        Span { length: a.distance(b), threshold: self.threshold.along(b - a) }
    }

    /// The lines along the diagonals of the quads; they end at seams.
    pub(crate) fn diagonal_lines(&self) -> Lines {
        let mut edges = Vec::new();
        for (element, panel) in self.elements.iter().zip(&self.panels) {
            let &[a, b, c, d] = element;
            if d == NO_CORNER {
                continue;
            }
            for flat_ends in [[a, c], [b, d]] {
                let ends = flat_ends.map(|i| self.member_of[i as usize]);
                edges.push(Edge { ends, flat_ends, panel: Some(*panel), span: self.straight(flat_ends) });
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

impl Cloth<'_> {
    /// What lies inside the flat panels between a place of a line and the particle so many edges on: the straight line where it stays inside,
    /// else the way along the line.
    pub(crate) fn span_from(&self, line: &Line, place: usize, edges: usize, rims: &Csr<[u32; 2]>) -> Span {
        let steps = &line.steps[place..place + edges];
        let length: f64 = steps.iter().map(|edge| edge.span.length).sum();
        let longer: f64 = steps.iter().map(|edge| edge.span.length * edge.span.threshold).sum();
        let way = Span { length, threshold: longer / length };
        let panel = steps[0].panel.filter(|panel| steps.iter().all(|edge| edge.panel == Some(*panel)));
        let Some(panel) = panel else { return way };
        let flat_ends = [steps[0].flat_ends[0], steps[steps.len() - 1].flat_ends[1]];
        let is_inside = self.is_inside(panel, flat_ends.map(|i| self.flat[i as usize]), length, rims);
        if is_inside { self.straight(flat_ends) } else { way }
    }

    /// Whether the straight line between two points of a panel stays inside, when a way of so many metres does.
    pub(crate) fn is_inside(&self, panel: u32, [a, b]: [DVec2; 2], way: f64, rims: &Csr<[u32; 2]>) -> bool {
        if way <= a.distance(b) * (1.0 + 1e-9) {
            return true;
        }
        let middle = a.midpoint(b);
        let mut crossings = 0;
        for ends in rims.row(panel as usize) {
            let [p, q] = ends.map(|i| self.flat[i as usize]);
            let side = |u: DVec2, v: DVec2, w: DVec2| (v - u).perp_dot(w - u);
            let crosses = side(a, b, p) * side(a, b, q) < 0.0 && side(p, q, a) * side(p, q, b) < 0.0;
            if crosses {
                return false;
            }
            if (p.y > middle.y) != (q.y > middle.y) {
                let x = p.x + (middle.y - p.y) / (q.y - p.y) * (q.x - p.x);
                crossings += u32::from(x > middle.x);
            }
        }
        crossings % 2 == 1
    }
}
