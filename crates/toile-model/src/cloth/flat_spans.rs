//! Distances in the flat cloth, inside panels and across seams.

use crate::Csr;
use crate::cloth::flat_cloth::Cloth;
use crate::mesh::geometry::corners;
use glam::DVec2;

/// The flat cloth between two particles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FlatSpan {
    /// Its length [m].
    pub(crate) length: f64,
    /// Elongation that it allows [1].
    pub(crate) threshold: f64,
    /// The straight way from one to the other in their panel [m]; `None` where it goes across a seam or around a corner.
    pub(crate) way: Option<DVec2>,
}

/// Where the particles of a cloth are in its panels.
pub(crate) struct FlatSpans<'a> {
    cloth: &'a Cloth<'a>,
    rims: Csr<[u32; 2]>,
    /// Panel of each particle of the panels.
    panel_of: Vec<u32>,
    /// For each particle of the cloth those of the panels that it is made of.
    members: Csr<u32>,
    /// Of each panel the particles that are sewn to others.
    sewn: Csr<u32>,
}

impl<'a> FlatSpans<'a> {
    pub(crate) fn new(cloth: &'a Cloth<'a>) -> Self {
        let mut panel_of = vec![0; cloth.flat.len()];
        for (element, panel) in cloth.elements.iter().zip(&cloth.panels) {
            corners(element).iter().for_each(|&corner| panel_of[corner as usize] = *panel);
        }
        let mut rows = vec![Vec::new(); cloth.particle_count];
        for (particle, flat) in cloth.member_of.iter().zip(0..) {
            rows[*particle as usize].push(flat);
        }
        let members = Csr::from_rows(rows);
        let panel_count = cloth.panels.iter().max().map_or(0, |last| last + 1);
        let mut sewn = vec![Vec::new(); panel_count as usize];
        for (particle, flat) in cloth.member_of.iter().zip(0..) {
            if members.row(*particle as usize).len() > 1 {
                sewn[panel_of[flat as usize] as usize].push(flat);
            }
        }
        Self { cloth, rims: cloth.rims(), panel_of, members, sewn: Csr::from_rows(sewn) }
    }

    /// Between two particles that are joined by a way: the straight line inside a panel, or the shorter one across a seam, and the way
    /// where neither stays inside.
    pub(crate) fn between(&self, particles: [u32; 2], way: FlatSpan) -> FlatSpan {
        self.direct(particles, way.length).or_else(|| self.across(particles, way.length)).unwrap_or(way)
    }

    /// Inside one panel. A way that is shorter than the straight line does not lie in it.
    fn direct(&self, [a, b]: [u32; 2], way: f64) -> Option<FlatSpan> {
        let nearest = self.nearest(a, b)?;
        let span = self.straight(nearest);
        (span.length <= way * (1.0 + 1e-6) && self.is_inside(nearest, way)).then_some(span)
    }

    /// Across one seam, by the particle of it that makes the way shortest.
    fn across(&self, [a, b]: [u32; 2], way: f64) -> Option<FlatSpan> {
        let mut best = way;
        let mut halves = None;
        for p in self.members.row(a as usize) {
            for s in self.sewn.row(self.panel(*p) as usize) {
                let first = self.length([*p, *s]);
                if first >= best {
                    continue;
                }
                for t in self.members.row(self.cloth.member_of[*s as usize] as usize) {
                    for q in self.members.row(b as usize).iter().filter(|q| self.panel(**q) == self.panel(*t)) {
                        let length = first + self.length([*t, *q]);
                        if length < best {
                            best = length;
                            halves = Some([[*p, *s], [*t, *q]]);
                        }
                    }
                }
            }
        }
        let halves = halves?;
        if halves.iter().any(|half| !self.is_inside(*half, f64::INFINITY)) {
            return None;
        }
        let [one, other] = halves.map(|half| self.straight(half));
        let threshold = (one.length * one.threshold + other.length * other.threshold) / best;
        Some(FlatSpan { length: best, threshold, way: None })
    }

    /// From one particle to another inside a panel [m], the shorter where there are two ways; with the panel.
    pub(crate) fn way(&self, a: u32, b: u32) -> Option<(u32, DVec2)> {
        let [p, q] = self.nearest(a, b)?;
        Some((self.panel(p), self.straight([p, q]).way?))
    }

    fn nearest(&self, a: u32, b: u32) -> Option<[u32; 2]> {
        let pairs = self.members.row(a as usize).iter().flat_map(|p| {
            let others = self.members.row(b as usize).iter().filter(|q| self.panel(**q) == self.panel(*p));
            others.map(|q| [*p, *q])
        });
        pairs.min_by(|p, q| self.length(*p).total_cmp(&self.length(*q)))
    }

    fn panel(&self, flat: u32) -> u32 {
        self.panel_of[flat as usize]
    }

    fn length(&self, ends: [u32; 2]) -> f64 {
        let [a, b] = ends.map(|i| self.cloth.flat[i as usize]);
        a.distance(b)
    }

    fn straight(&self, ends: [u32; 2]) -> FlatSpan {
        let [a, b] = ends.map(|i| self.cloth.flat[i as usize]);
        FlatSpan { length: a.distance(b), threshold: self.cloth.threshold.along(b - a), way: Some(b - a) }
    }

    fn is_inside(&self, ends: [u32; 2], way: f64) -> bool {
        let points = ends.map(|i| self.cloth.flat[i as usize]);
        points[0] == points[1] || self.cloth.is_inside(self.panel(ends[0]), points, way, &self.rims)
    }
}
