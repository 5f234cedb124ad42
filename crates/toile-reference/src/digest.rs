//! The state as a few rounded numbers.

use crate::Contact;
use glam::Vec3;
use toile_model::{Model, Status};

/// Counts, bounding box in millimetres, and the numbers of the status to three digits. One number per line, so that a
/// reviewer sees what changed.
pub(crate) fn digest(model: &Model, status: &Status, positions: &[Vec3], contacts: &[Contact]) -> String {
    let [low, high] =
        positions.iter().fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[low, high], p| [low.min(*p), high.max(*p)]);
    let mut lines = vec![
        format!("step {}", status.step),
        format!("particles {}", model.particle_count()),
        format!("springs {}", model.spring_count()),
        format!("limits {} in {} colours", model.limits.len(), model.colour_count()),
        format!("quads {}", model.quad_count()),
        format!("non-finite {}", status.non_finite_count),
    ];
    for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
        lines.push(format!("{name} {} .. {} mm", millimetres(low[axis]), millimetres(high[axis])));
    }
    lines.push(format!("speed {:.2e} m/s", status.speed_max));
    lines.push(format!("kinetic energy {:.2e} J", status.kinetic_energy));
    lines.push(format!("elongation {:.3}, {} over-long", status.elongation_max, status.over_long_count));
    if !model.seam_pairs.is_empty() {
        lines.push(format!("seam gap {} mm", millimetres(status.seam_gap_max)));
    }
    if !contacts.is_empty() {
        lines.push(format!("contacts {}", contacts.iter().filter(|contact| contact.touching).count()));
    }
    lines.join("\n") + "\n"
}

/// Whole millimetres; minus zero is zero.
fn millimetres(metres: f32) -> f32 {
    (metres * 1e3).round() + 0.0
}
