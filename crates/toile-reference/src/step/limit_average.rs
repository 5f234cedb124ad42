//! The averaging rule: ends of an over-long spring move as one along it. W §3.2, eq. 5.

use crate::Particles;
use glam::Vec3;
use toile_model::Limit;

/// Gives both ends of each over-long limit their mean velocity along it, weighted by mass so that momentum is kept.
/// W §3.2, eq. 5. The limits are those of one colour: no two share a particle.
pub fn limit_average(particles: &mut Particles, limits: &[Limit]) {
    for limit in limits {
        let [a, b] = limit.ends.map(|end| end as usize);
        if !(particles.inverse_masses[a] + particles.inverse_masses[b] > 0.0) {
            continue;
        }
        let span = particles.positions[b] - particles.positions[a];
        let length = span.length();
        if length > limit.max_length {
            average(particles, [a, b], span / length);
        }
    }
}

/// Gives both ends their mean velocity along the unit vector `axis`; a pinned end keeps its own.
pub(super) fn average(particles: &mut Particles, [a, b]: [usize; 2], axis: Vec3) {
    let [weight_a, weight_b] = [particles.inverse_masses[a], particles.inverse_masses[b]];
    let [velocity_a, velocity_b] = [particles.velocities[a], particles.velocities[b]];
    let [speed_a, speed_b] = [velocity_a.dot(axis), velocity_b.dot(axis)];
    let mean = (speed_a * weight_b + speed_b * weight_a) / (weight_a + weight_b);
    if weight_a > 0.0 {
        particles.velocities[a] = velocity_a + axis * (mean - speed_a);
    }
    if weight_b > 0.0 {
        particles.velocities[b] = velocity_b + axis * (mean - speed_b);
    }
}
