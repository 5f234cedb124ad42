//! Where the guard ends.

use crate::{Particles, Probe};
use toile_model::StepSettings;

/// Stops each particle that the coming move would lead deeper into a body than the thickness of the cloth; one that is deeper already goes
/// no farther. `probes` are what the particles saw in this step, shape [particle_count].
pub fn keep_out(particles: &mut Particles, probes: &[Probe], settings: &StepSettings) {
    for (i, probe) in probes.iter().enumerate() {
        if !(probe.hit && particles.inverse_masses[i] > 0.0) {
            continue;
        }
        let approach = (particles.velocities[i] - probe.velocity).dot(probe.normal);
        let wanted = (-(probe.distance + settings.thickness) / settings.dt).min(0.0);
        if approach < wanted {
            particles.velocities[i] += probe.normal * (wanted - approach);
        }
    }
}
