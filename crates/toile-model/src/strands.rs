//! Strands: lines of cloth that go straight on from particle to particle, across closed seams too.

use crate::elements::{Side, sectors, sides};
use crate::fan::opposite_neighbours;
use crate::geometry::corners;
use crate::{Csr, NO_CORNER};
use glam::DVec2;

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
}

/// A stretch of strand between two particles of the sewn cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    /// The two particles, the lower index first.
    pub(crate) ends: [u32; 2],
    /// Distance inside the flat panels [m], never less than the shortest one.
    pub(crate) length: f64,
    /// Direction on a grid, below [`crate::colouring::FAMILIES`].
    pub(crate) family: u32,
}

/// All strands of one kind.
pub(crate) struct Strands<'a> {
    cloth: &'a Cloth<'a>,
    /// Open sides of the elements of each panel, as flat particles.
    rims: &'a Csr<[u32; 2]>,
    /// Steps of one particle to the next: 2·k goes from the first end of edge k to the second, 2·k + 1 back.
    next: Vec<u32>,
    edges: Vec<Edge>,
    /// The part of a strand that starts with each step, as far as it has been followed.
    parts: Vec<Option<Part>>,
    /// Number of edges of each part.
    cells: u32,
}

#[derive(Clone, Copy)]
struct Edge {
    /// Particles of the sewn cloth.
    ends: [u32; 2],
    /// The same two in their panel.
    flat_ends: [u32; 2],
    /// `None` where two panels share it.
    panel: Option<u32>,
    length: f64,
    family: Option<u32>,
}

#[derive(Clone, Copy)]
struct Part {
    last: u32,
    length: f64,
    /// The one panel that it runs in.
    panel: Option<u32>,
}

impl Cloth<'_> {
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

    /// The strands along the sides of the elements: on a grid warp and weft.
    pub(crate) fn side_strands<'a>(&'a self, rims: &'a Csr<[u32; 2]>) -> Strands<'a> {
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
        Strands::new(self, rims, edges, next)
    }

    /// The side that elements share; of two lengths the shorter one rules, as for springs.
    fn edge(&self, group: &[Side]) -> Edge {
        let flat_ends = |side: &Side| {
            let element = &self.elements[side.element as usize];
            let loop_ = corners(element);
            let corner = side.corner as usize;
            let [a, b] = [loop_[corner], loop_[(corner + 1) % loop_.len()]];
            if self.member_of[a as usize] == side.ends[0] { [a, b] } else { [b, a] }
        };
        let length = |side: &Side| {
            let [a, b] = flat_ends(side).map(|i| self.flat[i as usize]);
            a.distance(b)
        };
        let panel = |side: &Side| self.panels[side.element as usize];
        let first = panel(&group[0]);
        Edge {
            ends: group[0].ends,
            flat_ends: flat_ends(&group[0]),
            panel: group.iter().all(|side| panel(side) == first).then_some(first),
            length: group.iter().map(length).fold(f64::INFINITY, f64::min),
            family: None,
        }
    }

    /// The strands along the diagonals of the quads; they end at seams.
    pub(crate) fn diagonal_strands<'a>(&'a self, rims: &'a Csr<[u32; 2]>) -> Strands<'a> {
        let mut edges = Vec::new();
        for (element, panel) in self.elements.iter().zip(&self.panels) {
            let &[a, b, c, d] = element;
            if d == NO_CORNER {
                continue;
            }
            for (flat_ends, family) in [([a, c], 3), ([b, d], 2)] {
                let ends = flat_ends.map(|i| self.member_of[i as usize]);
                let [p, q] = flat_ends.map(|i| self.flat[i as usize]);
                edges.push(Edge { ends, flat_ends, panel: Some(*panel), length: p.distance(q), family: Some(family) });
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
        Strands::new(self, rims, edges, next)
    }
}

impl<'a> Strands<'a> {
    fn new(cloth: &'a Cloth<'a>, rims: &'a Csr<[u32; 2]>, edges: Vec<Edge>, next: Vec<u32>) -> Self {
        let steps = 0..2 * edges.len() as u32;
        let part = |step: u32| {
            let edge = &edges[step as usize / 2];
            Some(Part { last: step, length: edge.length, panel: edge.panel })
        };
        Self { cloth, rims, next, parts: steps.map(part).collect(), edges, cells: 1 }
    }

    /// Follows every strand to twice as many edges as before, and gives the stretches that long, each once, by their ends.
    pub(crate) fn doubled(&mut self) -> Vec<Stretch> {
        let follow = |part: &Option<Part>| {
            let part = (*part)?;
            let next = self.next[part.last as usize];
            let more = if next == NONE { None } else { self.parts[next as usize] }?;
            let panel = part.panel.filter(|panel| more.panel == Some(*panel));
            Some(Part { last: more.last, length: part.length + more.length, panel })
        };
        self.parts = self.parts.iter().map(follow).collect();
        self.cells *= 2;
        let parts = self.parts.iter().zip(0..);
        let mut stretches: Vec<Stretch> = parts.filter_map(|(part, first)| self.stretch(first, (*part)?)).collect();
        stretches.sort_unstable_by(|a, b| a.ends.cmp(&b.ends).then(a.length.total_cmp(&b.length)));
        stretches.dedup_by_key(|stretch| stretch.ends);
        stretches
    }

    /// Tail and head of the way from one step to another, among the particles of the cloth and among those of the panels.
    fn way(&self, first: u32, last: u32) -> [[u32; 2]; 2] {
        let [tail, head] = [(first, first % 2), (last, 1 - last % 2)].map(|(step, end)| {
            let edge = &self.edges[step as usize / 2];
            [edge.ends[end as usize], edge.flat_ends[end as usize]]
        });
        [[tail[0], head[0]], [tail[1], head[1]]]
    }

    fn stretch(&self, first: u32, part: Part) -> Option<Stretch> {
        let [ends, flat_ends] = self.way(first, part.last);
        if ends[0] >= ends[1] {
            return None;
        }
        let chord = part.panel.map(|panel| (panel, flat_ends.map(|i| self.cloth.flat[i as usize])));
        let length = match chord {
            Some((panel, [a, b])) if self.is_inside(panel, [a, b], part.length) => a.distance(b),
            _ => part.length,
        };
        // Particles are numbered row by row.
        let along_row = ends[1] - ends[0] == self.cells;
        let family = self.edges[first as usize / 2].family.unwrap_or(u32::from(!along_row));
        Some(Stretch { ends, length, family })
    }

    /// Whether the straight line between two points of a panel stays inside, when a way of so many metres does.
    fn is_inside(&self, panel: u32, [a, b]: [DVec2; 2], way: f64) -> bool {
        if way <= a.distance(b) * (1.0 + 1e-9) {
            return true;
        }
        let middle = a.midpoint(b);
        let mut crossings = 0;
        for ends in self.rims.row(panel as usize) {
            let [p, q] = ends.map(|i| self.cloth.flat[i as usize]);
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
