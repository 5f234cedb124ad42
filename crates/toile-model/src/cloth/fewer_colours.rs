//! Fewer colours than a greedy colouring has: each is a dispatch, and the last ones hold a few items only.

use crate::{Csr, NO_CORNER};
use std::collections::BTreeSet;

/// Least number of turns for which an item that was moved does not go back to its colour.
const REST: usize = 7;
/// Turns of the search for each item of the colour that is to go, and for none.
const TURNS_PER_ITEM: usize = 60;
const TURNS: usize = 2000;

/// Colours of clusters, fewer than in `colours` where a search finds them; no two clusters of a colour share a node. As many as there are clusters
/// at a node are needed.
pub(crate) fn fewer_colours(clusters: &[[u32; 4]], mut colours: Vec<u32>, node_count: usize) -> Vec<u32> {
    let mut at = vec![Vec::new(); node_count];
    for (cluster, nodes) in clusters.iter().enumerate() {
        nodes.iter().filter(|&&node| node != NO_CORNER).for_each(|&node| at[node as usize].push(cluster as u32));
    }
    let needed = at.iter().map(Vec::len).max().unwrap_or(0);
    let neighbours = Csr::from_rows(clusters.iter().enumerate().map(|(cluster, nodes)| {
        let nodes = nodes.iter().filter(|&&node| node != NO_CORNER);
        let around: BTreeSet<u32> = nodes.flat_map(|&node| at[node as usize].iter().copied()).collect();
        around.into_iter().filter(move |&other| other as usize != cluster)
    }));
    let mut count = colours.iter().max().map_or(0, |last| *last as usize + 1);
    while count > needed {
        let Some(fewer) = Search::new(&neighbours, &colours, count - 1).run() else { break };
        (colours, count) = (fewer, count - 1);
    }
    colours
}

/// A search for a colouring without conflicts: the move that leaves the fewest is made, and not taken back for a while (tabu search, Hertz and de
/// Werra 1987).
struct Search<'a> {
    neighbours: &'a Csr<u32>,
    colours: Vec<u32>,
    count: usize,
    /// How many neighbours of each item have each colour; shape [item_count, count].
    around: Vec<u32>,
    /// From which turn on each item may take each colour; the same shape.
    free_from: Vec<usize>,
    /// Items with a neighbour of their colour.
    troubled: BTreeSet<u32>,
    turns: usize,
}

impl<'a> Search<'a> {
    /// From a colouring whose last colour is one too many.
    fn new(neighbours: &'a Csr<u32>, colours: &[u32], count: usize) -> Self {
        let mut search = Self {
            neighbours,
            colours: colours.to_vec(),
            count,
            around: vec![0; colours.len() * count],
            free_from: vec![0; colours.len() * count],
            troubled: BTreeSet::new(),
            turns: 0,
        };
        let is_last = |item: usize| colours[item] as usize == count;
        for item in 0..colours.len() {
            for &other in neighbours.row(item).iter().filter(|&&other| !is_last(other as usize)) {
                search.around[item * count + colours[other as usize] as usize] += 1;
            }
        }
        let last: Vec<usize> = (0..colours.len()).filter(|&item| is_last(item)).collect();
        search.turns = TURNS + TURNS_PER_ITEM * last.len();
        for item in last {
            let least = (0..count).min_by_key(|colour| search.around[item * count + colour]).expect("a colour is left");
            search.give(item, least as u32);
        }
        search
    }

