//! What a solver reports of its state.

use serde::{Deserialize, Serialize};

/// What a solver reports of its state at the end of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Status {
    /// Steps done so far.
    pub step: u64,
    /// Particles whose position or velocity is not finite, or that are faster than 1 km/s: a run that diverges is seen before it overflows.
    pub non_finite_count: u32,
    /// The first of them, by index.
    pub first_non_finite: Option<u32>,
    /// Largest speed [m/s].
    pub speed_max: f32,
    /// Kinetic energy of all particles that are not pinned [J].
    pub kinetic_energy: f32,
    /// Largest elongation of a structural or shear spring [1]; 0 when none is longer than its rest length.
    pub elongation_max: f32,
    /// Number of structural and shear springs whose elongation is above the threshold along them.
    pub over_long_count: u32,
    /// The spring with the largest elongation, as an index into [`Arrays::limits`](crate::Arrays::limits).
    pub longest_limit: Option<u32>,
    /// Largest distance between two particles of a seam pair [m]; 0 without open seams.
    pub seam_gap_max: f32,
    /// Further sweeps of a [`Polish`](toile_scene::Polish) so far; 0 without one.
    pub further_sweeps: u32,
    /// Steps so far that ended above its target although they had all their further sweeps.
    pub missed_steps: u32,
}
