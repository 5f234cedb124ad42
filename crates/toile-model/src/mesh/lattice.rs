//! The regular part of a panel: a lattice along warp and weft, away from the outline.

use crate::mesh::geometry::segment_distance;
use glam::DVec2;

/// Smallest distance of a lattice particle from the outline, in lattice steps. Above a half, so that no side of a cell
/// whose corners are kept can cross the outline.
const CLEARANCE: f64 = 0.58;

/// Lattice particles inside an outline.
pub(crate) struct Lattice {
    low: DVec2,
    pitch: DVec2,
    columns: usize,
    rows: usize,
    /// Number of each kept particle, row by row; `None` where there is none.
    numbers: Vec<Option<u32>>,
    /// Kept particles.
    pub(crate) points: Vec<DVec2>,
}

impl Lattice {
    /// The lattice inside a closed outline. Its steps are those nearest to `spacing` [m] that divide the box around the outline
    /// evenly: so it matches the sides of most panels, and mirrored panels get mirrored lattices.
    pub(crate) fn new(outline: &[DVec2], spacing: f64) -> Self {
        let low = outline.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = outline.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        let cells = ((high - low) / spacing).round().max(DVec2::ONE);
        let mut lattice = Self {
            low,
            pitch: (high - low) / cells,
            columns: cells.x as usize + 1,
            rows: cells.y as usize + 1,
            numbers: Vec::new(),
            points: Vec::new(),
        };
        let mut inside = lattice.inside(outline);
        lattice.clear_rim(outline, &mut inside);
        lattice.numbers = inside
            .iter()
            .enumerate()
            .map(|(k, &kept)| {
                kept.then(|| {
                    lattice.points.push(lattice.position(k % lattice.columns, k / lattice.columns));
                    lattice.points.len() as u32 - 1
                })
            })
            .collect();
        lattice
    }

    fn position(&self, column: usize, row: usize) -> DVec2 {
        self.low + self.pitch * DVec2::new(column as f64, row as f64)
    }

    /// Row of the lattice next to a point, counted from the lowest.
    pub(crate) fn row(&self, point: DVec2) -> f64 {
        ((point.y - self.low.y) / self.pitch.y).round()
    }

    /// Which lattice points are inside, row by row, by the crossings of the outline with each row.
    fn inside(&self, outline: &[DVec2]) -> Vec<bool> {
        let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); self.rows];
        for (k, &a) in outline.iter().enumerate() {
            let b = outline[(k + 1) % outline.len()];
            let (lower, upper) = if a.y < b.y { (a, b) } else { (b, a) };
            for row in self.rows_between(lower.y, upper.y) {
                let y = self.position(0, row).y;
                if y >= lower.y && y < upper.y {
                    crossings[row].push(lower.x + (upper.x - lower.x) * (y - lower.y) / (upper.y - lower.y));
                }
            }
        }
        let mut inside = Vec::with_capacity(self.columns * self.rows);
        for row in &mut crossings {
            row.sort_by(f64::total_cmp);
            inside.extend((0..self.columns).map(|column| {
                let x = self.position(column, 0).x;
                row.partition_point(|&c| c <= x) % 2 == 1
            }));
        }
        inside
    }

    /// Rows whose height may lie in an interval.
    fn rows_between(&self, low: f64, high: f64) -> std::ops::Range<usize> {
        steps_between(low - self.low.y, high - self.low.y, self.pitch.y, self.rows)
    }

    /// Drops the lattice points too near to the outline.
    fn clear_rim(&self, outline: &[DVec2], inside: &mut [bool]) {
        let clearance = CLEARANCE * self.pitch.max_element();
        for (k, &a) in outline.iter().enumerate() {
            let b = outline[(k + 1) % outline.len()];
            let (low, high) = (a.min(b) - clearance, a.max(b) + clearance);
            let columns = steps_between(low.x - self.low.x, high.x - self.low.x, self.pitch.x, self.columns);
            for row in self.rows_between(low.y, high.y) {
                for column in columns.clone() {
                    if segment_distance(self.position(column, row), [a, b]) < clearance {
                        inside[row * self.columns + column] = false;
                    }
                }
            }
        }
    }

    /// Corners of a cell, counter-clockwise, when all four are kept.
    fn cell(&self, column: usize, row: usize) -> Option<[u32; 4]> {
        let number = |c: usize, r: usize| self.numbers[r * self.columns + c];
        Some([number(column, row)?, number(column + 1, row)?, number(column + 1, row + 1)?, number(column, row + 1)?])
    }

    /// The cells whose four corners are kept.
    pub(crate) fn cells(&self) -> Vec<[u32; 4]> {
        (0..self.rows - 1)
            .flat_map(|row| (0..self.columns - 1).filter_map(move |column| self.cell(column, row)))
            .collect()
    }
}

/// Whole steps k with low ≤ k·pitch ≤ high, widened by one on both sides, below `count`.
fn steps_between(low: f64, high: f64, pitch: f64, count: usize) -> std::ops::Range<usize> {
    let first = (low / pitch).floor().max(0.0) as usize;
    let end = (high / pitch).ceil().max(-1.0) + 1.0;
    first..(end as usize).min(count)
}