    /// Turns without a conflict at their end; `None` where there are still some.
    fn run(mut self) -> Option<Vec<u32>> {
        // Without a colour there is nothing to search.
        let mut fewest = usize::MAX;
        for turn in 0..if self.count == 0 { 0 } else { self.turns } {
            if self.troubled.is_empty() {
                return Some(self.colours);
            }
            let conflicts = self.conflicts();
            fewest = fewest.min(conflicts);
            let mut best: Option<(i64, usize, u32, u32)> = None;
            for &item in &self.troubled {
                let row = item as usize * self.count;
                let own = self.colours[item as usize];
                let now = i64::from(self.around[row + own as usize]);
                for colour in (0..self.count as u32).filter(|&colour| colour != own) {
                    let change = i64::from(self.around[row + colour as usize]) - now;
                    let free_from = self.free_from[row + colour as usize];
                    // A move that leaves fewer conflicts than ever is always free.
                    let is_free = free_from <= turn || conflicts as i64 + change < fewest as i64;
                    let this = (change, free_from, item, colour);
                    if is_free && best.is_none_or(|best| this < best) {
                        best = Some(this);
                    }
                }
            }
            // Where all moves rest, the turn goes by.
            let Some((_, _, item, colour)) = best else { continue };
            let left = self.colours[item as usize];
            self.take(item as usize);
            self.give(item as usize, colour);
            self.free_from[item as usize * self.count + left as usize] = turn + REST + self.troubled.len();
        }
        None
    }

    /// Pairs of neighbours of one colour.
    fn conflicts(&self) -> usize {
        let of = |&item: &u32| self.around[item as usize * self.count + self.colours[item as usize] as usize] as usize;
        self.troubled.iter().map(of).sum::<usize>() / 2
    }

    /// Takes an item out of its colour.
    fn take(&mut self, item: usize) {
        let colour = self.colours[item];
        self.troubled.remove(&(item as u32));
        for &other in self.neighbours.row(item) {
            let around = &mut self.around[other as usize * self.count + colour as usize];
            *around -= 1;
            if *around == 0 && self.colours[other as usize] == colour {
                self.troubled.remove(&other);
            }
        }
    }

    /// Gives an item without one a colour.
    fn give(&mut self, item: usize, colour: u32) {
        self.colours[item] = colour;
        for &other in self.neighbours.row(item) {
            self.around[other as usize * self.count + colour as usize] += 1;
            if self.colours[other as usize] == colour {
                self.troubled.extend([other, item as u32]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::fewer_colours;
    use crate::NO_CORNER;
    use std::collections::BTreeSet;

    const N: u32 = NO_CORNER;

    /// The colours that are left of a greedy colouring, one for each cluster to begin with; checked to be one.
    fn left_of(clusters: &[[u32; 4]]) -> usize {
        let node_count = clusters.iter().flatten().filter(|&&node| node != N).max().map_or(0, |last| last + 1);
        let colours = fewer_colours(clusters, (0..clusters.len() as u32).collect(), node_count as usize);
        let mut taken = BTreeSet::new();
        for (nodes, colour) in clusters.iter().zip(&colours) {
            let mut nodes = nodes.iter().filter(|&&node| node != N);
            assert!(nodes.all(|node| taken.insert((*node, *colour))), "a node twice in a colour: {colours:?}");
        }
        let used: BTreeSet<u32> = colours.iter().copied().collect();
        assert!(used.iter().copied().eq(0..used.len() as u32), "no colour is empty: {used:?}");
        used.len()
    }

    #[test]
    fn as_many_are_left_as_clusters_meet_at_a_node() {
        assert_eq!(left_of(&[]), 0);
        assert_eq!(left_of(&[[0, 1, 2, 3]]), 1);
        assert_eq!(left_of(&[[0, 1, N, N], [2, 3, N, N], [4, 5, 6, N]]), 1);
        let fan: Vec<[u32; 4]> = (0..9).map(|k| [9, k, (k + 1) % 9, N]).collect();
        assert_eq!(left_of(&fan), 9);
        let cells = |side: u32| {
            let corners = (0..side * side).map(move |k| k + k / side);
            corners.map(move |k| [k, k + 1, k + side + 1, k + side + 2]).collect::<Vec<_>>()
        };
        assert_eq!([left_of(&cells(7)), left_of(&cells(8))], [4, 4]);
    }

    #[test]
    fn where_fewer_cannot_be_found_the_colours_stay() {
        // Around a ring of five, two of each meet, but two colours do not go round.
        let ring: Vec<[u32; 4]> = (0..5).map(|k| [k, (k + 1) % 5, N, N]).collect();
        assert_eq!(left_of(&ring), 3);
    }
}
