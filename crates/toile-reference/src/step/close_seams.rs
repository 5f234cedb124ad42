//! An open seam is a limit that shrinks.

use crate::Particles;
use toile_model::SeamPair;

/// Removes from the velocities of each pair what would leave its gap, after a move of `dt` [s], wider than the closing speed
/// allows. The pairs are those of one colour: no two share a particle.
pub fn close_seams(particles: &mut Particles, pairs: &[SeamPair], dt: f32) {
    for pair in pairs {
        let [a, b] = pair.ends.map(|end| end as usize);
        let [weight_a, weight_b] = [particles.inverse_masses[a], particles.inverse_masses[b]];
        let weight = weight_a + weight_b;
        if !(weight > 0.0) {
            continue;
        }
        let gap = particles.positions[b] - particles.positions[a];
        let target = (gap.length() - pair.closing_speed * dt).max(0.0);
        let span = gap + (particles.velocities[b] - particles.velocities[a]) * dt;
        let length = span.length();
        if length > target {
            let change = span * ((length - target) / ((length * dt) * weight));
            particles.velocities[a] += change * weight_a;
            particles.velocities[b] -= change * weight_b;
        }
    }
}
