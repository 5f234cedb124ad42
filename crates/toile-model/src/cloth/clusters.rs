//! Clusters of limits: four nodes in which up to six limits lie, so that a kernel loads and stores each node once for all of them.

use crate::cloth::fewer_colours::fewer_colours;
use crate::{Csr, NO_CORNER};
use std::ops::Range;

/// Clusters of a graph, sorted by colour, and the range of each colour: no two clusters of a colour share a node. Each edge lies in one of
/// them at least, between nodes of [`CLUSTER_PAIRS`](crate::CLUSTER_PAIRS); of a grid they are its cells. `ends` have the lower node first and are sorted;
/// `lengths` are theirs.
pub(crate) fn clusters(ends: &[[u32; 2]], lengths: &[f64], node_count: usize) -> (Vec<[u32; 4]>, Vec<Range<u32>>) {
    let mut cover = Cover::new(ends, lengths, node_count);
    let mut order: Vec<usize> = (0..ends.len()).collect();
    // The longest first: the diagonals of a grid, each of which has a cell of its own.
    order.sort_by(|a, b| lengths[*b].total_cmp(&lengths[*a]).then(a.cmp(b)));
    let mut clusters = Vec::with_capacity(ends.len() / 3);
    for edge in order {
        if !cover.is_covered[edge] {
            clusters.push(cover.cluster(ends[edge]));
        }
    }
    clusters.sort_unstable_by_key(|nodes| nodes.iter().copied().min());
    let colours = fewer_colours(&clusters, colours(&clusters, node_count), node_count);
    sorted(&clusters, &colours)
}

/// A node that an edge leads to.
#[derive(Clone, Copy)]
struct Neighbour {
    node: u32,
    edge: usize,
}

/// Which edges lie in a cluster.
struct Cover<'a> {
    lengths: &'a [f64],
    /// Of each node by ascending node.
    neighbours: Csr<Neighbour>,
    is_covered: Vec<bool>,
}

impl<'a> Cover<'a> {
    fn new(ends: &[[u32; 2]], lengths: &'a [f64], node_count: usize) -> Self {
        let mut rows = vec![Vec::new(); node_count];
        for (edge, &[a, b]) in ends.iter().enumerate() {
            rows[a as usize].push(Neighbour { node: b, edge });
            rows[b as usize].push(Neighbour { node: a, edge });
        }
        rows.iter_mut().for_each(|row| row.sort_unstable_by_key(|n| n.node));
        Self { lengths, neighbours: Csr::from_rows(rows), is_covered: vec![false; ends.len()] }
    }

    fn edge(&self, a: u32, b: u32) -> Option<usize> {
        let row = self.neighbours.row(a as usize);
        row.binary_search_by_key(&b, |n| n.node).ok().map(|k| row[k].edge)
    }

    /// The cluster around an edge in which the most edges lie that lie in none yet; of equals the smallest.
    fn cluster(&mut self, [a, b]: [u32; 2]) -> [u32; 4] {
        let common: Vec<u32> =
            self.neighbours.row(a as usize).iter().map(|n| n.node).filter(|&c| self.edge(b, c).is_some()).collect();
        let mut best = [a, b, NO_CORNER, NO_CORNER];
        let mut best_worth = self.worth(&best);
        for (k, &c) in common.iter().enumerate() {
            for &d in common[k + 1..].iter().chain([&NO_CORNER]) {
                let nodes = [a, b, c, d];
                let worth = self.worth(&nodes);
                if worth.0 > best_worth.0 || worth.0 == best_worth.0 && worth.1 < best_worth.1 {
                    (best, best_worth) = (nodes, worth);
                }
            }
        }
        for edge in self.edges(&best).collect::<Vec<_>>() {
            self.is_covered[edge] = true;
        }
        best
    }

    fn edges(&self, nodes: &[u32; 4]) -> impl Iterator<Item = usize> {
        crate::CLUSTER_PAIRS.into_iter().filter_map(|[p, q]| {
            let [p, q] = [nodes[p], nodes[q]];
            if p == NO_CORNER || q == NO_CORNER { None } else { self.edge(p, q) }
        })
    }

    /// How many edges of it lie in no cluster yet, and the length of all of them [m].
    fn worth(&self, nodes: &[u32; 4]) -> (usize, f64) {
        self.edges(nodes).fold((0, 0.0), |(count, length), edge| {
            (count + usize::from(!self.is_covered[edge]), length + self.lengths[edge])
        })
    }
}

