//! The predictive rule along strands, from limits over many edges to single ones.

use super::limit_predictive;
use crate::Particles;
use toile_model::{Limit, Strand};

/// Holds every limit of some strands as [`limit_predictive`] does, level by level, the longest first, and in each level every other
/// limit and then those between. The strands are those of one colour: no two share a particle. `strand_particles` and
/// `strand_lengths` [m] are those of the model.
pub fn limit_strands(
    particles: &mut Particles,
    strands: &[Strand],
    strand_particles: &[u32],
    strand_lengths: &[f32],
    dt: f32,
) {
    for strand in strands {
        let line = &strand_particles[strand.particles.start as usize..strand.particles.end as usize];
        for level in (0..strand.level_count).rev() {
            let reach = 1_usize << level;
            let lengths = &strand_lengths[strand.lengths_from(level) as usize..];
            let limits: Vec<Limit> = line
                .iter()
                .zip(&line[reach..])
                .zip(lengths)
                .map(|((a, b), max_length)| Limit { ends: [*a, *b], rest_length: *max_length, max_length: *max_length })
                .collect();
            for parity in [0, 1] {
                let of_parity = |(k, _): &(usize, &Limit)| (k / reach) % 2 == parity;
                let some: Vec<Limit> = limits.iter().enumerate().filter(of_parity).map(|(_, limit)| *limit).collect();
                limit_predictive(particles, &some, dt);
            }
        }
    }
}
