//! The yardstick of the benchmarks: every position and velocity read and written once.

use crate::Particles;

/// The same state again. The time it takes is the unit in which a step's cost is counted.
pub fn state_copy(particles: &Particles) -> Particles {
    particles.clone()
}
