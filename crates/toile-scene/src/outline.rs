//! The curves of a panel's outline as polylines.

use crate::{Curve, Panel};
use glam::DVec2;
use std::f64::consts::PI;

impl Panel {
    /// One edge as a polyline of flat points [m] from its start to its end, both included exactly.
    ///
    /// No point of the curve is farther than `tolerance` [m] from the polyline. Its points lie on the curve, evenly spaced
    /// in angle on an arc and in the parameter on a Bézier curve, so not in arc length.
    ///
    /// # Panics
    ///
    /// If the edge does not exist, or the tolerance is not positive.
    pub fn polyline(&self, edge: usize, tolerance: f64) -> Vec<DVec2> {
        assert!(tolerance > 0.0, "the tolerance of a polyline is positive");
        let start = self.edges[edge].start;
        let end = self.edges[(edge + 1) % self.edges.len()].start;
        let curve = Flattened::new(start, end, self.edges[edge].curve);
        let segments = curve.segment_count(tolerance);
        let inner = (1..segments).map(|i| curve.point(i as f64 / segments as f64));
        std::iter::once(start).chain(inner).chain([end]).collect()
    }
}

/// A curve with everything that its points share.
enum Flattened {
    Straight,
    Quadratic([DVec2; 3]),
    Cubic([DVec2; 4]),
    /// `along` is the unit chord; `sweep` [rad] is positive where the curve turns left.
    Arc {
        start: DVec2,
        along: DVec2,
        radius: f64,
        sweep: f64,
    },
}

impl Flattened {
    fn new(start: DVec2, end: DVec2, curve: Curve) -> Self {
        match curve {
            Curve::Straight => Self::Straight,
            Curve::Quadratic { control } => Self::Quadratic([start, control, end]),
            Curve::Cubic { controls: [first, second] } => Self::Cubic([start, first, second, end]),
            Curve::Arc { radius, large, right } => {
                let chord = end - start;
                // The file's radius is rounded, so a half circle may miss its ends by the last digit.
                let half = (0.5 * chord.length() / radius).min(1.0).asin();
                let sweep = 2.0 * if large { PI - half } else { half };
                Self::Arc {
                    start,
                    along: chord.normalize_or_zero(),
                    radius: radius.max(0.5 * chord.length()),
                    sweep: if right { sweep } else { -sweep },
                }
            }
        }
    }

    /// Number of straight pieces that keep the distance to the curve below the tolerance [m].
    fn segment_count(&self, tolerance: f64) -> usize {
        let exact = match self {
            Self::Straight => 1.0,
            // A piece of parameter length 1/n strays by at most |second derivative| / (8n²).
            Self::Quadratic([a, b, c]) => (2.0 * (*a - 2.0 * *b + *c).length() / (8.0 * tolerance)).sqrt(),
            Self::Cubic([a, b, c, d]) => {
                let bend = (*a - 2.0 * *b + *c).length().max((*b - 2.0 * *c + *d).length());
                (6.0 * bend / (8.0 * tolerance)).sqrt()
            }
            // The sagitta of a piece of angle φ is 2r·sin²(φ/4).
            Self::Arc { radius, sweep, .. } => {
                sweep.abs() / (4.0 * (tolerance / (2.0 * radius)).sqrt().min(1.0).asin())
            }
        };
        (exact.ceil() as usize).max(1)
    }

