//! What a caller cannot foresee.

use thiserror::Error;

/// What a caller cannot foresee.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The device refuses or is lost.
    #[error(transparent)]
    Gpu(#[from] toile_gpu::GpuError),
    /// What stands in the way of sewing cannot be mended.
    #[error(transparent)]
    Fit(toile_model::FitError),
    /// The cloth cannot be meshed.
    #[error(transparent)]
    Model(#[from] toile_model::ModelError),
    /// The motion of a body leads to no place.
    #[error("the body has no finite position at {time} s of its motion: mend its clip, or choose another one")]
    Body {
        /// First time at which it was seen [s].
        time: f64,
    },
    /// A body cannot go over from the pose that its garments are sewn in.
    #[error(
        "the pose to dress in is not one of the body that moves: it must move the same joints, and the scene must have one such body"
    )]
    Pose,
    /// The maps of a round cannot be kept.
    #[error(
        "maps can be kept of one body whose clip ends as it begins, after a whole number of maps; this one has {duration:.3} s, and a map is \
         drawn every {interval:.4} s: choose another clip or frame rate, or draw the maps as the body moves"
    )]
    Round {
        /// Length of the motion [s].
        duration: f64,
        /// Time from one map to the next [s].
        interval: f64,
    },
    /// What the cloths collide with does not fit into its maps.
    #[error(transparent)]
    Maps(#[from] toile_gpu::MapsFault),
    /// A body that the host skins was where its maps are not.
    #[error(
        "the body that the host skins was {outside:.2} m outside of its maps, and cloth goes through it there: it jumped, which Simulation::teleport tells, or it is \
         larger than 1.3 times the longest extent of the mesh that was given"
    )]
    Outside {
        /// How far [m].
        outside: f32,
    },
    /// What another simulation has dressed is not of this one, or its body stands elsewhere.
    #[error("the cloth cannot be put on: {0}")]
    PutOn(String),
    /// A saved state is not one of this simulation.
    #[error("the saved state cannot be restored: {0}")]
    State(String),
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

impl From<toile_model::FitError> for Error {
    fn from(error: toile_model::FitError) -> Self {
        match error {
            // A number out of its range is the same fault, whoever meets it first.
            toile_model::FitError::Range(range) => Self::Model(range.into()),
            other => Self::Fit(other),
        }
    }
}
