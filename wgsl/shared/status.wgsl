// What a frame reports. Cleared to zero before the status kernels run. Positive floats keep their order as bits, so that
// integer atomics find the largest one, whatever the order of the invocations.
struct Status {
    non_finite_count: atomic<u32>,
    first_non_finite: atomic<u32>,      // 0xffffffff minus its index, so that the largest is the first; 0: none
    speed_max: atomic<u32>,             // bits [m/s]
    elongation_max: atomic<u32>,        // bits
    over_long_count: atomic<u32>,
    longest_limit: atomic<u32>,         // 0xffffffff minus its index; 0: none
    seam_gap_max: atomic<u32>,          // bits [m]
    kinetic_energy: f32,                // [J]
}
