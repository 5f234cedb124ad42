//! Lengths, areas and angles in the flat panel.

use glam::DVec2;

/// Fourth corner of a quad that is a triangle.
pub const NO_CORNER: u32 = u32::MAX;

/// Signed area [m²] of a closed loop: positive when it is counter-clockwise.
pub(crate) fn signed_area(points: impl Iterator<Item = DVec2> + Clone) -> f64 {
    let Some(origin) = points.clone().next() else { return 0.0 };
    let next = points.clone().skip(1).chain(std::iter::once(origin));
    // Relative to the first point, so that a panel far from the origin loses no digits.
    0.5 * points.zip(next).map(|(a, b)| (a - origin).perp_dot(b - origin)).sum::<f64>()
}

/// Corners of an element: four for a quad, three for a triangle.
pub(crate) fn corners(element: &[u32; 4]) -> &[u32] {
    if element[3] == NO_CORNER { &element[..3] } else { element }
}

/// Signed area [m²] of an element.
pub(crate) fn element_area(element: &[u32; 4], points: &[DVec2]) -> f64 {
    signed_area(corners(element).iter().map(|&i| points[i as usize]))
}

/// Angle [degrees] from `to_next` counter-clockwise to `to_previous`, 0 to 360: the inner angle of a counter-clockwise corner.
pub(crate) fn inner_angle(to_previous: DVec2, to_next: DVec2) -> f64 {
    let angle = to_next.perp_dot(to_previous).atan2(to_next.dot(to_previous)).to_degrees();
    if angle < 0.0 { angle + 360.0 } else { angle }
}

/// Smallest and largest inner angle [degrees] of a counter-clockwise element.
pub(crate) fn angle_range(element: &[u32; 4], points: &[DVec2]) -> [f64; 2] {
    let loop_ = corners(element);
    let count = loop_.len();
    (0..count)
        .map(|k| {
            let [previous, corner, next] = [k + count - 1, k, k + 1].map(|j| points[loop_[j % count] as usize]);
            inner_angle(previous - corner, next - corner)
        })
        .fold([360.0, 0.0], |[low, high], angle| [f64::min(low, angle), f64::max(high, angle)])
}

/// Distance [m] of a point from a segment.
pub(crate) fn segment_distance(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = b - a;
    let length_squared = along.length_squared();
    let t = if length_squared > 0.0 { ((point - a).dot(along) / length_squared).clamp(0.0, 1.0) } else { 0.0 };
    point.distance(a + along * t)
}
