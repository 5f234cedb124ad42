//! Cuts into a panel: an outline that goes in along a line and comes back on it, as a dart inside of a panel is drawn.

use glam::DVec2;
use toile_scene::{Curve, Edge};

/// Distance of both sides of a cut from the line on which they were drawn [m]. An outline must not touch itself, and a
/// pair of scissors takes about as much.
const HALF_WIDTH: f64 = 2.5e-4;

/// Distance [m] within which two points of a drawing are one.
const SAME: f64 = 1e-6;

/// Moves the two sides of each cut apart, into the cloth. What is not drawn twice keeps its place.
pub(crate) fn open(edges: &mut [Edge]) {
    let count = edges.len();
    let ends = |edge: usize| [edges[edge].start, edges[(edge + 1) % count].start];
    let mut is_side = vec![false; count];
    // Sorted by the middle of the chord, the two sides of a cut lie side by side: outlines can have many edges.
    let middle = |edge: usize| ends(edge)[0].midpoint(ends(edge)[1]);
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| middle(*a).x.total_cmp(&middle(*b).x));
    for (at, a) in order.iter().enumerate() {
        let near = order[at + 1..].iter().take_while(|b| middle(**b).x - middle(*a).x <= SAME);
        for b in near {
            if runs_back(ends(*a), &edges[*a].curve, ends(*b), &edges[*b].curve) {
                is_side[*a] = true;
                is_side[*b] = true;
            }
        }
    }
    if !is_side.contains(&true) {
        return;
    }
    let doubled: f64 = (0..count).map(|edge| ends(edge)[0].perp_dot(ends(edge)[1])).sum();
    let inward = |edge: usize| {
        let along = (ends(edge)[1] - ends(edge)[0]).normalize_or_zero();
        along.perp() * if doubled < 0.0 { -1.0 } else { 1.0 }
    };
    let move_of = |vertex: usize| {
        let sides = [(vertex + count - 1) % count, vertex].into_iter().filter(|edge| is_side[*edge]);
        let normals: Vec<DVec2> = sides.map(inward).collect();
        match normals[..] {
            [normal] => normal * HALF_WIDTH,
            // At a bend both sides keep their distance; the tip of a cut stays.
            [a, b] if a.dot(b) > -0.5 => (a + b) * (HALF_WIDTH / (1.0 + a.dot(b))),
            _ => DVec2::ZERO,
        }
    };
    let moves: Vec<DVec2> = (0..count).map(move_of).collect();
    for (edge, moved) in edges.iter_mut().zip(0..) {
        let way = [moves[moved], moves[(moved + 1) % count]];
        edge.start += way[0];
        match &mut edge.curve {
            Curve::Straight | Curve::Arc { .. } => {}
            Curve::Quadratic { control } => *control += way[0].midpoint(way[1]),
            Curve::Cubic { controls } => {
                controls[0] += way[0].lerp(way[1], 1.0 / 3.0);
                controls[1] += way[0].lerp(way[1], 2.0 / 3.0);
            }
        }
    }
}

