//! Two particles that a limit or a seam pulls together.

use crate::Particles;
use glam::Vec3;

/// Sum of both inverse masses [1/kg].
pub(super) fn inverse_mass_sum(particles: &Particles, ends: [u32; 2]) -> f32 {
    ends.iter().map(|end| particles.inverse_masses[*end as usize]).sum()
}

/// From the first to the second after a move of `dt` [s].
pub(super) fn after_move(particles: &Particles, ends: [u32; 2], dt: f32) -> Vec3 {
    let [a, b] = ends.map(|end| end as usize);
    (particles.positions[b] - particles.positions[a]) + (particles.velocities[b] - particles.velocities[a]) * dt
}

/// Gives both an impulse towards each other [N·s].
pub(super) fn pull_together(particles: &mut Particles, ends: [u32; 2], impulse: Vec3) {
    let [a, b] = ends.map(|end| end as usize);
    particles.velocities[a] += impulse * particles.inverse_masses[a];
    particles.velocities[b] -= impulse * particles.inverse_masses[b];
}
