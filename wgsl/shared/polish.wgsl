// Further sweeps in the steps that need them, and a bound on them.
struct Polish {
    target_elongation: f32,     // needs no further sweep
    sweeps: u32,                // at most so many further sweeps in a step
}

// The first two words are those of the present step, the others count from the start.
struct PolishState {
    elongation_max: atomic<u32>,    // bits of the largest elongation above the target; 0: none
    granted: u32,                   // further sweeps
    further_sweeps: u32,
    missed_steps: u32,
}

@group(0) @binding(1) var<uniform> polish: Polish;
@group(0) @binding(2) var<storage, read_write> polish_state: PolishState;