/// Whether one edge is the other one, drawn back.
fn runs_back(a: [DVec2; 2], a_curve: &Curve, b: [DVec2; 2], b_curve: &Curve) -> bool {
    let same = |a: DVec2, b: DVec2| a.distance(b) <= SAME;
    if !(same(a[0], b[1]) && same(a[1], b[0])) {
        return false;
    }
    match (a_curve, b_curve) {
        (Curve::Straight, Curve::Straight) => true,
        (Curve::Quadratic { control: a }, Curve::Quadratic { control: b }) => same(*a, *b),
        (Curve::Cubic { controls: a }, Curve::Cubic { controls: b }) => same(a[0], b[1]) && same(a[1], b[0]),
        (
            Curve::Arc { radius: a, large: a_large, right: a_right },
            Curve::Arc { radius: b, large: b_large, right: b_right },
        ) => (a - b).abs() <= SAME && a_large == b_large && a_right != b_right,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::{HALF_WIDTH, open};
    use crate::garment::crossing::first_crossing;
    use glam::{DQuat, DVec2, DVec3, dvec2};
    use toile_scene::{Curve, Edge, Panel, Placement};

    fn panel(corners: &[[f64; 2]]) -> Panel {
        let edge = |corner: &[f64; 2]| Edge::new(DVec2::from(*corner), Curve::Straight);
        Panel::new(
            "p",
            corners.iter().map(edge).collect(),
            Placement { rotation: DQuat::IDENTITY, translation: DVec3::ZERO },
        )
    }

    fn crosses(panel: &Panel) -> bool {
        let polylines: Vec<_> = (0..panel.edges.len()).map(|edge| panel.polyline(edge, 1e-4)).collect();
        first_crossing(&polylines).is_some()
    }

    fn area(panel: &Panel) -> f64 {
        let starts: Vec<DVec2> = panel.edges.iter().map(|edge| edge.start).collect();
        (0..starts.len()).map(|i| 0.5 * starts[i].perp_dot(starts[(i + 1) % starts.len()])).sum()
    }

    /// A square of 1 m with a cut from the middle of its lower side to a diamond.
    const KEYHOLE: [[f64; 2]; 11] = [
        [0.0, 0.0],
        [0.5, 0.0],
        [0.5, 0.3],
        [0.4, 0.5],
        [0.5, 0.7],
        [0.6, 0.5],
        [0.5, 0.3],
        [0.5, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
    ];

    #[test]
    fn a_keyhole_opens_either_way_around() {
        let mut reversed = KEYHOLE;
        reversed.reverse();
        for corners in [KEYHOLE, reversed] {
            let mut panel = panel(&corners);
            assert!(crosses(&panel));
            let before = area(&panel);
            open(&mut panel.edges);
            assert!(!crosses(&panel));
            let lost = before.abs() - area(&panel).abs();
            assert!((lost - 2.0 * HALF_WIDTH * 0.3).abs() < 1e-4, "{lost}");
            for (edge, corner) in panel.edges.iter().zip(corners) {
                let moved = edge.start.distance(DVec2::from(corner));
                let expected = if corner[0] == 0.5 && corner[1] < 0.6 { HALF_WIDTH } else { 0.0 };
                assert!((moved - expected).abs() < 1e-9, "{corner:?} {moved}");
            }
        }
    }

    #[test]
    fn a_cut_that_bends_and_ends_in_a_point_opens() {
        let mut panel = panel(&[
            [0.0, 0.0],
            [0.4, 0.0],
            [0.4, 0.4],
            [0.7, 0.4],
            [0.4, 0.4],
            [0.4, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
        ]);
        open(&mut panel.edges);
        assert!(!crosses(&panel));
        assert_eq!(panel.edges[3].start, dvec2(0.7, 0.4));
        assert!(panel.edges[2].start.distance(dvec2(0.4 - HALF_WIDTH, 0.4 + HALF_WIDTH)) < 1e-12);
        assert!(panel.edges[4].start.distance(dvec2(0.4 + HALF_WIDTH, 0.4 - HALF_WIDTH)) < 1e-12);
    }

    #[test]
    fn a_curved_cut_opens() {
        let mut panel = panel(&KEYHOLE);
        panel.edges[1].curve = Curve::Quadratic { control: dvec2(0.45, 0.15) };
        panel.edges[6].curve = Curve::Quadratic { control: dvec2(0.45, 0.15) };
        assert!(crosses(&panel));
        open(&mut panel.edges);
        assert!(!crosses(&panel));
        // The control points go along with the ends: both sides are the curve that was drawn, moved aside.
        let mut panel = self::panel(&KEYHOLE);
        let [a, b] = [dvec2(0.45, 0.1), dvec2(0.55, 0.2)];
        panel.edges[1].curve = Curve::Cubic { controls: [a, b] };
        panel.edges[6].curve = Curve::Cubic { controls: [b, a] };
        open(&mut panel.edges);
        let moved = dvec2(HALF_WIDTH, 0.0);
        for (edge, expected) in [(1, [a - moved, b - moved]), (6, [b + moved, a + moved])] {
            let Curve::Cubic { controls } = panel.edges[edge].curve else { panic!("a cubic") };
            assert!(controls.iter().zip(expected).all(|(a, b)| a.distance(b) < 1e-12), "{controls:?}");
        }
    }

    #[test]
    fn what_is_no_cut_stays() {
        let mut square = panel(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        let before = square.clone();
        open(&mut square.edges);
        assert_eq!(square, before);
        // A spike that leaves the cloth has nothing to open into.
        let mut spike = panel(&[[0.0, 0.0], [0.5, 0.0], [0.5, -0.4], [0.5, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        open(&mut spike.edges);
        assert!(crosses(&spike));
    }
}
