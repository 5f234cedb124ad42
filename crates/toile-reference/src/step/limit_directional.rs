//! The directional rule: the rear end of an over-long spring follows the front end. W §3.2, eq. 6.

use super::limit_average::average;
use crate::{Contact, Particles};
use glam::Vec3;
use toile_model::{Limit, StepSettings};

/// Below this |cos| between spring and directional vector both ends take their mean. W §3.2.
const PERPENDICULAR: f32 = 0.3;

/// Gives the rear end of each over-long limit, seen along v_dir = g·dt + v_object, the axial velocity of the front end; ends
/// of limits nearly perpendicular to v_dir take their mean. W §3.2, eq. 6.
///
/// The limits are those of one colour: no two share a particle. `contacts` has the shape [particle_count], or is `None` in a
/// scene without body, where v_object is 0.
pub fn limit_directional(
    particles: &mut Particles,
    limits: &[Limit],
    contacts: Option<&[Contact]>,
    settings: &StepSettings,
) {
    for limit in limits {
        let ends @ [a, b] = limit.ends.map(|end| end as usize);
        let [weight_a, weight_b] = [particles.inverse_masses[a], particles.inverse_masses[b]];
        if !(weight_a + weight_b > 0.0) {
            continue;
        }
        let span = particles.positions[b] - particles.positions[a];
        let length = span.length();
        if length > limit.max_length {
            let axis = span / length;
            let direction = settings.gravity * settings.dt + object_velocity(contacts, ends);
            let speed = direction.length();
            if !(speed > 0.0) {
                average(particles, ends, axis);
                continue;
            }
            let cosine = span.dot(direction) / (length * speed);
            let [velocity_a, velocity_b] = [particles.velocities[a], particles.velocities[b]];
            let [speed_a, speed_b] = [velocity_a.dot(axis), velocity_b.dot(axis)];
            if cosine.abs() < PERPENDICULAR {
                average(particles, ends, axis);
            } else if cosine > 0.0 {
                if weight_a > 0.0 {
                    particles.velocities[a] = velocity_a + axis * (speed_b - speed_a);
                }
            } else if weight_b > 0.0 {
                particles.velocities[b] = velocity_b + axis * (speed_a - speed_b);
            }
        }
    }
}

/// Mean velocity [m/s] of what the two ends touch; 0 when they touch nothing.
fn object_velocity(contacts: Option<&[Contact]>, ends: [usize; 2]) -> Vec3 {
    let Some(contacts) = contacts else {
        return Vec3::ZERO;
    };
    let [a, b] = ends.map(|end| &contacts[end]);
    match (a.touching, b.touching) {
        (true, true) => (a.velocity + b.velocity) * 0.5,
        (true, false) => a.velocity,
        (false, true) => b.velocity,
        (false, false) => Vec3::ZERO,
    }
}
