//! Bending rigidity: bend springs that push, and structural springs that hold against them.

use crate::cloth::bend_lines::{BendLine, Hinge, bend_lines};
use crate::{Arrays, Csr, Link, SpringKind};
use std::collections::HashMap;
use std::ops::Range;

/// What the push may add to (ω·dt)², by Gershgorin's bound. The springs have up to 1.6² of the 4 that are stable, most of it along
/// the cloth; the push works across it.
const RATE_PER_STEP_SQUARED: f64 = 2.56;

/// Part of a step that springs by themselves ask for which a scene takes at most: the default safety factor.
const SAFETY: f64 = 0.8;

/// Longest arch [m]. Of waves of 12 cm, in which cloth hangs, it feels three fifths of what a short one does.
const ARCH_MAX: f64 = 0.08;

/// Sides one after the other on a line, across all of which one bend spring pushes, while each of them pulls.
struct Arch {
    line: usize,
    /// Their places on it.
    sides: Range<usize>,
    /// The places of the hinges whose bending it holds.
    middles: Range<usize>,
    /// Mass of the cloth around these [kg].
    mass: f64,
    /// Force of its bend spring, and of its sides [N].
    push: f64,
}

impl Arrays {
    /// Gives the cloth its bending rigidity B: [`Arrays::bending`] is B by areal density.
    ///
    /// An axial spring across an arch resists bending at second order only: where the arch has the curvature κ, the spring is shorter than
    /// the sides together by κ²·(L³ - Σa³)/24, with sides a and their sum L. So its energy grows as κ⁴ and there is no rigidity at κ = 0.
    /// When it pushes with the force P, and the sides pull with P each, so that the flat cloth is at rest, the energy is P times that:
    /// quadratic in κ. Cloth of the area A has ½·B·A·κ²; both are equal for P = 12·B·A/(L³ - Σa³).
    ///
    /// The push is bounded by what the step carries, as the stiffness of the springs is. Small cells carry little across two sides, and
    /// across n sides (n² - 1)/3 times as much: arches have as many as they need.
    pub(crate) fn add_bending(&mut self) {
        self.bending_carried = 1.0;
        if self.bending == 0.0 {
            return;
        }
        let hinges = self.hinges();
        let lines = bend_lines(&hinges, self.positions.len(), |one, other| self.side(one, other));
        let mut arches = self.arches(&lines, 2);
        let mut carried = self.carried(&lines, &arches);
        let side_count = side_count(&lines, &carried);
        if side_count > 2 {
            arches = self.arches(&lines, side_count);
            carried = self.carried(&lines, &arches);
        }
        let whole: f64 = arches.iter().map(|arch| arch.mass).sum();
        if whole > 0.0 {
            self.bending_carried =
                arches.iter().zip(&carried).map(|(arch, part)| arch.mass * part).sum::<f64>() / whole;
        }
        arches.iter_mut().zip(carried).for_each(|(arch, part)| arch.push *= part);
        if side_count > 2 {
            self.span(&hinges, &lines, &arches);
        }
        self.draw(&lines, &arches);
    }

    /// Every bend spring with the particle that it spans, where all three springs have a stiffness.
    fn hinges(&self) -> Vec<Hinge> {
        let springs = self.springs.iter().filter(|s| s.kind == SpringKind::Bend && s.stiffness > 0.0);
        springs
            .filter_map(|spring| {
                let [a, b] = spring.ends;
                let way = |middle: u32| Some(self.side(a, middle)? + self.side(middle, b)?);
                let neighbours = self.links.row(a as usize).iter().map(|link| link.other);
                let excess = |way: f64| (way - f64::from(spring.rest_length)).abs();
                let (middle, _) = neighbours
                    .filter_map(|middle| Some((middle, way(middle)?)))
                    .min_by(|one, other| excess(one.1).total_cmp(&excess(other.1)))?;
                Some(Hinge { outer: [a, b], middle })
            })
            .collect()
    }

