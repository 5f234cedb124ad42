//! Each particle takes the mean of its own response and those of its quads, then answers once more for itself. D §6.

use crate::contact::response;
use crate::{Contact, Particles, Probe, Response};
use glam::Vec3;
use toile_model::{Csr, StepSettings};

/// Changes velocity and position of each particle by the mean of all responses that are touching, its own and those of its
/// quads. The mean may still lead a particle into the body, so its own response has the last word. Gives the contacts that the next step reads, shape [particle_count]. D §6; W §5, eq. 15.
///
/// `particle_quads` has one row per particle, `probes` the shape [particle_count], `responses` the shape [quad_count].
pub fn collide(
    particles: &mut Particles,
    particle_quads: &Csr<u32>,
    probes: &[Probe],
    responses: &[Response],
    settings: &StepSettings,
) -> Vec<Contact> {
    (0..particles.positions.len())
        .map(|i| {
            let probe = &probes[i];
            let own = response(particles.velocities[i], probe, settings);
            let quads = particle_quads.row(i).iter().map(|&quad| responses[quad as usize]);
            let mut change = Vec3::ZERO;
            let mut push = Vec3::ZERO;
            let mut count = 0.0;
            for response in std::iter::once(own).chain(quads).filter(|response| response.touching) {
                change += response.change;
                push += response.push;
                count += 1.0;
            }
            if count > 0.0 && particles.inverse_masses[i] > 0.0 {
                let mut averaged = particles.velocities[i] + change / count;
                if own.touching {
                    averaged += response(averaged, probe, settings).change;
                }
                particles.velocities[i] = averaged;
                particles.positions[i] += push / count;
            }
            if own.touching {
                Contact { normal: probe.normal, velocity: probe.velocity, touching: true }
            } else {
                Contact::default()
            }
        })
        .collect()
}
