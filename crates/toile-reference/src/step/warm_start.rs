//! Limits begin where they ended.

use super::pair::pull_together;
use crate::Particles;
use toile_model::Limit;

/// Part of the impulses that a step begins with [1]. With more the slow modes of a cloth swing up: where a step leaves the part τ of what
/// a mode lacks, its error follows z³ = τ·((2 + c)·z² − (1 + 2·c)·z + c), and no root leaves the unit circle for any τ < 1 up to c = 1/2.
const CARRIED: f32 = 0.5;

/// Gives each limit half of the impulse [N·s] that it ended the last step with, along where the last move left it. A limit without
/// direction forgets its impulse. The limits are those of one colour: no two share a particle; `impulses` are theirs.
pub fn warm_start(particles: &mut Particles, limits: &[Limit], impulses: &mut [f32]) {
    for (limit, impulse) in limits.iter().zip(impulses) {
        let [a, b] = limit.ends.map(|end| particles.positions[end as usize]);
        let span = b - a;
        let length = span.length();
        let pull = CARRIED * *impulse;
        *impulse = if length > 0.0 { pull } else { 0.0 };
        if *impulse != 0.0 {
            pull_together(particles, limit.ends, span * (pull / length));
        }
    }
}