/// The first colour of each cluster that none has with which it shares a node.
fn colours(clusters: &[[u32; 4]], node_count: usize) -> Vec<u32> {
    let mut used: Vec<u128> = vec![0; node_count];
    let nodes = |cluster: &[u32; 4]| cluster.iter().copied().filter(|&node| node != NO_CORNER).collect::<Vec<_>>();
    clusters
        .iter()
        .map(|cluster| {
            let taken = nodes(cluster).iter().fold(0, |bits, &node| bits | used[node as usize]);
            let colour = taken.trailing_ones();
            assert!(colour < u128::BITS, "a node has too many limits");
            nodes(cluster).iter().for_each(|&node| used[node as usize] |= 1 << colour);
            colour
        })
        .collect()
}

fn sorted(clusters: &[[u32; 4]], colours: &[u32]) -> (Vec<[u32; 4]>, Vec<Range<u32>>) {
    let mut keys: Vec<(u32, usize)> = colours.iter().copied().zip(0..).collect();
    keys.sort_unstable();
    let mut start = 0;
    let ranges = keys.chunk_by(|one, other| one.0 == other.0).map(|group| {
        let range = start..start + group.len() as u32;
        start = range.end;
        range
    });
    let ranges = ranges.collect();
    (keys.iter().map(|&(_, k)| clusters[k]).collect(), ranges)
}

#[cfg(test)]
mod tests {
    use super::clusters;
    use crate::{CLUSTER_PAIRS, NO_CORNER};

    /// Checks what holds of every cover, and counts clusters and colours.
    fn covered(ends: &[[u32; 2]], lengths: &[f64], node_count: usize) -> [usize; 2] {
        let (clusters, colours) = clusters(ends, lengths, node_count);
        let inside = |nodes: &[u32; 4], ends: &[u32; 2]| {
            CLUSTER_PAIRS.iter().any(|[p, q]| [nodes[*p].min(nodes[*q]), nodes[*p].max(nodes[*q])] == *ends)
        };
        assert!(ends.iter().all(|ends| clusters.iter().any(|nodes| inside(nodes, ends))), "an edge lies in no cluster");
        for colour in &colours {
            let mut nodes: Vec<u32> = clusters[colour.start as usize..colour.end as usize].concat();
            nodes.retain(|&node| node != NO_CORNER);
            nodes.sort_unstable();
            assert!(nodes.windows(2).all(|pair| pair[0] < pair[1]), "a node twice in a colour");
        }
        assert_eq!(colours.last().map_or(0, |last| last.end as usize), clusters.len());
        [clusters.len(), colours.len()]
    }

    #[test]
    fn those_of_a_grid_are_its_cells_in_four_colours() {
        let (columns, rows) = (6, 5);
        let mut edges = Vec::new();
        for i in 0..columns * rows {
            let (right, below) = ((i + 1) % columns != 0, i + columns < columns * rows);
            let steps = [(right, 1, 1.0), (below, columns, 1.0), (right && below, columns + 1, 1.4)];
            edges.extend(steps.iter().filter(|step| step.0).map(|&(_, way, length)| ([i, i + way], length)));
            if i % columns != 0 && below {
                edges.push(([i, i + columns - 1], 1.4));
            }
        }
        edges.sort_by_key(|edge| edge.0);
        let (ends, lengths): (Vec<_>, Vec<_>) = edges.into_iter().unzip();
        assert_eq!(covered(&ends, &lengths, 30), [20, 4]);
    }

    #[test]
    fn lone_edges_triangles_and_nothing_are_covered() {
        assert_eq!(covered(&[], &[], 3), [0, 0]);
        assert_eq!(covered(&[[0, 1]], &[1.0], 2), [1, 1]);
        assert_eq!(covered(&[[0, 1], [0, 2], [1, 2], [2, 3]], &[1.0, 1.0, 1.0, 2.0], 4), [2, 2]);
    }

    #[test]
    fn a_node_of_many_edges_has_a_colour_for_each() {
        let ends: Vec<[u32; 2]> = (1..40).map(|other| [0, other]).collect();
        assert_eq!(covered(&ends, &[1.0; 39], 40), [39, 39]);
    }
}
