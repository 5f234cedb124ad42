//! Which cells of a grid a triangle covers, exactly: neighbouring triangles leave no gap and share no cell.

use std::ops::Range;

/// Steps of the fixed-point coordinates per cell.
pub const SUBPIXELS: i32 = 256;

/// A corner of a triangle on the grid.
#[derive(Clone, Copy)]
pub struct Corner {
    /// To the right, in steps of a cell.
    pub x: i32,
    /// Down, in steps of a cell.
    pub y: i32,
    /// Towards the eye.
    pub height: f32,
}

/// Twice the signed area in square steps, positive where the corners are counter-clockwise as seen.
pub fn signed_area([a, b, c]: [Corner; 3]) -> i64 {
    -edge(a, b, c.x, c.y)
}

/// Edge function: which side of the line from a to b a point lies on.
fn edge(a: Corner, b: Corner, x: i32, y: i32) -> i64 {
    i64::from(b.x - a.x) * i64::from(y - a.y) - i64::from(b.y - a.y) * i64::from(x - a.x)
}

/// Calls `plot` with column, row and height of every cell whose centre the triangle covers, among the first `width`
/// columns and the given rows.
pub fn scan(corners: [Corner; 3], width: usize, rows: Range<usize>, mut plot: impl FnMut(usize, usize, f32)) {
    let [columns, rows] = [(corners.map(|c| c.x), 0..width), (corners.map(|c| c.y), rows)]
        .map(|(coordinates, within)| cells(coordinates, within));
    let area = signed_area(corners);
    if columns.is_empty() || rows.is_empty() || area == 0 {
        return;
    }
    let [a, b, c] = corners;
    let [a, b, c] = if area > 0 { [a, c, b] } else { [a, b, c] };

    let first = [columns.start, rows.start].map(|i| i as i32 * SUBPIXELS + SUBPIXELS / 2);
    let sides = [(b, c), (c, a), (a, b)].map(|(from, to)| {
        // A centre on a shared edge belongs to the triangle of which this is a left or upper edge.
        let owned = to.y < from.y || (to.y == from.y && to.x > from.x);
        let value = edge(from, to, first[0], first[1]) - i64::from(!owned);
        let step = i64::from(SUBPIXELS);
        (value, -i64::from(to.y - from.y) * step, i64::from(to.x - from.x) * step)
    });
    let scale = 1.0 / area.unsigned_abs() as f32;
    let rise = [b.height - a.height, c.height - a.height];

    let mut row_values = sides.map(|s| s.0);
    for row in rows {
        let mut values = row_values;
        for column in columns.clone() {
            if values[0] | values[1] | values[2] >= 0 {
                let height = a.height + scale * (values[1] as f32 * rise[0] + values[2] as f32 * rise[1]);
                plot(column, row, height);
            }
            for (value, side) in values.iter_mut().zip(&sides) {
                *value += side.1;
            }
        }
        for (value, side) in row_values.iter_mut().zip(&sides) {
            *value += side.2;
        }
    }
}

/// Cells within a range whose centres may lie between three coordinates.
fn cells([a, b, c]: [i32; 3], within: Range<usize>) -> Range<usize> {
    // The first centre at or after a coordinate, and the first one after it.
    let at = |v: i32| (v + SUBPIXELS / 2 - 1).div_euclid(SUBPIXELS).max(0) as usize;
    let after = |v: i32| (v + SUBPIXELS / 2).div_euclid(SUBPIXELS).max(0) as usize;
    at(a.min(b).min(c)).max(within.start)..after(a.max(b).max(c)).min(within.end)
}
