//! How far a cloth is stretched.

/// How far a cloth is stretched at the end of a frame: measured on the device over every structural and shear spring.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Strain {
    /// Steps done at the end of that frame.
    pub step: u64,
    /// Largest elongation [1]; 0 when no spring is longer than its rest length.
    pub elongation_max: f32,
    /// The spring that has it, as an index into [`Arrays::limits`](toile_model::Arrays::limits), which names its particles.
    pub longest_limit: Option<u32>,
    /// Number of springs whose elongation is above the threshold along them.
    pub over_long_count: u32,
    /// Further sweeps of a [`Polish`](toile_scene::Polish) so far; 0 without one.
    pub further_sweeps: u32,
    /// Steps so far that ended above its target although they had all their further sweeps.
    pub missed_steps: u32,
}
