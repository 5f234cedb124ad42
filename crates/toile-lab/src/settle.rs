//! Small cloth on the CPU: the reference gives the bits of the device, and a few hundred particles keep no GPU busy.

use toile::model::{Model, StepSettings};
use toile_reference::{Colliders, Reference};

/// The reference after so many frames; `None` once a particle is not finite or faster than 1 km/s.
pub fn settled(model: &Model, step: &StepSettings, colliders: Colliders, frames: u32) -> Option<Reference> {
    let mut reference = Reference::new(model, step, colliders);
    for _ in 0..frames {
        reference.frame();
        if reference.status().non_finite_count > 0 {
            return None;
        }
    }
    Some(reference)
}
