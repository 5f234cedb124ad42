//! The rule of the first paper: ends of an over-long spring lose their axial velocity. D §4.3.

use crate::Particles;
use toile_model::Limit;

/// Takes from both ends of each over-long limit their velocity along it. It brakes free fall. D §4.3.
/// The limits are those of one colour: no two share a particle.
pub fn limit_zero(particles: &mut Particles, limits: &[Limit]) {
    for limit in limits {
        let [a, b] = limit.ends.map(|end| end as usize);
        let [weight_a, weight_b] = [particles.inverse_masses[a], particles.inverse_masses[b]];
        if !(weight_a + weight_b > 0.0) {
            continue;
        }
        let span = particles.positions[b] - particles.positions[a];
        let length = span.length();
        if length > limit.max_length {
            let axis = span / length;
            let [velocity_a, velocity_b] = [particles.velocities[a], particles.velocities[b]];
            if weight_a > 0.0 {
                particles.velocities[a] = velocity_a - axis * velocity_a.dot(axis);
            }
            if weight_b > 0.0 {
                particles.velocities[b] = velocity_b - axis * velocity_b.dot(axis);
            }
        }
    }
}
