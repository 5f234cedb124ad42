//! The predictive rule: no spring is over-long after the coming move.

use crate::Particles;
use toile_model::Limit;

/// Removes from the velocities of both ends, by inverse mass, what would make a limit over-long after a move of `dt` [s].
/// The limits are those of one colour: no two share a particle.
pub fn limit_predictive(particles: &mut Particles, limits: &[Limit], dt: f32) {
    for limit in limits {
        let [a, b] = limit.ends.map(|end| end as usize);
        let [weight_a, weight_b] = [particles.inverse_masses[a], particles.inverse_masses[b]];
        let weight = weight_a + weight_b;
        if !(weight > 0.0) {
            continue;
        }
        let span = (particles.positions[b] - particles.positions[a])
            + (particles.velocities[b] - particles.velocities[a]) * dt;
        let length = span.length();
        if length > limit.max_length {
            let change = span * ((length - limit.max_length) / ((length * dt) * weight));
            particles.velocities[a] += change * weight_a;
            particles.velocities[b] -= change * weight_b;
        }
    }
}
