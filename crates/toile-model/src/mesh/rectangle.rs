//! Which panels are rectangles, and their sides.

use toile_scene::{Curve, Panel};

/// Largest deviation of a corner from 90° and of a side from a straight line [degrees]: what rounding a pattern to
/// tenths of a millimetre leaves.
const ANGLE_TOLERANCE: f64 = 0.5;

/// The sides of a rectangular panel.
#[derive(Clone, Debug)]
pub(crate) struct Rectangle {
    edge_count: usize,
    /// First edge of each side, in loop order.
    firsts: [usize; 4],
}

impl Rectangle {
    /// Edges of one side, in loop order.
    pub(crate) fn edges(&self, side: usize) -> Vec<usize> {
        let (first, next) = (self.firsts[side], self.firsts[(side + 1) % 4]);
        let count = (next + self.edge_count - first) % self.edge_count;
        (0..count).map(|k| (first + k) % self.edge_count).collect()
    }
}

/// The sides of a panel whose outline is a rectangle of straight edges, in any position.
pub(crate) fn rectangle_of(panel: &Panel) -> Option<Rectangle> {
    let count = panel.edges.len();
    if panel.edges.iter().any(|e| e.curve != Curve::Straight) {
        return None;
    }
    let along = |e: usize| panel.edges[(e + 1) % count].start - panel.edges[e % count].start;
    let mut firsts = Vec::new();
    for edge in 0..count {
        let turn = along(edge + count - 1).angle_to(along(edge)).to_degrees().abs();
        let [corner, straight] = [90.0, 0.0].map(|angle| (turn - angle).abs() < ANGLE_TOLERANCE);
        if corner {
            firsts.push(edge);
        } else if !straight {
            return None;
        }
    }
    let firsts = firsts.try_into().ok()?;
    Some(Rectangle { edge_count: count, firsts })
}