    /// Length of a structural spring that has a stiffness [m].
    fn side(&self, one: u32, other: u32) -> Option<f64> {
        let ends = [one.min(other), one.max(other)];
        let spring = &self.springs[self.springs.binary_search_by_key(&ends, |s| s.ends).ok()?];
        let is_side = spring.kind == SpringKind::Structural && spring.stiffness > 0.0;
        is_side.then(|| f64::from(spring.rest_length))
    }

    /// Around every hinge the arch of so many sides, or of as many as there are. Where a line ends it lies beside its hinge, and holds what all those
    /// would that lie there.
    fn arches(&self, lines: &[BendLine], side_count: usize) -> Vec<Arch> {
        let mut arches: Vec<Arch> = Vec::with_capacity(lines.iter().map(|line| line.middles().len()).sum());
        for (index, line) in lines.iter().enumerate() {
            let first_arch = arches.len();
            for middle in line.middles() {
                let mass = f64::from(self.masses[line.particle(middle) as usize]);
                let sides = self.unlinked(line, line.around(middle, side_count));
                match arches[first_arch..].last_mut().filter(|last| last.sides == sides) {
                    Some(last) => {
                        last.middles.end += 1;
                        last.mass += mass;
                    }
                    None => {
                        arches.push(Arch { line: index, sides, middles: middle..middle + 1, mass, push: 0.0 });
                    }
                }
            }
        }
        for arch in &mut arches {
            let [length, cubes] = lines[arch.line].sums(&arch.sides);
            arch.push = 12.0 * self.bending * arch.mass / (length.powi(3) - cubes);
        }
        arches
    }

    /// So many sides from a place on, less where another spring already joins their ends.
    fn unlinked(&self, line: &BendLine, mut sides: Range<usize>) -> Range<usize> {
        let is_linked = |a: u32, b: u32| self.links.row(a as usize).iter().any(|link| link.other == b);
        while sides.len() > 2 && is_linked(line.particle(sides.start), line.particle(sides.end)) {
            sides.end -= 1;
        }
        sides
    }

    /// Part of its push that each arch may have where particles are too light for it [1]: a force F along a link of the length L resists a motion
    /// across it like a stiffness F/L.
    fn carried(&self, lines: &[BendLine], arches: &[Arch]) -> Vec<f64> {
        let mut stiffness = vec![0.0; self.positions.len()];
        for (line, pulls) in lines.iter().zip(pulls(lines, arches)) {
            for (place, pull) in pulls.into_iter().enumerate() {
                for end in [place, place + 1] {
                    stiffness[line.particle(end) as usize] += pull / line.side(place);
                }
            }
        }
        for arch in arches {
            let [length, _] = lines[arch.line].sums(&arch.sides);
            for end in arch.ends(lines) {
                stiffness[end as usize] += arch.push / length;
            }
        }
        let rate = |i: usize, stiffness: f64| 2.0 * stiffness * f64::from(self.inverse_masses[i]);
        let own = (0..self.positions.len()).map(|i| {
            let sum: f64 = self.links.row(i).iter().map(|link| f64::from(link.stiffness)).sum();
            rate(i, sum)
        });
        let step = 2.0 * SAFETY / own.fold(0.0, f64::max).sqrt();
        let step = self.step_wanted.map_or(step, |wanted| wanted.min(step));
        let allowed = RATE_PER_STEP_SQUARED / (step * step);
        let part = |particle: u32| {
            let i = particle as usize;
            (allowed / rate(i, stiffness[i])).min(1.0)
        };
        let least = |arch: &Arch| {
            let places = arch.sides.start..=arch.sides.end;
            places.map(|place| part(lines[arch.line].particle(place))).fold(1.0, f64::min)
        };
        arches.iter().map(least).collect()
    }

