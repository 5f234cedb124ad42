//! Whether a step gets a further sweep.

/// What a polish knows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PolishState {
    /// What [`measure_excess`](super::measure_excess) found last [1].
    pub elongation_max: f32,
    /// Further sweeps of the present step.
    pub granted: u32,
    /// Further sweeps so far.
    pub further_sweeps: u32,
    /// Steps so far that ended above the target.
    pub missed_steps: u32,
}

/// Whether the step gets a further sweep, of at most `sweeps`: it does while a spring is above the target. One that gets no more and has
/// a spring above it has missed it. What was measured is used up.
pub fn grant_sweep(polish: &mut PolishState, sweeps: u32) -> bool {
    let above = polish.elongation_max > 0.0;
    let granted = above && polish.granted < sweeps;
    if granted {
        polish.granted += 1;
        polish.further_sweeps += 1;
    } else {
        polish.granted = 0;
        polish.missed_steps += u32::from(above);
    }
    polish.elongation_max = 0.0;
    granted
}
