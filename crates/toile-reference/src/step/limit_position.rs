//! Provot's rule, for comparison: over-long springs are shortened after the move. W §3.1.

use crate::Particles;
use toile_model::Limit;

/// Moves both ends of each over-long limit together, by inverse mass, until it has its maximum length. Velocities stay.
/// W §3.1. The limits are those of one colour: no two share a particle.
pub fn limit_position(particles: &mut Particles, limits: &[Limit]) {
    for limit in limits {
        let [a, b] = limit.ends.map(|end| end as usize);
        let [weight_a, weight_b] = [particles.inverse_masses[a], particles.inverse_masses[b]];
        let weight = weight_a + weight_b;
        if !(weight > 0.0) {
            continue;
        }
        let span = particles.positions[b] - particles.positions[a];
        let length = span.length();
        if length > limit.max_length {
            let change = span * ((length - limit.max_length) / (length * weight));
            particles.positions[a] += change * weight_a;
            particles.positions[b] -= change * weight_b;
        }
    }
}
