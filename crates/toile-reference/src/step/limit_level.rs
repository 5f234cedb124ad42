//! The predictive rule between the nodes of a level.

use super::cluster::each_pair;
use crate::Nodes;
use std::ops::Range;
use toile_model::Arrays;

/// Shifts both ends of each limit that is over-long, by inverse mass, `relaxation` times as much as that takes [1]. The clusters are those
/// of one colour: no two share a node.
pub fn limit_level(nodes: &mut Nodes, model: &Arrays, clusters: &Range<u32>, relaxation: f32) {
    each_pair(&model.clusters, clusters, |[a, b], cluster, place| {
        let max_length = model.clusters[cluster].max_lengths[place];
        let [a, b] = [a, b].map(|node| node as usize);
        let [weight_a, weight_b] = [a, b].map(|node| nodes.inverse_masses[node]);
        let weight = weight_a + weight_b;
        let chord = nodes.place(b) - nodes.place(a);
        let length = chord.length();
        if length > max_length && weight > 0.0 {
            let pull = chord * (relaxation * (length - max_length) / (length * weight));
            nodes.shifts[a] += pull * weight_a;
            nodes.shifts[b] -= pull * weight_b;
        }
    });
}
