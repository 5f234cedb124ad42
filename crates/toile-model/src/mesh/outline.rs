//! Particles along the outlines: the same number on both sides of a seam.

use crate::ModelError;
use crate::mesh::geometry::{segment_distance, signed_area};
use crate::mesh::rectangle::{Rectangle, rectangle_of};
use crate::union_find::UnionFind;
use glam::DVec2;
use toile_scene::{Garment, Panel};

/// How often the edges around a crossing are halved before the outline counts as crossing itself.
const HALVINGS: u32 = 6;

/// Part of the spacing that a polyline may stray from its curve.
const CURVE_TOLERANCE: f64 = 1e-3;

/// An edge shorter than this part of the spacing becomes one particle. The tiny elements at such an edge, which patterns have
/// where two curves were made equally long, would force a step many times smaller upon the whole garment.
const NEGLIGIBLE: f64 = 0.35;

/// And it must be shorter than this part of the panel's width, so that narrow panels keep their ends.
const NEGLIGIBLE_WIDTH: f64 = 0.1;

/// The outline of one panel as particles.
#[derive(Clone, Debug)]
pub(crate) struct Outline {
    /// Flat positions [m] in loop order.
    pub(crate) points: Vec<DVec2>,
    /// For each edge the index of its first particle; the edge ends at the first particle of the next one.
    pub(crate) starts: Vec<u32>,
    /// Its four sides when the panel is a rectangle.
    pub(crate) rectangle: Option<Rectangle>,
}

impl Outline {
    /// Indices of the particles of one edge, both ends included.
    pub(crate) fn edge(&self, edge: usize) -> Vec<u32> {
        let end = self.starts.get(edge + 1).copied().unwrap_or(self.points.len() as u32);
        (self.starts[edge]..end).chain([end % self.points.len() as u32]).collect()
    }

    /// Whether the loop runs clockwise.
    pub(crate) fn is_clockwise(&self) -> bool {
        signed_area(self.points.iter().copied()) < 0.0
    }

    /// Index of the edge that the segment after particle `point` belongs to.
    fn edge_of(&self, point: usize) -> usize {
        self.starts.partition_point(|&s| s as usize <= point) - 1
    }

    /// Two segments, by their first particle, that cross or touch although they are no neighbours, or that fold back on
    /// each other.
    fn crossing(&self, clearance: f64) -> Option<[usize; 2]> {
        let count = self.points.len();
        let segment = |k: usize| [self.points[k], self.points[(k + 1) % count]];
        let mut order: Vec<usize> = (0..count).collect();
        let left = |k: usize| segment(k)[0].x.min(segment(k)[1].x);
        order.sort_by(|&a, &b| left(a).total_cmp(&left(b)));
        for (i, &a) in order.iter().enumerate() {
            let [a0, a1] = segment(a);
            let right = a0.x.max(a1.x) + clearance;
            for &b in order[i + 1..].iter().take_while(|&&b| left(b) <= right) {
                let [b0, b1] = segment(b);
                let meet = if (a + 1) % count == b {
                    segment_distance(b1, [a0, a1]) < clearance || segment_distance(a0, [b0, b1]) < clearance
                } else if (b + 1) % count == a {
                    segment_distance(a1, [b0, b1]) < clearance || segment_distance(b0, [a0, a1]) < clearance
                } else {
                    segments_meet([a0, a1], [b0, b1], clearance)
                };
                if meet {
                    return Some([a.min(b), a.max(b)]);
                }
            }
        }
        None
    }
}

/// Whether two segments cross or come nearer than `clearance` [m].
fn segments_meet([a0, a1]: [DVec2; 2], [b0, b1]: [DVec2; 2], clearance: f64) -> bool {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p) > 0.0;
    let crossing = side(a0, a1, b0) != side(a0, a1, b1) && side(b0, b1, a0) != side(b0, b1, a1);
    crossing
        || [
            segment_distance(a0, [b0, b1]),
            segment_distance(a1, [b0, b1]),
            segment_distance(b0, [a0, a1]),
            segment_distance(b1, [a0, a1]),
        ]
        .into_iter()
        .any(|d| d < clearance)
}

/// One edge as a polyline with the arc length at each of its points.
struct EdgeCurve {
    points: Vec<DVec2>,
    lengths: Vec<f64>,
}

