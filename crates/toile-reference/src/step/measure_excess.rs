//! How far the coming move would stretch the cloth beyond the target of a polish.

use crate::Particles;
use toile_model::Limit;

/// Largest elongation [1] of those that are above `target` [1] after a move of `dt` [s]; 0 when none is. The limits are those of
/// the structural and shear springs.
pub fn measure_excess(particles: &Particles, limits: &[Limit], target: f32, dt: f32) -> f32 {
    let mut largest = 0.0;
    for limit in limits {
        let [a, b] = limit.ends.map(|end| end as usize);
        let span = (particles.positions[b] - particles.positions[a])
            + (particles.velocities[b] - particles.velocities[a]) * dt;
        let elongation = span.length() / limit.rest_length - 1.0;
        if elongation > target && elongation > largest {
            largest = elongation;
        }
    }
    largest
}
