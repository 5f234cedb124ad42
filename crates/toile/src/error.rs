//! What a caller cannot foresee.

use thiserror::Error;

/// What a caller cannot foresee.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The device refuses or is lost.
    #[error(transparent)]
    Gpu(#[from] toile_gpu::GpuError),
    /// The cloth cannot be meshed.
    #[error(transparent)]
    Model(#[from] toile_model::ModelError),
    /// The motion of a body leads to no place.
    #[error("the body has no finite position at {time} s of its motion: mend its clip, or choose another one")]
    Body {
        /// First time at which it was seen [s].
        time: f64,
    },
    /// The state is not finite.
    #[error(
        "the simulation diverged: {count} particles are not finite or faster than 1 km/s at step {step}, the first is particle {particle}; use the default rule, softer springs or a smaller safety factor"
    )]
    Diverged {
        /// Step at which it was seen.
        step: u64,
        /// First particle by index.
        particle: u32,
        /// Number of particles.
        count: u32,
    },
}
