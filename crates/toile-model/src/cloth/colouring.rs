//! Colours of pairs of particles: no two pairs of a colour share a particle.

use crate::Csr;
use std::ops::Range;

/// Number of families of [`Pair`]: the two diagonals, warp and weft.
pub(crate) const FAMILIES: u32 = 4;

/// Two particles that one colour must not touch twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Pair {
    /// The two particles, the lower index first.
    pub(crate) ends: [u32; 2],
    /// Direction on a grid, below [`FAMILIES`]; `None` outside of grids. A family has two colours of its own, which on a grid
    /// is all it needs: every other pair of a line.
    pub(crate) family: Option<u32>,
}

/// Sorts items by the colour of their pairs, inside a colour by their ends, and gives the range of each colour. No two pairs of a
/// colour share a particle. The same pairs in the same order always give the same colours.
///
/// A grid needs two colours per family. Otherwise their number is about the largest number of pairs at one particle, the fewest that are possible.
pub(crate) fn sort_by_colour<T: Copy>(items: &mut Vec<T>, pairs: &[Pair], particle_count: usize) -> Vec<Range<u32>> {
    let colours = Colouring::new(pairs, particle_count).run();
    let mut keys: Vec<(u32, [u32; 2], u32)> =
        colours.iter().zip(pairs).enumerate().map(|(k, (&colour, pair))| (colour, pair.ends, k as u32)).collect();
    keys.sort_unstable();
    *items = keys.iter().map(|&(_, _, k)| items[k as usize]).collect();
    let mut start = 0;
    keys.chunk_by(|a, b| a.0 == b.0)
        .map(|group| {
            let range = start..start + group.len() as u32;
            start = range.end;
            range
        })
        .collect()
}

const NONE: u32 = u32::MAX;

struct Colouring<'a> {
    pairs: &'a [Pair],
    /// Pairs at each particle.
    at: Csr<u32>,
    /// Colour of each pair, or `NONE`.
    colours: Vec<u32>,
    /// Colours in use at each particle as bits, `words` per particle.
    used: Vec<u64>,
    words: usize,
    colour_count: u32,
}

impl<'a> Colouring<'a> {
    fn new(pairs: &'a [Pair], particle_count: usize) -> Self {
        let mut degrees = vec![0_u32; particle_count];
        for i in pairs.iter().flat_map(|p| p.ends) {
            degrees[i as usize] += 1;
        }
        let mut offsets = vec![0_u32];
        for degree in &degrees {
            offsets.push(offsets[offsets.len() - 1] + degree);
        }
        let mut next: Vec<u32> = offsets[..particle_count].to_vec();
        let mut values = vec![0; 2 * pairs.len()];
        for (k, pair) in pairs.iter().enumerate() {
            for i in pair.ends {
                values[next[i as usize] as usize] = k as u32;
                next[i as usize] += 1;
            }
        }
        let degree_max = degrees.iter().copied().max().unwrap_or(0);
        let colour_count =
            if pairs.iter().any(|p| p.family.is_some()) { degree_max.max(2 * FAMILIES) } else { degree_max };
        // Colouring greedily never needs more than 2·degree − 1 colours.
        let words = (2 * colour_count as usize).div_ceil(64).max(1);
        Self {
            pairs,
            at: Csr { offsets, values },
            colours: vec![NONE; pairs.len()],
            used: vec![0; words * particle_count],
            words,
            colour_count,
        }
    }

    fn run(mut self) -> Vec<u32> {
        let mut left = Vec::new();
        for (k, pair) in self.pairs.iter().enumerate() {
            let own = pair.family.map_or(0..0, |f| 2 * f..2 * f + 2);
            match self.common(pair.ends, own) {
                Some(colour) => self.paint(k as u32, colour),
                None => left.push(k as u32),
            }
        }
        for pair in left {
            let ends = self.pairs[pair as usize].ends;
            let common = self.common(ends, 0..self.colour_count);
            let colour = common.or_else(|| self.exchange(ends)).unwrap_or_else(|| {
                self.colour_count += 1;
                self.colour_count - 1
            });
            self.paint(pair, colour);
        }
        self.colours
    }

