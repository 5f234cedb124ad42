//! Whether the particles are still finite, how fast they are, and their energy in parts.

use super::reduction::{GROUP, tree_sum};
use crate::Particles;
use glam::Vec3;

/// No cloth moves faster than this [m/s]: a particle that does counts as not finite, before it is.
const RUNAWAY_SPEED: f32 = 1000.0;

/// What [`particle_status`] reports.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParticleStatus {
    /// Particles whose position or velocity is not finite, or that are faster than 1 km/s.
    pub non_finite_count: u32,
    /// The first of them, by index.
    pub first_non_finite: Option<u32>,
    /// Largest speed [m/s] of all particles that are finite.
    pub speed_max: f32,
    /// Kinetic energy [J] of the moving, finite particles of each group of 64, shape [particle_count / 64, rounded up].
    pub energy_partials: Vec<f32>,
}

/// Whether a particle is finite and slower than anything that ran away.
fn is_sound(position: Vec3, velocity: Vec3) -> bool {
    position.is_finite() && velocity.is_finite() && velocity.dot(velocity) < RUNAWAY_SPEED * RUNAWAY_SPEED
}

/// Counts what is not finite or ran away, and finds the largest speed and the kinetic energy in parts.
pub fn particle_status(particles: &Particles) -> ParticleStatus {
    let mut status = ParticleStatus::default();
    for (i, (position, velocity)) in particles.positions.iter().zip(&particles.velocities).enumerate() {
        if !is_sound(*position, *velocity) {
            status.non_finite_count += 1;
            status.first_non_finite.get_or_insert(i as u32);
            continue;
        }
        let speed = velocity.length();
        if speed > status.speed_max {
            status.speed_max = speed;
        }
    }
    let indices: Vec<usize> = (0..particles.positions.len()).collect();
    status.energy_partials = indices.chunks(GROUP).map(|group| group_energy(particles, group)).collect();
    status
}

fn group_energy(particles: &Particles, group: &[usize]) -> f32 {
    let mut energies = [0.0; GROUP];
    for (energy, &i) in energies.iter_mut().zip(group) {
        let velocity = particles.velocities[i];
        if particles.inverse_masses[i] > 0.0 && is_sound(particles.positions[i], velocity) {
            *energy = 0.5 * (particles.masses[i] * velocity.dot(velocity));
        }
    }
    tree_sum(energies)
}
