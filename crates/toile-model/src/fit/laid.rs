//! A panel as a lattice of points, so that what is seen of it does not depend on the spacing of its particles.

use crate::Inside;
use glam::{DVec2, DVec3};
use toile_scene::{Garment, Panel};

/// Distance of the points of a panel [m].
const LATTICE: f64 = 0.01;

/// The points of a flat panel.
pub(crate) struct Laid {
    /// Flat places [m].
    points: Vec<DVec2>,
    /// Its outside in its own space, +1 or −1 along z.
    outside: f64,
}

impl Laid {
    /// The panels of a garment.
    pub(crate) fn all(garment: &Garment) -> Vec<Self> {
        garment.panels.iter().map(Self::of).collect()
    }

    fn of(panel: &Panel) -> Self {
        let mut outline: Vec<DVec2> = (0..panel.edges.len())
            .flat_map(|edge| {
                let mut line = panel.polyline(edge, 0.1 * LATTICE);
                line.pop();
                line
            })
            .collect();
        outline.extend(outline.first().copied());
        let doubled: f64 = outline.windows(2).map(|ends| ends[0].perp_dot(ends[1])).sum();
        let mut points: Vec<DVec2> = outline.windows(2).flat_map(|ends| along(ends[0], ends[1])).collect();
        let rows = |y: f64| (y / LATTICE).floor() as i64;
        let heights = || outline.iter().map(|point| point.y);
        let [low, high] = [heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max)];
        for row in rows(low)..=rows(high) {
            let y = (row as f64 + 0.5) * LATTICE;
            let mut crossings: Vec<f64> = outline
                .windows(2)
                .filter(|ends| (ends[0].y > y) != (ends[1].y > y))
                .map(|ends| ends[0].x + (ends[1].x - ends[0].x) * (y - ends[0].y) / (ends[1].y - ends[0].y))
                .collect();
            crossings.sort_by(f64::total_cmp);
            for span in crossings.chunks_exact(2) {
                let (first, last) = ((span[0] / LATTICE).ceil() as i64, (span[1] / LATTICE).floor() as i64);
                points.extend((first..=last).map(|column| DVec2::new(column as f64 * LATTICE, y)));
            }
        }
        Self { points, outside: if doubled < 0.0 { -1.0 } else { 1.0 } }
    }

    /// Its points as it is placed [m].
    pub(crate) fn places(&self, panel: &Panel) -> impl Iterator<Item = DVec3> {
        let placement = panel.placement;
        self.points.iter().map(move |point| placement.world(*point))
    }

    /// The middle of its points as it is placed [m].
    pub(crate) fn middle(&self, panel: &Panel) -> DVec3 {
        self.places(panel).sum::<DVec3>() / self.points.len().max(1) as f64
    }

    /// Where its outside faces, level unless it lies flat; a unit vector.
    pub(crate) fn facing(&self, panel: &Panel) -> DVec3 {
        let normal = panel.placement.rotation * (DVec3::Z * self.outside);
        let level = DVec3::new(normal.x, 0.0, normal.z);
        if level.length() > 0.3 { level.normalize() } else { normal }
    }

    /// Smallest and largest corner of the box around it as it is placed [m].
    pub(crate) fn bounds(&self, panel: &Panel) -> Option<[DVec3; 2]> {
        let places = || self.places(panel);
        Some([places().reduce(DVec3::min)?, places().reduce(DVec3::max)?])
    }

    /// Its points that are inside a body [m].
    pub(crate) fn places_inside(&self, panel: &Panel, inside: &Inside) -> Vec<DVec3> {
        self.places(panel).filter(|place| inside.holds(*place)).collect()
    }

    /// Area of the panel [m²].
    pub(crate) fn area_of_all(&self) -> f64 {
        Self::area(self.points.len())
    }

    /// Area that so many of its points stand for [m²].
    pub(crate) fn area(count: usize) -> f64 {
        count as f64 * LATTICE * LATTICE
    }
}

/// Points on the way from one to the other, the first included.
fn along(from: DVec2, to: DVec2) -> impl Iterator<Item = DVec2> {
    let count = (from.distance(to) / LATTICE).ceil().max(1.0) as u32;
    (0..count).map(move |index| from.lerp(to, f64::from(index) / f64::from(count)))
}
