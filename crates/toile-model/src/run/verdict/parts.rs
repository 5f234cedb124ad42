//! The connected parts of a cloth, and the loops in which they end.

use crate::Model;
use crate::mesh::geometry::corners;
use crate::union_find::UnionFind;
use std::collections::BTreeMap;

/// A connected part of a cloth.
#[derive(Debug)]
pub(crate) struct Part {
    /// Its particles, ascending.
    pub(crate) particles: Vec<u32>,
    /// The loops of particles in which it ends: two of a tube, one of a flat piece.
    pub(crate) loops: Vec<Vec<u32>>,
}

/// The connected parts of a model, by their first particle.
pub(crate) fn parts(model: &Model) -> Vec<Part> {
    let mut sets = UnionFind::new(model.positions.len());
    let mut sides: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    for quad in &model.quads {
        let loop_ = corners(quad);
        for (k, &from) in loop_.iter().enumerate() {
            let to = loop_[(k + 1) % loop_.len()];
            sets.unite(from, to);
            *sides.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
    }
    // Seams that are still open hold their panels together.
    for pair in &model.seam_pairs {
        sets.unite(pair.ends[0], pair.ends[1]);
    }
    let mut parts: BTreeMap<u32, Part> = BTreeMap::new();
    for particle in 0..model.particle_count() {
        let part = parts.entry(sets.root(particle)).or_insert(Part { particles: Vec::new(), loops: Vec::new() });
        part.particles.push(particle);
    }
    let border = sides.iter().filter(|(_, count)| **count == 1).map(|(side, _)| *side);
    for loop_ in loops(border) {
        if let Some(part) = parts.get_mut(&sets.root(loop_[0])) {
            part.loops.push(loop_);
        }
    }
    parts.into_values().collect()
}

/// Sides joined end to end. Where two loops meet in a particle, each goes on as it comes.
fn loops(sides: impl Iterator<Item = [u32; 2]>) -> Vec<Vec<u32>> {
    let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for [a, b] in sides {
        next.entry(a).or_default().push(b);
        next.entry(b).or_default().push(a);
    }
    let mut found = Vec::new();
    while let Some(start) = next.iter().find(|(_, ends)| !ends.is_empty()).map(|(start, _)| *start) {
        let mut loop_ = vec![start];
        let mut here = start;
        while let Some(there) = next.get_mut(&here).and_then(Vec::pop) {
            if let Some(back) = next.get_mut(&there) {
                back.retain(|end| *end != here);
            }
            here = there;
            if here == start {
                break;
            }
            loop_.push(here);
        }
        found.push(loop_);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_are_joined_end_to_end() {
        let sides = [[0, 1], [5, 6], [1, 2], [2, 3], [6, 7], [0, 3], [5, 7]];
        let mut found = loops(sides.into_iter());
        found.iter_mut().for_each(|loop_| loop_.sort_unstable());
        assert_eq!(found, [vec![0, 1, 2, 3], vec![5, 6, 7]]);
    }
}
