//! Lines of cloth that go straight on from hinge to hinge.

use std::ops::Range;

/// Three particles one after the other, with a bend spring between the outer ones.
pub(crate) struct Hinge {
    pub(crate) outer: [u32; 2],
    pub(crate) middle: u32,
}

/// Particles one after the other, with a hinge at each that has a neighbour on both sides. A place counts them from 0; around a ring it goes on.
pub(crate) struct BendLine {
    particles: Vec<u32>,
    /// Distance in the flat cloth from each to the next [m].
    sides: Vec<f64>,
    /// Sums of the sides before each place [m], and of their cubes [m³]; of a ring twice around.
    sums: Vec<[f64; 2]>,
    is_ring: bool,
}

impl BendLine {
    /// `side` is the length of the side between two particles [m].
    fn new(mut particles: Vec<u32>, side: impl Fn(u32, u32) -> Option<f64>) -> Self {
        let count = particles.len();
        // It came around to the hinge at which it began.
        let is_ring = count > 4 && particles[..2] == particles[count - 2..];
        let sides: Vec<f64> = particles
            .windows(2)
            .map(|pair| side(pair[0], pair[1]).expect("a hinge has two sides"))
            .take(if is_ring { count - 2 } else { count })
            .collect();
        if is_ring {
            particles.truncate(count - 2);
        }
        let mut sums = vec![[0.0; 2]];
        for side in sides.iter().chain(sides.iter().filter(|_| is_ring)) {
            let [length, cubes] = sums[sums.len() - 1];
            sums.push([length + side, cubes + side.powi(3)]);
        }
        Self { particles, sides, sums, is_ring }
    }

    pub(crate) fn particle(&self, place: usize) -> u32 {
        self.particles[place % self.particles.len()]
    }

    pub(crate) fn side_count(&self) -> usize {
        self.sides.len()
    }

    /// Length of the side from a place to the next [m].
    pub(crate) fn side(&self, place: usize) -> f64 {
        self.sides[place % self.sides.len()]
    }

    /// Length of sides from a place on [m], and the sum of their cubes [m³].
    pub(crate) fn sums(&self, sides: &Range<usize>) -> [f64; 2] {
        [0, 1].map(|which| self.sums[sides.end][which] - self.sums[sides.start][which])
    }

    /// The places of its hinges.
    pub(crate) fn middles(&self) -> Range<usize> {
        if self.is_ring { 0..self.particles.len() } else { 1..self.particles.len() - 1 }
    }

    /// The outer particles of a hinge, and the length of both its sides [m].
    pub(crate) fn hinge(&self, middle: usize) -> ([u32; 2], f64) {
        let before = middle + self.particles.len() - 1;
        (
            [self.particle(before), self.particle(middle + 1)],
            self.side(middle + self.sides.len() - 1) + self.side(middle),
        )
    }

    /// So many sides around a place, or as many as there are: beside it where the line ends.
    pub(crate) fn around(&self, middle: usize, side_count: usize) -> Range<usize> {
        let all = self.sides.len();
        // Across a ring two would have the same ends.
        let count = side_count.min(if self.is_ring { ((all - 1) / 2).max(2) } else { all });
        let first = if self.is_ring {
            (middle + all - count / 2) % all
        } else {
            middle.saturating_sub(count / 2).min(all - count)
        };
        first..first + count
    }
}

