//! Which cells of a grid a triangle covers, exactly: neighbouring triangles leave no gap and share no cell.

use std::ops::{Add, AddAssign, BitOr, Mul, Range, Sub};

/// Binary digits of the fixed-point coordinates within a cell.
const SUBPIXEL_BITS: u32 = 8;
/// Steps of the fixed-point coordinates per cell.
pub const SUBPIXELS: i32 = 1 << SUBPIXEL_BITS;

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
    -edge::<i64>(a, b, c.x, c.y)
}

/// Edge function: which side of the line from a to b a point lies on.
#[inline]
fn edge<N: Whole>(a: Corner, b: Corner, x: i32, y: i32) -> N {
    N::from(b.x - a.x) * N::from(y - a.y) - N::from(b.y - a.y) * N::from(x - a.x)
}

/// Triangles that are smaller than this in both directions are scanned in 32 bits, which hold all products [steps of a cell].
const SMALL: i32 = 1 << 14;

/// Whole numbers in which edge functions are exact.
trait Whole:
    Copy + From<i32> + Ord + Add<Output = Self> + AddAssign + Sub<Output = Self> + Mul<Output = Self> + BitOr<Output = Self>
{
    fn rounded(self) -> f32;
}

impl Whole for i32 {
    fn rounded(self) -> f32 {
        self as f32
    }
}

impl Whole for i64 {
    fn rounded(self) -> f32 {
        self as f32
    }
}

/// Calls `plot` with column, row and height of every cell whose centre the triangle covers, among the first `width`
/// columns and the given rows.
#[inline]
pub fn scan(corners: [Corner; 3], width: usize, rows: Range<usize>, plot: impl FnMut(usize, usize, f32)) {
    let [a, b, c] = corners;
    let low = [a.x.min(b.x).min(c.x), a.y.min(b.y).min(c.y)];
    let high = [a.x.max(b.x).max(c.x), a.y.max(b.y).max(c.y)];
    let rows = cells(low[1], high[1], rows);
    let columns = cells(low[0], high[0], 0..width);
    if columns.is_empty() || rows.is_empty() {
        return;
    }
    if (high[0] - low[0]).max(high[1] - low[1]) < SMALL {
        cover::<i32>(corners, columns, rows, plot);
    } else {
        cover::<i64>(corners, columns, rows, plot);
    }
}

/// The cells of a rectangle that a triangle covers.
#[inline]
fn cover<N: Whole>(
    [a, b, c]: [Corner; 3],
    columns: Range<usize>,
    rows: Range<usize>,
    mut plot: impl FnMut(usize, usize, f32),
) {
    let zero = N::from(0);
    let area: N = edge(a, c, b.x, b.y);
    if area == zero {
        return;
    }
    let [b, c] = if area > zero { [c, b] } else { [b, c] };

    let first = [columns.start, rows.start].map(|i| i as i32 * SUBPIXELS + SUBPIXELS / 2);
    let sides: [Side<N>; 3] = [Side::new(b, c, first), Side::new(c, a, first), Side::new(a, b, first)];
    let scale = 1.0 / area.rounded().abs();
    let rise = [b.height - a.height, c.height - a.height];

    let mut starts = [sides[0].value, sides[1].value, sides[2].value];
    for row in rows {
        let mut values = starts;
        for column in columns.clone() {
            if values[0] | values[1] | values[2] >= zero {
                let height = a.height + scale * (values[1].rounded() * rise[0] + values[2].rounded() * rise[1]);
                plot(column, row, height);
            }
            for k in 0..3 {
                values[k] += sides[k].right;
            }
        }
        for k in 0..3 {
            starts[k] += sides[k].down;
        }
    }
}

/// A side of a triangle as its edge function.
struct Side<N> {
    /// At the first centre.
    value: N,
    /// What a cell to the right adds.
    right: N,
    /// What a cell further down adds.
    down: N,
}

impl<N: Whole> Side<N> {
    #[inline]
    fn new(from: Corner, to: Corner, first: [i32; 2]) -> Self {
        // A centre on a shared edge belongs to the triangle of which this is a left or upper edge.
        let owned = to.y < from.y || (to.y == from.y && to.x > from.x);
        Self {
            value: edge::<N>(from, to, first[0], first[1]) - N::from(i32::from(!owned)),
            right: N::from(from.y - to.y) * N::from(SUBPIXELS),
            down: N::from(to.x - from.x) * N::from(SUBPIXELS),
        }
    }
}

/// Cells within a range whose centres lie from the lowest to the highest coordinate.
#[inline]
fn cells(low: i32, high: i32, within: Range<usize>) -> Range<usize> {
    // The first centre at or after a coordinate, and the first one after it.
    let at = ((low + (SUBPIXELS / 2 - 1)) >> SUBPIXEL_BITS).max(0) as usize;
    let after = ((high + SUBPIXELS / 2) >> SUBPIXEL_BITS).max(0) as usize;
    at.max(within.start)..after.min(within.end)
}
