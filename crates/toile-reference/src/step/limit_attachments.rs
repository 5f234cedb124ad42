//! Long-range attachments: no particle is farther from a pin than the cloth between them is long.

use crate::Particles;
use toile_model::{Attachment, Csr};

/// Removes from the velocity of each particle what would take it beyond its attachments in a move of `dt` [s]. Pins stay where
/// they are. `attachments` has the shape [particle_count] rows. Kim, Chentanez and Müller, Long Range Attachments, 2012.
pub fn limit_attachments(particles: &mut Particles, attachments: &Csr<Attachment>, dt: f32) {
    for i in 0..particles.positions.len() {
        if !(particles.inverse_masses[i] > 0.0) {
            continue;
        }
        for attachment in attachments.row(i) {
            let way = particles.positions[attachment.pin as usize] - particles.positions[i];
            let span = way - particles.velocities[i] * dt;
            let length = span.length();
            // A pin that the host has let go holds nothing.
            let is_pinned = !(particles.inverse_masses[attachment.pin as usize] > 0.0);
            if length > attachment.max_length && is_pinned {
                particles.velocities[i] += span * ((length - attachment.max_length) / (length * dt));
            }
        }
    }
}
