//! What a surface answers to the force that presses on it. W §5, eq. 16.

use crate::{Contact, Particles};
use glam::Vec3;
use toile_model::StepSettings;
use toile_scene::Friction;

/// Takes the part of each force [N] that the contact of the last step carries: all that presses on the surface, and by
/// friction of what drags along it. `contacts` has the shape [particle_count]. W §5, eq. 16.
///
/// Coulomb friction removes at most what would stop the slip that the particle would have after this step.
pub fn reaction(forces: &mut [Vec3], particles: &Particles, contacts: &[Contact], settings: &StepSettings) {
    let dt = settings.dt;
    for (i, force) in forces.iter_mut().enumerate() {
        let contact = &contacts[i];
        let inverse_mass = particles.inverse_masses[i];
        if !(contact.touching && inverse_mass > 0.0) {
            continue;
        }
        let normal = contact.normal;
        let pressure = force.dot(normal);
        if pressure < 0.0 {
            let drag = *force - normal * pressure;
            *force = match settings.law {
                Friction::Papers { force_removed, .. } => drag * (1.0 - force_removed as f32),
                Friction::Coulomb => {
                    let relative = particles.velocities[i] - contact.velocity;
                    let slip = (relative - normal * relative.dot(normal)) + drag * (dt * inverse_mass);
                    let speed = slip.length();
                    if speed > 0.0 {
                        let removed = (((settings.friction * -pressure) * dt) * inverse_mass).min(speed);
                        drag - slip * (removed / (speed * (dt * inverse_mass)))
                    } else {
                        drag
                    }
                }
            };
        }
    }
}