    /// Puts a bend spring across each arch, in place of those across its hinges. What it has no use for stays without a stiffness: a cloth has as many
    /// links whatever its rigidity is.
    fn span(&mut self, hinges: &[Hinge], lines: &[BendLine], arches: &[Arch]) {
        let mut rows: Vec<Vec<Link>> = (0..self.links.row_count()).map(|i| self.links.row(i).to_vec()).collect();
        for Hinge { outer: [a, b], .. } in hinges {
            rows[*a as usize].retain(|link| link.other != *b);
            rows[*b as usize].retain(|link| link.other != *a);
        }
        let mut join = |[a, b]: [u32; 2], length: f64, stiffness: f64| {
            for (here, other) in [(a, b), (b, a)] {
                let link = Link { other, rest_length: length as f32, stiffness: stiffness as f32 };
                rows[here as usize].push(link);
            }
        };
        let mut spanned = HashMap::new();
        for (arch, index) in arches.iter().zip(0..) {
            // Lines that cross twice may have two arches between the same particles.
            let is_first = *spanned.entry(arch.ends(lines)).or_insert(index) == index;
            if is_first {
                let [length, _] = lines[arch.line].sums(&arch.sides);
                // No stiffer than what it pushes with, so that it does not stretch the cloth either.
                join(arch.ends(lines), length, arch.push / length);
            }
        }
        for (arch, index) in arches.iter().zip(0..) {
            let line = &lines[arch.line];
            let used = usize::from(spanned[&arch.ends(lines)] == index);
            for middle in arch.middles.clone().skip(used) {
                let (outer, length) = line.hinge(middle);
                join(outer, length, 0.0);
            }
        }
        self.links = Csr::from_rows(rows);
    }

    /// Has bend springs push and sides pull.
    fn draw(&mut self, lines: &[BendLine], arches: &[Arch]) {
        let pushes = arches.iter().map(|arch| (arch.ends(lines), -arch.push)).collect::<Vec<_>>();
        let pulls = pulls(lines, arches);
        let pulls = lines.iter().zip(&pulls).flat_map(|(line, pulls)| {
            pulls.iter().enumerate().map(|(place, pull)| ([place, place + 1].map(|end| line.particle(end)), *pull))
        });
        let mut forces = vec![0.0; self.links.values.len()];
        for ([a, b], force) in pushes.into_iter().chain(pulls) {
            for (from, to) in [(a, b), (b, a)] {
                let mut row = self.links.range(from as usize);
                let link = row.find(|k| self.links.values[*k as usize].other == to).expect("a spring joins them");
                forces[link as usize] += force;
            }
        }
        for (link, force) in self.links.values.iter_mut().zip(forces).filter(|(_, force)| *force != 0.0) {
            link.rest_length = (f64::from(link.rest_length) - force / f64::from(link.stiffness)) as f32;
        }
    }
}

impl Arch {
    /// The particles that its bend spring joins, the lower index first.
    fn ends(&self, lines: &[BendLine]) -> [u32; 2] {
        let [a, b] = [self.sides.start, self.sides.end].map(|place| lines[self.line].particle(place));
        [a.min(b), a.max(b)]
    }
}

/// Force with which each side of each line pulls [N].
fn pulls(lines: &[BendLine], arches: &[Arch]) -> Vec<Vec<f64>> {
    let mut pulls: Vec<Vec<f64>> = lines.iter().map(|line| vec![0.0; line.side_count()]).collect();
    for Arch { line, sides, push, .. } in arches {
        let pulls = &mut pulls[*line];
        let all = pulls.len();
        sides.clone().for_each(|place| pulls[place % all] += push);
    }
    pulls
}

/// How many sides arches need, so that most of the cloth bends as it should; of arches of two the step carries such parts [1].
fn side_count(lines: &[BendLine], carried: &[f64]) -> usize {
    let middle = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values.get(values.len() / 2).copied()
    };
    let sides = lines.iter().flat_map(|line| (0..line.side_count()).map(|place| line.side(place))).collect();
    let (Some(side), Some(carried)) = (middle(sides), middle(carried.to_vec())) else { return 2 };
    let needed = (3.0 / carried + 1.0).sqrt() / 2.0;
    // What is short by a thousandth needs no more.
    2 * (needed - 1e-3).ceil().min(ARCH_MAX / 2.0 / side).max(1.0) as usize
}
