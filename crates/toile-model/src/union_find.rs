//! Sets of indices that grow together.

/// Sets of indices that grow together. The representative of a set is its smallest member, so it does not depend on the
/// order of the unions.
pub(crate) struct UnionFind {
    parents: Vec<u32>,
}

impl UnionFind {
    /// `count` sets of one index each.
    pub(crate) fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect() }
    }

    /// Smallest index in the set of `index`.
    pub(crate) fn root(&mut self, index: u32) -> u32 {
        let mut root = index;
        while self.parents[root as usize] != root {
            root = self.parents[root as usize];
        }
        let mut next = index;
        while next != root {
            next = std::mem::replace(&mut self.parents[next as usize], root);
        }
        root
    }

    /// Makes the sets of `a` and `b` one.
    pub(crate) fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_member_represents_a_set_whatever_the_order() {
        let mut sets = UnionFind::new(6);
        for (a, b) in [(5, 4), (4, 2), (3, 5)] {
            sets.unite(a, b);
        }
        let roots: Vec<u32> = (0..6).map(|i| sets.root(i)).collect();
        assert_eq!(roots, [0, 1, 2, 2, 2, 2]);
    }
}