    /// Point at a parameter, 0 to 1.
    fn point(&self, t: f64) -> DVec2 {
        match self {
            Self::Straight => unreachable!("a straight edge has one segment"),
            Self::Quadratic([a, b, c]) => a.lerp(*b, t).lerp(b.lerp(*c, t), t),
            Self::Cubic([a, b, c, d]) => {
                let middle = b.lerp(*c, t);
                let first = a.lerp(*b, t).lerp(middle, t);
                first.lerp(middle.lerp(c.lerp(*d, t), t), t)
            }
            // The chord to the point, because a centre would lose every digit on a nearly straight arc.
            Self::Arc { start, along, radius, sweep } => {
                let half = 0.5 * sweep * t;
                let direction = DVec2::from_angle(half - 0.5 * sweep).rotate(*along);
                *start + direction * (2.0 * radius * half.abs().sin())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Curve, Edge, Panel, Placement};
    use glam::{DQuat, DVec2, DVec3, dvec2};

    fn panel(start: DVec2, curve: Curve, end: DVec2) -> Panel {
        let edge = |start, curve| Edge { start, curve, label: None };
        Panel {
            name: "one edge and back".into(),
            edges: vec![edge(start, curve), edge(end, Curve::Straight)],
            placement: Placement { rotation: DQuat::IDENTITY, translation: DVec3::ZERO },
        }
    }

    fn length(points: &[DVec2]) -> f64 {
        points.windows(2).map(|pair| pair[0].distance(pair[1])).sum()
    }

    #[test]
    fn a_straight_edge_is_its_two_ends() {
        let panel = panel(dvec2(1.0, 2.0), Curve::Straight, dvec2(3.0, 5.0));
        assert_eq!(panel.polyline(0, 1e-6), [dvec2(1.0, 2.0), dvec2(3.0, 5.0)]);
        assert_eq!(panel.polyline(1, 1e-6), [dvec2(3.0, 5.0), dvec2(1.0, 2.0)]);
    }

    #[test]
    fn every_arc_lies_on_its_circle_on_the_right_side() {
        let (start, end) = (dvec2(0.3, -0.2), dvec2(0.9, 0.6));
        // Half chord 0.5, radius 1.3, so the centre is 1.2 beside the chord.
        let (radius, aside) = (1.3, 1.2);
        let right_hand = dvec2(0.8, -0.6);
        for (large, right) in [(false, false), (false, true), (true, false), (true, true)] {
            let points = panel(start, Curve::Arc { radius, large, right }, end).polyline(0, 1e-5);
            let bulge = if right { right_hand } else { -right_hand };
            let middle = start.midpoint(end);
            let centre = middle + bulge * if large { aside } else { -aside };
            for point in &points {
                assert!((point.distance(centre) - radius).abs() < 1e-14, "{large} {right}");
            }
            let side = (points[points.len() / 2] - middle).dot(bulge);
            let depth = if large { radius + aside } else { radius - aside };
            assert!((side - depth).abs() < 1e-3, "{large} {right}: {side}");
            let angle = 2.0 * (0.5f64 / radius).asin();
            let angle = if large { std::f64::consts::TAU - angle } else { angle };
            assert!((length(&points) - radius * angle).abs() < 1e-4, "{large} {right}");
            assert_eq!((points[0], points[points.len() - 1]), (start, end));
        }
    }

    #[test]
    fn a_nearly_straight_arc_stays_on_its_chord() {
        let curve = Curve::Arc { radius: 1e12, large: false, right: true };
        let points = panel(dvec2(0.0, 0.0), curve, dvec2(1.0, 0.0)).polyline(0, 1e-14);
        assert!(points.len() > 2);
        for (i, point) in points.iter().enumerate() {
            let even = i as f64 / (points.len() - 1) as f64;
            assert!(point.distance(dvec2(even, 0.0)) < 1e-12, "{point}");
        }
    }

    #[test]
    fn a_half_circle_with_a_rounded_radius_reaches_both_ends() {
        let curve = Curve::Arc { radius: 0.499_999_99, large: false, right: false };
        let points = panel(dvec2(0.0, 0.0), curve, dvec2(1.0, 0.0)).polyline(0, 1e-6);
        assert!((length(&points) - 0.5 * std::f64::consts::PI).abs() < 1e-5);
        assert!(points.iter().all(|p| (p.distance(dvec2(0.5, 0.0)) - 0.5).abs() < 1e-7));
    }

    #[test]
    fn a_quadratic_is_the_parabola_it_stands_for() {
        // Control points (0,0), (1,2), (2,0) are y = 2x − x².
        let curve = Curve::Quadratic { control: dvec2(1.0, 2.0) };
        let points = panel(dvec2(0.0, 0.0), curve, dvec2(2.0, 0.0)).polyline(0, 1e-7);
        for p in &points {
            assert!((p.y - (2.0 * p.x - p.x * p.x)).abs() < 1e-14, "{p}");
        }
        // ∫ sqrt(1 + 4(1−x)²) dx over 0..2 = sqrt(5) + asinh(2)/2.
        assert!((length(&points) - (5f64.sqrt() + 0.5 * 2f64.asinh())).abs() < 1e-6);
    }

    #[test]
    fn a_cubic_is_the_cubic_it_stands_for() {
        // Control points with x = t at 0, 1/3, 2/3, 1 and y = 0, a/3, 0, 0 are y = a·x·(1−x)².
        let third = 1.0 / 3.0;
        let curve = Curve::Cubic { controls: [dvec2(third, 2.0 * third), dvec2(2.0 * third, 0.0)] };
        let points = panel(dvec2(0.0, 0.0), curve, dvec2(1.0, 0.0)).polyline(0, 1e-6);
        for p in &points {
            assert!((p.y - 2.0 * p.x * (1.0 - p.x).powi(2)).abs() < 1e-14, "{p}");
        }
    }

    #[test]
    fn the_middle_of_every_piece_is_within_the_tolerance_and_not_far_below_it() {
        let tolerance = 1e-3;
        let (radius, end) = (0.7, dvec2(1.0, 0.0));
        let curve = Curve::Arc { radius, large: true, right: true };
        let points = panel(DVec2::ZERO, curve, end).polyline(0, tolerance);
        let centre = dvec2(0.5, -(0.7f64 * 0.7 - 0.25).sqrt());
        let worst =
            points.windows(2).map(|pair| radius - pair[0].midpoint(pair[1]).distance(centre)).fold(0.0, f64::max);
        assert!(worst <= tolerance && worst > 0.8 * tolerance, "{worst}");
    }
}
