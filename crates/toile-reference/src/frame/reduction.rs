//! Sums of groups of particles, in the order of the GPU's reduction.

/// Particles whose energies are summed together: the workgroup of the GPU's reduction. The order of a sum is part of it.
pub(crate) const GROUP: usize = 64;

/// Sum of a group, by halves.
pub(crate) fn tree_sum(mut values: [f32; GROUP]) -> f32 {
    let mut stride = GROUP / 2;
    while stride > 0 {
        for i in 0..stride {
            values[i] += values[i + stride];
        }
        stride /= 2;
    }
    values[0]
}
