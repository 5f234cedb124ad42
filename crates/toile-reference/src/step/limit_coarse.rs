//! The predictive rule between coarse particles.

use crate::Coarse;
use toile_model::{CoarseParticle, Limit};

/// How much more than its excess a coarse limit takes [1]: what is behind its ends follows later.
const OVER_RELAXATION: f32 = 1.5;

/// Shifts both ends of each limit that is over-long, by inverse mass. The limits are those of one colour: no two share a coarse particle.
pub fn limit_coarse(coarse: &mut Coarse, coarse_particles: &[CoarseParticle], limits: &[Limit]) {
    for limit in limits {
        let [a, b] = limit.ends.map(|end| end as usize);
        let [weight_a, weight_b] = [a, b].map(|end| coarse_particles[end].inverse_mass);
        let weight = weight_a + weight_b;
        let chord = coarse.place(b) - coarse.place(a);
        let length = chord.length();
        if length > limit.max_length && weight > 0.0 {
            let pull = chord * (OVER_RELAXATION * (length - limit.max_length) / (length * weight));
            coarse.shifts[a] += pull * weight_a;
            coarse.shifts[b] -= pull * weight_b;
        }
    }
}
