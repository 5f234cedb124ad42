//! Particles that the host holds, moves and lets go.

use crate::Particles;
use toile_model::PinTarget;

/// Pins the particles that are held and gives each the velocity [m/s] that brings it where it is wanted; frees the others, which keep their
/// velocity. No particle is named twice.
pub fn set_pins(particles: &mut Particles, pins: &[PinTarget]) {
    for pin in pins {
        let i = pin.particle as usize;
        if !pin.is_held {
            particles.inverse_masses[i] = 1.0 / particles.masses[i];
            continue;
        }
        particles.inverse_masses[i] = 0.0;
        particles.velocities[i] = (pin.position - particles.positions[i]) * pin.rate;
    }
}
