//! How far the cloth is stretched.

use glam::Vec3;
use toile_model::Limit;

/// What [`limit_status`] reports.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LimitStatus {
    /// Largest elongation [1]; 0 when no spring is longer than its rest length.
    pub elongation_max: f32,
    /// Number of springs whose elongation is above the threshold along them.
    pub over_long_count: u32,
}

/// Elongation length/rest − 1 of every structural and shear spring, which are those that have a limit.
/// `aim` [1] is the part of the threshold that the limits hold; `positions` [m] has the shape [particle_count].
pub fn limit_status(positions: &[Vec3], limits: &[Limit], aim: f32) -> LimitStatus {
    let mut status = LimitStatus::default();
    for limit in limits {
        let [a, b] = limit.ends.map(|end| positions[end as usize]);
        let length = (b - a).length();
        let elongation = length / limit.rest_length - 1.0;
        if elongation > status.elongation_max {
            status.elongation_max = elongation;
        }
        if elongation * aim > limit.max_length / limit.rest_length - 1.0 {
            status.over_long_count += 1;
        }
    }
    status
}
