//! The limits of clusters, one after the other.

use std::ops::Range;
use toile_model::{CLUSTER_PAIRS, Cluster, NO_CORNER};

/// Does something with the two nodes and the place among [`CLUSTER_PAIRS`] of each pair of some clusters.
pub(super) fn each_pair(clusters: &[Cluster], range: &Range<u32>, mut act: impl FnMut([u32; 2], usize, usize)) {
    for index in range.clone().map(|index| index as usize) {
        for (place, pair) in CLUSTER_PAIRS.iter().enumerate() {
            let ends = pair.map(|corner| clusters[index].nodes[corner]);
            if !ends.contains(&NO_CORNER) {
                act(ends, index, place);
            }
        }
    }
}