/// The lines of all hinges; each hinge is on one of them. `side` is the length of the side between two particles [m].
pub(crate) fn bend_lines(
    hinges: &[Hinge],
    particle_count: usize,
    side: impl Fn(u32, u32) -> Option<f64>,
) -> Vec<BendLine> {
    let mut rows: Vec<Vec<u32>> = vec![Vec::new(); particle_count];
    hinges.iter().zip(0..).for_each(|(hinge, index)| rows[hinge.middle as usize].push(index));
    // The hinge around `here` that a line from `from` goes through, and where it goes on.
    let through = |from: u32, here: u32| {
        let mut row = rows[here as usize].iter().copied();
        let index = row.find(|index| hinges[*index as usize].outer.contains(&from))?;
        let [a, b] = hinges[index as usize].outer;
        Some((index, if a == from { b } else { a }))
    };
    let mut is_used = vec![false; hinges.len()];
    let mut lines = Vec::new();
    for (hinge, index) in hinges.iter().zip(0..) {
        if is_used[index] {
            continue;
        }
        is_used[index] = true;
        let [first, last] = hinge.outer;
        let mut go = |mut from: u32, mut here: u32| {
            let mut way = vec![here];
            while let Some((index, next)) = through(from, here).filter(|(index, _)| !is_used[*index as usize]) {
                is_used[index as usize] = true;
                (from, here) = (here, next);
                way.push(here);
            }
            way
        };
        let onwards = go(hinge.middle, last);
        let back = go(hinge.middle, first);
        lines.push(BendLine::new(back.into_iter().rev().chain([hinge.middle]).chain(onwards).collect(), &side));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::{BendLine, Hinge, bend_lines};

    /// Hinges at the inner ones of particles in a row; of a ring at all of them.
    fn row(particles: &[u32], is_ring: bool) -> Vec<Hinge> {
        let count = particles.len();
        let places = if is_ring { 0..count } else { 1..count - 1 };
        places
            .map(|k| Hinge {
                outer: [particles[(k + count - 1) % count], particles[(k + 1) % count]],
                middle: particles[k],
            })
            .collect()
    }

    fn lines(mut hinges: Vec<Hinge>) -> Vec<BendLine> {
        // Their order says nothing.
        hinges.reverse();
        hinges.rotate_left(2);
        bend_lines(&hinges, 20, |one, other| Some(f64::from(one.abs_diff(other))))
    }

    fn around(line: &BendLine, middle: usize, side_count: usize) -> Vec<u32> {
        let sides = line.around(middle, side_count);
        (sides.start..=sides.end).map(|place| line.particle(place)).collect()
    }

    #[test]
    fn a_row_is_one_line_and_so_is_a_ring() {
        let found = lines(row(&[3, 1, 4, 5, 9, 2, 6], false));
        assert_eq!(found.len(), 1);
        let mut particles: Vec<u32> = (0..=found[0].side_count()).map(|place| found[0].particle(place)).collect();
        if particles[0] == 6 {
            particles.reverse();
        }
        assert_eq!(particles, [3, 1, 4, 5, 9, 2, 6]);
        assert_eq!(found[0].middles(), 1..6);
        let ring = lines(row(&[0, 1, 2, 3, 4, 5, 6, 7], true));
        assert_eq!(ring.len(), 1);
        assert_eq!((ring[0].side_count(), ring[0].middles()), (8, 0..8));
    }

    #[test]
    fn rows_that_cross_are_two_lines() {
        let found = lines(row(&[0, 1, 2, 3, 4], false).into_iter().chain(row(&[5, 6, 2, 7, 8], false)).collect());
        assert_eq!(found.iter().map(|line| line.side_count()).collect::<Vec<_>>(), [4, 4]);
    }

    #[test]
    fn what_is_around_a_place_lies_beside_it_where_a_row_ends() {
        let found = lines(row(&[0, 1, 2, 3, 4, 5, 6], false));
        let line = &found[0];
        let sorted = |middle, side_count| {
            let mut particles = around(line, middle, side_count);
            particles.sort_unstable();
            particles
        };
        assert_eq!(sorted(3, 4), [1, 2, 3, 4, 5]);
        for (place, near) in [(1, line.particle(0)), (5, line.particle(6))] {
            assert_eq!(around(line, place, 2).len(), 3);
            assert_eq!(sorted(place, 4), if near == 0 { [0, 1, 2, 3, 4] } else { [2, 3, 4, 5, 6] });
        }
        assert_eq!(sorted(3, 40), [0, 1, 2, 3, 4, 5, 6]);
        assert_eq!(line.sums(&(0..6)), [6.0, 6.0]);
    }

    #[test]
    fn what_is_around_a_place_of_a_ring_goes_on_for_less_than_half_of_it() {
        let found = lines(row(&[0, 1, 2, 3, 4, 5, 6, 7], true));
        let line = &found[0];
        for middle in line.middles() {
            let two = around(line, middle, 2);
            assert_eq!((two.len(), two[1]), (3, line.particle(middle)));
            assert!(two.windows(2).all(|pair| [1, 7].contains(&pair[0].abs_diff(pair[1]))), "{two:?}");
            assert_eq!(around(line, middle, 40).len(), 4);
        }
    }
}
