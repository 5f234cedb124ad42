//! Bending rigidity: bend springs that push, and structural springs that hold against them.

use crate::{Arrays, Link, SpringKind};
use std::collections::BTreeMap;

/// What the push may add to (ω·dt)², by Gershgorin's bound. The springs have up to 1.6² of the 4 that are stable, most of it along
/// the cloth; the push works across it.
const RATE_PER_STEP_SQUARED: f64 = 2.56;

/// Part of a step that springs by themselves ask for which a scene takes at most: the default safety factor.
const SAFETY: f64 = 0.8;

/// Three particles in a line, with a bend spring between the outer ones.
struct Hinge {
    outer: [u32; 2],
    middle: u32,
    /// Force with which the bend spring pushes the outer particles apart [N].
    push: f64,
}

impl Arrays {
    /// Gives the cloth its bending rigidity B: [`Arrays::bending`] is B by areal density.
    ///
    /// An axial spring across a hinge of two cells resists bending at second order only: with sides a and b and the angle θ between
    /// them its length changes by a·b·θ²/(2(a + b)), so its energy grows as θ⁴ and there is no rigidity at θ = 0. When it pushes with
    /// the force P, and the two sides pull with P each, so that the flat cloth is at rest, the energy is P times that change: quadratic
    /// in θ. A strip of the width w has ½·B·w·κ² per length; with κ = 2θ/(a + b) both are equal for P = 2·B·w/(a·b).
    ///
    /// The push is bounded by what the step carries, as the stiffness of the springs is; gives the smallest part of the rigidity
    /// that is left anywhere.
    pub(crate) fn add_bending(&mut self) {
        self.bending_carried = 1.0;
        let is_stiff = self.bending > 0.0;
        if !is_stiff {
            return;
        }
        let mut hinges = self.hinges();
        self.bound(&mut hinges);
        let mut forces: BTreeMap<[u32; 2], f64> = BTreeMap::new();
        for Hinge { outer: [a, b], middle, push } in &hinges {
            *forces.entry(ordered(*a, *b)).or_default() -= push;
            for end in [a, b] {
                *forces.entry(ordered(*end, *middle)).or_default() += push;
            }
        }
        for i in 0..self.positions.len() {
            for k in self.links.range(i) {
                let link = &mut self.links.values[k as usize];
                if let Some(force) = forces.get(&ordered(i as u32, link.other)) {
                    link.rest_length = (f64::from(link.rest_length) - force / f64::from(link.stiffness)) as f32;
                }
            }
        }
    }

    /// Every bend spring with the particle that it spans, where all three springs have a stiffness.
    fn hinges(&self) -> Vec<Hinge> {
        let springs = self.springs.iter().filter(|s| s.kind == SpringKind::Bend);
        springs
            .filter_map(|spring| {
                let [a, b] = spring.ends;
                let length = |one: u32, other: u32| {
                    let link = self.structural_link(one, other)?;
                    Some(f64::from(link.rest_length))
                };
                let sides = |middle: u32| Some([length(a, middle)?, length(middle, b)?]);
                let neighbours = self.links.row(a as usize).iter().map(|link| link.other);
                let excess = |[a, b]: [f64; 2]| (a + b - f64::from(spring.rest_length)).abs();
                let (middle, [a_side, b_side]) = neighbours
                    .filter_map(|middle| Some((middle, sides(middle)?)))
                    .min_by(|one, other| excess(one.1).total_cmp(&excess(other.1)))?;
                // The strip is as wide as the middle particle's share of the cloth is by its length.
                let mass = f64::from(self.masses[middle as usize]);
                let push = 4.0 * self.bending * mass / (a_side * b_side * (a_side + b_side));
                (spring.stiffness > 0.0).then_some(Hinge { outer: [a, b], middle, push })
            })
            .collect()
    }

    /// The link of a structural spring that has a stiffness.
    fn structural_link(&self, one: u32, other: u32) -> Option<&Link> {
        let ends = ordered(one, other);
        let at = self.springs.binary_search_by_key(&ends, |s| s.ends).ok()?;
        let is_one = self.springs[at].kind == SpringKind::Structural && self.springs[at].stiffness > 0.0;
        self.links.row(one as usize).iter().find(|link| is_one && link.other == other)
    }

    /// Weakens the push where the particles are too light for it: a force F along a link of the length L resists a motion across it
    /// like a stiffness F/L.
    fn bound(&mut self, hinges: &mut [Hinge]) {
        let mut stiffness = vec![0.0; self.positions.len()];
        for Hinge { outer, middle, push } in &*hinges {
            let [a, b] = outer.map(|end| self.structural_link(end, *middle).map_or(1.0, |l| f64::from(l.rest_length)));
            let across = push / (a + b);
            stiffness[outer[0] as usize] += push / a + across;
            stiffness[outer[1] as usize] += push / b + across;
            stiffness[*middle as usize] += push / a + push / b;
        }
        let rate = |i: usize, stiffness: f64| 2.0 * stiffness * f64::from(self.inverse_masses[i]);
        let own = (0..self.positions.len()).map(|i| {
            let sum: f64 = self.links.row(i).iter().map(|link| f64::from(link.stiffness)).sum();
            rate(i, sum)
        });
        let step = 2.0 * SAFETY / own.fold(0.0, f64::max).sqrt();
        let step = self.step_wanted.map_or(step, |wanted| wanted.min(step));
        let allowed = RATE_PER_STEP_SQUARED / (step * step);
        let carried: Vec<f64> =
            stiffness.iter().enumerate().map(|(i, stiffness)| (allowed / rate(i, *stiffness)).min(1.0)).collect();
        for hinge in hinges {
            let part = hinge.outer.into_iter().chain([hinge.middle]).map(|i| carried[i as usize]).fold(1.0, f64::min);
            hinge.push *= part;
            self.bending_carried = self.bending_carried.min(part);
        }
    }
}

fn ordered(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
