//! The predictive rule: no spring is over-long after the coming move.

use crate::Particles;
use glam::Vec3;
use toile_model::Limit;

/// Removes from the velocities of both ends, by inverse mass, what would make a limit over-long after a move of `dt` [s]. `impulses` are
/// what the limits have pulled with in this step so far [N·s]; a limit that is shorter than it may be takes back of its own what is too
/// much, and no more, so that it never pushes. The limits are those of one colour: no two share a particle.
pub fn limit_predictive(particles: &mut Particles, limits: &[Limit], impulses: &mut [f32], dt: f32) {
    for (limit, impulse) in limits.iter().zip(impulses) {
        let weight: f32 = limit.ends.iter().map(|end| particles.inverse_masses[*end as usize]).sum();
        if !(weight > 0.0) {
            continue;
        }
        let span = after_move(particles, limit, dt);
        let length = span.length();
        let pull = ((length - limit.max_length) / (dt * weight)).max(-*impulse);
        if length > 0.0 && pull != 0.0 {
            *impulse += pull;
            pull_together(particles, limit, span * (pull / length));
        }
    }
}

/// From the first to the second end of a limit after a move of `dt`.
pub(super) fn after_move(particles: &Particles, limit: &Limit, dt: f32) -> Vec3 {
    let [a, b] = limit.ends.map(|end| end as usize);
    (particles.positions[b] - particles.positions[a]) + (particles.velocities[b] - particles.velocities[a]) * dt
}

/// Gives the ends of a limit an impulse towards each other [N·s].
pub(super) fn pull_together(particles: &mut Particles, limit: &Limit, impulse: Vec3) {
    let [a, b] = limit.ends.map(|end| end as usize);
    particles.velocities[a] += impulse * particles.inverse_masses[a];
    particles.velocities[b] -= impulse * particles.inverse_masses[b];
}
