//! Sets of numbers that are joined: which belong together.

/// The sets, each known by its smallest number.
pub(crate) struct Disjoint {
    /// A number of the same set that is no larger.
    lower: Vec<u32>,
}

impl Disjoint {
    /// So many sets of one number each.
    pub fn of(count: usize) -> Self {
        Self { lower: (0..count as u32).collect() }
    }

    pub fn smallest(&mut self, mut number: u32) -> u32 {
        while self.lower[number as usize] != number {
            let next = self.lower[self.lower[number as usize] as usize];
            self.lower[number as usize] = next;
            number = next;
        }
        number
    }

    pub fn join(&mut self, a: u32, b: u32) {
        let [a, b] = [self.smallest(a), self.smallest(b)];
        self.lower[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::Disjoint;

    #[test]
    fn what_is_joined_has_one_smallest_number() {
        let mut sets = Disjoint::of(7);
        for [a, b] in [[5, 6], [3, 4], [4, 5], [1, 2], [2, 1]] {
            sets.join(a, b);
        }
        let smallest: Vec<u32> = (0..7).map(|number| sets.smallest(number)).collect();
        assert_eq!(smallest, [0, 1, 1, 3, 3, 3, 3]);
    }
}