    /// First colour of a range that is free at both ends.
    fn common(&self, [a, b]: [u32; 2], mut colours: Range<u32>) -> Option<u32> {
        colours.find(|&c| self.is_free(a, c) && self.is_free(b, c))
    }

    fn is_free(&self, particle: u32, colour: u32) -> bool {
        self.used[particle as usize * self.words + colour as usize / 64] >> (colour % 64) & 1 == 0
    }

    fn flip(&mut self, particle: u32, colour: u32) {
        self.used[particle as usize * self.words + colour as usize / 64] ^= 1 << (colour % 64);
    }

    fn paint(&mut self, pair: u32, colour: u32) {
        self.colours[pair as usize] = colour;
        for i in self.pairs[pair as usize].ends {
            self.flip(i, colour);
        }
    }

    fn pair_of_colour(&self, particle: u32, colour: u32) -> Option<u32> {
        self.at.row(particle as usize).iter().copied().find(|&k| self.colours[k as usize] == colour)
    }

    /// Makes a colour free at both particles by exchanging two colours along a chain (Kempe): one is free at `a`, the other at
    /// `b`, and the chain of both that starts at `b` must not end at `a`.
    fn exchange(&mut self, [a, b]: [u32; 2]) -> Option<u32> {
        for free_at_a in 0..self.colour_count {
            if !self.is_free(a, free_at_a) {
                continue;
            }
            for free_at_b in 0..self.colour_count {
                if !self.is_free(b, free_at_b) {
                    continue;
                }
                let mut chain = Vec::new();
                let (mut end, mut colours) = (b, [free_at_a, free_at_b]);
                while let Some(pair) = self.pair_of_colour(end, colours[0]) {
                    chain.push(pair);
                    let [p, q] = self.pairs[pair as usize].ends;
                    end = if p == end { q } else { p };
                    colours.swap(0, 1);
                }
                if end == a {
                    continue;
                }
                let colours: Vec<u32> = chain.iter().map(|&k| self.colours[k as usize]).collect();
                for (&pair, &colour) in chain.iter().zip(&colours) {
                    self.pairs[pair as usize].ends.into_iter().for_each(|i| self.flip(i, colour));
                }
                for (&pair, &colour) in chain.iter().zip(&colours) {
                    self.paint(pair, free_at_a + free_at_b - colour);
                }
                return Some(free_at_a);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn coloured(ends: &[[u32; 2]]) -> usize {
        let pairs: Vec<Pair> = ends.iter().map(|&ends| Pair { ends, family: None }).collect();
        let mut items = ends.to_vec();
        let colours = sort_by_colour(&mut items, &pairs, 64);
        for colour in &colours {
            let pairs = &items[colour.start as usize..colour.end as usize];
            let mut particles: Vec<u32> = pairs.iter().flatten().copied().collect();
            particles.sort_unstable();
            assert!(particles.windows(2).all(|p| p[0] < p[1]), "a particle twice in {pairs:?}");
        }
        let mut sorted = items.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, ends, "no pair is lost");
        colours.len()
    }

    #[test]
    fn nothing_has_no_colours() {
        assert_eq!(coloured(&[]), 0);
    }

    #[test]
    fn all_pairs_of_few_particles_need_as_many_colours_as_theory_says() {
        for count in 2..=12_u32 {
            let pairs: Vec<[u32; 2]> = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b])).collect();
            let fewest = if count.is_multiple_of(2) { count - 1 } else { count } as usize;
            let colours = coloured(&pairs);
            assert!(colours >= fewest && colours <= fewest + 1, "{count} particles: {colours} colours");
        }
    }

    #[test]
    fn a_greedy_dead_end_is_mended_by_exchanging_colours() {
        // Greedily the ends of the chain 2-0-1-3 both take the first colour, then [4, 0] the second; the last pair has none left.
        assert_eq!(coloured(&[[0, 2], [0, 4], [1, 3], [1, 4]]), 2);
        // A ring of an even number of pairs, its two halves begun with the same colour.
        assert_eq!(coloured(&[[0, 1], [0, 5], [1, 2], [2, 3], [3, 4], [4, 5]]), 2);
    }
}