impl EdgeCurve {
    fn new(panel: &Panel, edge: usize, tolerance: f64) -> Self {
        let points = panel.polyline(edge, tolerance);
        let mut lengths = vec![0.0];
        for pair in points.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
        }
        Self { points, lengths }
    }

    fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// All points but the last, where the next edge starts.
    fn without_end(&self) -> impl Iterator<Item = DVec2> + Clone {
        self.points[..self.points.len() - 1].iter().copied()
    }

    /// Middle between its ends.
    fn middle(&self) -> DVec2 {
        self.points[0].midpoint(self.points[self.points.len() - 1])
    }

    /// Point at a fraction of the arc length.
    fn at(&self, fraction: f64) -> DVec2 {
        let wanted = fraction * self.length();
        let k = self.lengths.partition_point(|&l| l <= wanted).clamp(1, self.points.len() - 1);
        let step = self.lengths[k] - self.lengths[k - 1];
        let t = if step > 0.0 { (wanted - self.lengths[k - 1]) / step } else { 0.0 };
        self.points[k - 1].lerp(self.points[k], t)
    }
}

/// The outlines of all panels at a spacing [m].
///
/// Stitched edges, and opposite edges of a rectangle, get the same number of segments: their mean length over the
/// spacing, at least 1. A negligible edge becomes one particle in its middle. Where an outline would cross itself because the spacing is too coarse for it, the edges in question are halved.
///
/// # Errors
/// [`ModelError::NoArea`] and [`ModelError::Crossing`].
pub(crate) fn outlines(garment: &Garment, spacing: f64) -> Result<Vec<Outline>, ModelError> {
    let curves: Vec<Vec<EdgeCurve>> = garment
        .panels
        .iter()
        .map(|p| (0..p.edges.len()).map(|e| EdgeCurve::new(p, e, CURVE_TOLERANCE * spacing)).collect())
        .collect();
    let mut counts = Counts::new(garment, &curves, spacing);
    loop {
        let mut crossed = Vec::new();
        let mut result = Vec::with_capacity(curves.len());
        for (index, (panel, edges)) in garment.panels.iter().zip(&curves).enumerate() {
            let outline = counts.sample(index, edges);
            let fine = signed_area(edges.iter().flat_map(EdgeCurve::without_end));
            if fine == 0.0 || !fine.is_finite() {
                return Err(ModelError::NoArea { panel: panel.name.clone() });
            }
            let area = signed_area(outline.points.iter().copied());
            if outline.points.len() < 3 || area.signum() != fine.signum() {
                crossed.extend((0..edges.len()).map(|e| (index, [e, e])));
            } else if let Some(segments) = outline.crossing(1e-6 * spacing) {
                crossed.push((index, segments.map(|s| outline.edge_of(s))));
            }
            result.push(outline);
        }
        let Some(&(panel, edges)) = crossed.first() else { return Ok(result) };
        // Each round halves at least one class of edges, and none more often than allowed: so the rounds end.
        if !counts.halve(&crossed) {
            return Err(ModelError::Crossing {
                panel: garment.panels[panel].name.clone(),
                edges,
                spacing: spacing / f64::from(1 << HALVINGS),
            });
        }
    }
}

/// Which edges of a panel are so short that they become one particle. Their neighbours are not: an outline of many short
/// edges is a curve.
fn negligible_edges(curves: &[EdgeCurve], spacing: f64) -> Vec<bool> {
    let area = signed_area(curves.iter().flat_map(EdgeCurve::without_end)).abs();
    let length: f64 = curves.iter().map(EdgeCurve::length).sum();
    let width = 2.0 * area / length;
    let short: Vec<bool> =
        curves.iter().map(|c| c.length() < NEGLIGIBLE * spacing && c.length() < NEGLIGIBLE_WIDTH * width).collect();
    let count = short.len();
    (0..count).map(|k| short[k] && !short[(k + 1) % count] && !short[(k + count - 1) % count]).collect()
}

/// Number of segments of every edge.
struct Counts {
    /// Number of the first edge of each panel among all edges.
    firsts: Vec<u32>,
    /// Edges with the same number of segments.
    classes: UnionFind,
    /// Number of segments by representative.
    segments: Vec<u32>,
    /// How often each class was halved, by representative.
    halvings: Vec<u32>,
    /// For an unstitched side of a rectangle the edges opposite to it: it has as many segments as they have together.
    sums: Vec<(u32, Vec<u32>)>,
    rectangles: Vec<Option<Rectangle>>,
}

