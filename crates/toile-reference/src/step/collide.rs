//! Each particle answers the contacts of its quads and its own. D §6; W §5, eq. 15.

use crate::contact::{change, missing_speed, touches};
use crate::{Contact, Midpoints, Particles, Probe};
use glam::Vec3;
use toile_model::{Csr, StepSettings};

/// Corners of a quad: the share of a midpoint's motion that one corner can have alone.
const CORNER_COUNT: f32 = 4.0;

/// What the points see: `particles` the shape [particle_count], `quads` the shape [quad_count].
#[derive(Debug)]
pub struct Probes<'a> {
    /// Probe of each particle, which goes on with it on its way out of a body.
    pub particles: &'a mut [Probe],
    /// Probe of each quad midpoint.
    pub quads: &'a [Probe],
}

/// Changes the velocity of each particle by the mean of what its own contact and the colliding midpoints of its quads ask
/// of it; its own contact then has the last word, and leads it out of the body. Gives the contacts that the next step reads,
/// shape [particle_count]. D §6; W §5, eq. 15.
///
/// A midpoint that would enter asks each corner for what that corner itself does towards the body, and for no more than
/// would stop the midpoint alone: no answer gives a corner a speed away from the body, so contacts bring no energy in.
pub fn collide(
    particles: &mut Particles,
    particle_quads: &Csr<u32>,
    midpoints: &Midpoints,
    probes: Probes<'_>,
    settings: &StepSettings,
) -> Vec<Contact> {
    (0..particles.positions.len())
        .map(|i| {
            let velocity = particles.velocities[i];
            let probe = probes.particles[i];
            let touching = touches(velocity, &probe, settings);
            let mut sum = Vec3::ZERO;
            let mut count = 0.0;
            if touching {
                let gain = missing_speed(velocity, &probe, settings);
                if gain > 0.0 {
                    sum += change(velocity, &probe, gain, settings);
                    count += 1.0;
                }
            }
            for &quad in particle_quads.row(i) {
                let probe = &probes.quads[quad as usize];
                let middle = midpoints.velocities[quad as usize];
                if touches(middle, probe, settings) {
                    let asked = CORNER_COUNT * missing_speed(middle, probe, settings);
                    let gain = missing_speed(velocity, probe, settings).min(asked);
                    if gain > 0.0 {
                        sum += change(velocity, probe, gain, settings);
                        count += 1.0;
                    }
                }
            }
            if particles.inverse_masses[i] > 0.0 {
                let mut answered = velocity;
                if count > 0.0 {
                    answered += sum / count;
                }
                if touching {
                    let gain = missing_speed(answered, &probe, settings);
                    if gain > 0.0 {
                        answered += change(answered, &probe, gain, settings);
                    }
                    let depth = (-probe.distance).max(0.0);
                    let way = depth.min(settings.push_speed_per_sweep() * settings.dt);
                    particles.positions[i] += probe.normal * way;
                    probes.particles[i].distance += way;
                }
                particles.velocities[i] = answered;
            }
            if touching {
                Contact { normal: probe.normal, velocity: probe.velocity, touching: true }
            } else {
                Contact::default()
            }
        })
        .collect()
}
