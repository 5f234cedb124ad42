//! Labelled edges keep their mean height while the garment is sewn.

use crate::Particles;
use crate::frame::{GROUP, tree_sum};
use toile_model::{Hold, StepSettings};

/// Shifts the vertical velocities of the particles of each hold so that their mean leads the mean height to that of the hold,
/// in proportion to the way and with a bound. `held_particles` are those that the holds name.
pub fn hold_edges(particles: &mut Particles, holds: &[Hold], held_particles: &[u32], settings: &StepSettings) {
    for hold in holds {
        let members = &held_particles[hold.particles.start as usize..hold.particles.end as usize];
        let count = members.len() as f32;
        let mut heights = [0.0; GROUP];
        let mut rises = [0.0; GROUP];
        for (k, &member) in members.iter().enumerate() {
            heights[k % GROUP] += particles.positions[member as usize].y;
            rises[k % GROUP] += particles.velocities[member as usize].y;
        }
        let wanted = settings.hold_rate * (hold.height - tree_sum(heights) / count);
        // Not `clamp`: a NaN must go the way WGSL's min(max()) sends it, without a panic.
        let speed = wanted.max(-settings.hold_speed).min(settings.hold_speed);
        let change = speed - tree_sum(rises) / count;
        for &member in members {
            particles.velocities[member as usize].y += change;
        }
    }
}