impl Counts {
    fn new(garment: &Garment, curves: &[Vec<EdgeCurve>], spacing: f64) -> Self {
        let mut firsts = vec![0];
        for panel in &garment.panels {
            firsts.push(firsts[firsts.len() - 1] + panel.edges.len() as u32);
        }
        let edge_count = firsts[garment.panels.len()] as usize;
        let mut classes = UnionFind::new(edge_count);
        let mut stitched = vec![false; edge_count];
        for seam in &garment.seams {
            let [a, b] = seam.sides.map(|s| {
                assert!(s.edge < garment.panels[s.panel].edges.len(), "the sides of a seam are edges of its panels");
                firsts[s.panel] + s.edge as u32
            });
            stitched[a as usize] = true;
            stitched[b as usize] = true;
            classes.unite(a, b);
        }
        let mut sums = Vec::new();
        let rectangles: Vec<_> = garment.panels.iter().map(rectangle_of).collect();
        for (rectangle, first) in rectangles.iter().zip(&firsts) {
            let Some(rectangle) = rectangle else { continue };
            for [one, other] in [[0, 2], [1, 3]].map(|pair| pair.map(|s| rectangle.edges(s))) {
                let [one, other] =
                    [one, other].map(|edges| edges.iter().map(|&e| first + e as u32).collect::<Vec<_>>());
                match (one.as_slice(), other.as_slice()) {
                    (&[a], &[b]) => classes.unite(a, b),
                    (&[a], _) if !stitched[a as usize] => sums.push((a, other)),
                    (_, &[b]) if !stitched[b as usize] => sums.push((b, one)),
                    _ => {}
                }
            }
        }
        let mut lengths = vec![(0.0, 0); edge_count];
        for (edge, curve) in curves.iter().flatten().enumerate() {
            let class = &mut lengths[classes.root(edge as u32) as usize];
            *class = (class.0 + curve.length(), class.1 + 1);
        }
        let mut segments: Vec<u32> = lengths
            .iter()
            .map(|&(sum, count)| (sum / f64::from(count.max(1)) / spacing).round().max(1.0) as u32)
            .collect();
        let mut kept = vec![false; edge_count];
        for (edge, negligible) in curves.iter().flat_map(|c| negligible_edges(c, spacing)).enumerate() {
            kept[classes.root(edge as u32) as usize] |= !negligible;
        }
        segments.iter_mut().zip(&kept).filter(|(_, kept)| !**kept).for_each(|(count, _)| *count = 0);
        Self { firsts, classes, segments, halvings: vec![0; edge_count], sums, rectangles }
    }

    fn of(&mut self, edge: u32) -> u32 {
        if let Some((_, others)) = self.sums.iter().find(|(e, _)| *e == edge) {
            let others = others.clone();
            return others.into_iter().map(|e| self.of(e)).sum();
        }
        self.segments[self.classes.root(edge) as usize]
    }

    fn sample(&mut self, panel: usize, curves: &[EdgeCurve]) -> Outline {
        let mut points = Vec::new();
        let mut starts = Vec::with_capacity(curves.len());
        for (edge, curve) in curves.iter().enumerate() {
            let first = self.firsts[panel];
            let before = (edge + curves.len() - 1) % curves.len();
            let start = if self.of(first + before as u32) == 0 { curves[before].middle() } else { curve.at(0.0) };
            let count = self.of(first + edge as u32);
            starts.push(points.len() as u32);
            if count > 0 {
                points.push(start);
                points.extend((1..count).map(|k| curve.at(f64::from(k) / f64::from(count))));
            }
        }
        Outline { points, starts, rectangle: self.rectangles[panel].clone() }
    }

    /// Doubles the segments of the given edges; `false` when one was doubled too often already.
    fn halve(&mut self, crossed: &[(usize, [usize; 2])]) -> bool {
        let mut roots: Vec<usize> = crossed
            .iter()
            .flat_map(|&(panel, edges)| edges.map(|e| self.firsts[panel] + e as u32))
            .map(|e| self.classes.root(e) as usize)
            .collect();
        roots.sort_unstable();
        roots.dedup();
        for root in roots {
            if self.halvings[root] == HALVINGS {
                return false;
            }
            self.halvings[root] += 1;
            self.segments[root] *= 2;
        }
        true
    }
}
