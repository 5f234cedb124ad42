//! Which spring is stretched the most.

use glam::Vec3;
use toile_model::Limit;

/// Index of the first of the limits whose spring has the largest elongation; `None` when no spring is longer than its rest length.
/// `positions` [m] has the shape [particle_count].
pub fn longest_limit(positions: &[Vec3], limits: &[Limit]) -> Option<u32> {
    let mut longest = None;
    let mut largest = 0.0;
    for (limit, index) in limits.iter().zip(0..) {
        let [a, b] = limit.ends.map(|end| positions[end as usize]);
        let elongation = (b - a).length() / limit.rest_length - 1.0;
        if elongation > largest {
            largest = elongation;
            longest = Some(index);
        }
    }
    longest
}
