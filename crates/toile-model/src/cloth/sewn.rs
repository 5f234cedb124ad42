//! The sewn model: the particles of each seam pair are one.

use crate::cloth::flat_cloth::Cloth;
use crate::mesh::elements::{Side, sectors, sides};
use crate::mesh::fan::opposite_neighbours;
use crate::mesh::flat_mesh::smallest_first;
use crate::mesh::geometry::corners;
use crate::union_find::UnionFind;
use crate::{Arrays, Csr, Hold, Merge, Model, PanelMesh, Spring, SpringKind};
use glam::{DVec2, DVec3};
use std::collections::BTreeSet;
use toile_scene::Rule;

impl Model {
    /// The model with the particles of each seam pair made one, and which particles of this model each of them was.
    ///
    /// Masses add up; a merged particle starts at the mean of its members weighted by mass, and is pinned when one of them is.
    /// Springs between the same two particles are one: their stiffness adds up and the shorter rest length holds, so
    /// the longer side of a seam is gathered. Shear and bend springs across the seams are added. Held edges stay held while the garment eases.
    pub fn sewn(&self) -> (Self, Merge) {
        let (member_of, merge) = self.merge();
        let count = merge.members.row_count();
        let mut model = Arrays {
            threshold: self.threshold,
            rule: self.rule,
            stiffness: self.stiffness,
            bending: self.bending,
            step_wanted: self.step_wanted,
            ..Arrays::default()
        };
        for row in 0..count {
            let members = merge.members.row(row);
            let mass: f64 = members.iter().map(|&i| f64::from(self.masses[i as usize])).sum();
            let moment: DVec3 = members
                .iter()
                .map(|&i| self.positions[i as usize].as_dvec3() * f64::from(self.masses[i as usize]))
                .sum();
            let pinned = members.iter().any(|&i| self.inverse_masses[i as usize] == 0.0);
            model.positions.push((moment / mass).as_vec3());
            model.masses.push(mass as f32);
            model.inverse_masses.push(if pinned { 0.0 } else { (1.0 / mass) as f32 });
            model.flat.push(self.flat[members[0] as usize]);
        }
        model.springs = self.sewn_springs(&member_of, &merge);
        (model.holds, model.held_particles) = self.sewn_holds(&member_of);
        (model.quads, model.panels) = self.sewn_quads(&member_of);
        if self.rule == Rule::Hierarchical {
            let flat: Vec<DVec2> = self.flat.iter().map(|p| p.as_dvec2()).collect();
            let cloth = Cloth::new(&self.quads, &self.panels, &flat, &member_of, count, self.threshold);
            model.add_levels(&cloth);
        }
        let mut model = model.complete();
        model.add_bending();
        (Self::of(model), merge)
    }

    /// The lines of cloth that this model has once sewn by a merge, as particles of that one; a ring is cut once, and a short line lies across.
    pub(crate) fn lines_when_sewn(&self, merge: &Merge) -> Vec<Vec<u32>> {
        let flat: Vec<DVec2> = self.flat.iter().map(|p| p.as_dvec2()).collect();
        let mut member_of = vec![0; self.positions.len()];
        for (row, particle) in (0..merge.members.row_count()).zip(0..) {
            merge.members.row(row).iter().for_each(|&member| member_of[member as usize] = particle);
        }
        let count = merge.members.row_count();
        let cloth = Cloth::new(&self.quads, &self.panels, &flat, &member_of, count, self.threshold);
        let lines = [cloth.side_lines(), cloth.diagonal_lines()];
        lines.iter().flat_map(|lines| lines.cut(1)).map(|line| line.particles).collect()
    }

    /// For each particle the one it becomes, and the other way round. Merged particles stand where their first member stood.
    fn merge(&self) -> (Vec<u32>, Merge) {
        let mut sets = UnionFind::new(self.positions.len());
        for pair in &self.seam_pairs {
            sets.unite(pair.ends[0], pair.ends[1]);
        }
        let mut rows: Vec<Vec<u32>> = Vec::new();
        let mut member_of = vec![0; self.positions.len()];
        for particle in 0..self.particle_count() {
            let root = sets.root(particle);
            if root == particle {
                member_of[particle as usize] = rows.len() as u32;
                rows.push(Vec::new());
            } else {
                member_of[particle as usize] = member_of[root as usize];
            }
            rows[member_of[particle as usize] as usize].push(particle);
        }
        (member_of, Merge { members: Csr::from_rows(rows) })
    }

    fn sewn_springs(&self, member_of: &[u32], merge: &Merge) -> Vec<Spring> {
        let mut springs: Vec<Spring> = self
            .springs
            .iter()
            .filter(|s| s.kind != SpringKind::Seam)
            .map(|s| {
                let [a, b] = s.ends.map(|i| member_of[i as usize]);
                Spring { ends: [a.min(b), a.max(b)], ..*s }
            })
            .filter(|s| s.ends[0] != s.ends[1])
            .collect();
        springs.sort_by_key(|s| (s.ends, s.kind));
        let mut springs: Vec<Spring> = springs.chunk_by(|a, b| a.ends == b.ends).map(one_spring).collect();
        let mut across = self.shear_across(member_of);
        across.extend(self.bend_across(member_of, merge, &springs));
        springs.extend(across);
        springs.sort_by_key(|s| s.ends);
        // The sort is stable: where a panel has a spring already, that one comes first and stays.
        springs.dedup_by_key(|s| s.ends);
        springs
    }

    /// Between the tips of two triangles on both sides of a seam, unfolded along it.
    fn shear_across(&self, member_of: &[u32]) -> Vec<Spring> {
        let sides = sides(&self.quads, |i| member_of[i as usize]);
        let mut result = Vec::new();
        for group in sides.chunk_by(|a, b| a.ends == b.ends) {
            let [one, other] = group else { continue };
            let (Some(one), Some(other)) = (self.unfolded(one, member_of), self.unfolded(other, member_of)) else {
                continue;
            };
            // Both sides of a seam are one panel edge's length long where it is not gathered; the shorter one rules.
            let length = one.length.min(other.length);
            let a = DVec2::new(one.along * length, one.height);
            let b = DVec2::new(other.along * length, -other.height);
            let [tip, opposite] = [one.tip, other.tip].map(|i| member_of[i as usize]);
            if one.edge != other.edge && tip != opposite {
                result.push(self.spring(tip, opposite, SpringKind::Shear, a.distance(b)));
            }
        }
        result
    }

    /// A triangle as its side in the seam sees it; `None` for a quad.
    fn unfolded(&self, side: &Side, member_of: &[u32]) -> Option<Unfolded> {
        let &[a, b, c] = corners(&self.quads[side.element as usize]) else { return None };
        let triangle = [a, b, c];
        let k = side.corner as usize;
        let [mut from, mut to, tip] = [k, k + 1, k + 2].map(|j| triangle[j % 3]);
        if member_of[from as usize] != side.ends[0] {
            (from, to) = (to, from);
        }
        let [p, q, r] = [from, to, tip].map(|i| self.flat[i as usize].as_dvec2());
        let length = p.distance(q);
        Some(Unfolded {
            edge: [from.min(to), from.max(to)],
            tip,
            length,
            along: (r - p).dot(q - p) / (length * length),
            height: (q - p).perp_dot(r - p).abs() / length,
        })
    }

    /// Across merged particles, from one panel to the other; as long as the two flat pieces together.
    fn bend_across(&self, member_of: &[u32], merge: &Merge, springs: &[Spring]) -> Vec<Spring> {
        let flat: Vec<DVec2> = self.flat.iter().map(|p| p.as_dvec2()).collect();
        let count = merge.members.row_count();
        let sectors = sectors(&self.quads, &flat, count, |i| member_of[i as usize]);
        let rest = |a: u32, b: u32| {
            let ends = [a.min(b), a.max(b)];
            springs.binary_search_by_key(&ends, |s| s.ends).ok().map(|k| f64::from(springs[k].rest_length))
        };
        (0..count)
            .filter(|&particle| merge.members.row(particle).len() > 1)
            .flat_map(|particle| {
                opposite_neighbours(sectors.row(particle)).into_iter().map(move |pair| (particle as u32, pair))
            })
            .filter_map(|(particle, [a, b])| {
                Some(self.spring(a, b, SpringKind::Bend, rest(a, particle)? + rest(particle, b)?))
            })
            .collect()
    }

    /// A spring across a seam, where the grain turns: the smallest threshold holds.
    fn spring(&self, a: u32, b: u32, kind: SpringKind, rest_length: f64) -> Spring {
        Spring {
            ends: [a.min(b), a.max(b)],
            rest_length: rest_length as f32,
            stiffness: self.stiffness[kind as usize],
            threshold: self.threshold.least() as f32,
            kind,
        }
    }

    /// Quads between merged particles, and their ranges by panel. What collapses to fewer than three corners is gone.
    fn sewn_quads(&self, member_of: &[u32]) -> (Vec<[u32; 4]>, Vec<PanelMesh>) {
        let mut quads = Vec::with_capacity(self.quads.len());
        let mut panels = Vec::with_capacity(self.panels.len());
        for panel in &self.panels {
            let first = quads.len() as u32;
            for quad in &self.quads[panel.quads.start as usize..panel.quads.end as usize] {
                let mut loop_: Vec<u32> = corners(quad).iter().map(|&i| member_of[i as usize]).collect();
                loop_.dedup();
                if loop_.len() > 1 && loop_[0] == loop_[loop_.len() - 1] {
                    loop_.pop();
                }
                if loop_.len() > 2 {
                    quads.push(smallest_first(&loop_));
                }
            }
            panels.push(PanelMesh { particles: 0..0, quads: first..quads.len() as u32, ..panel.clone() });
        }
        (quads, panels)
    }
}

impl Model {
    /// The holds with merged particles, each in the first hold that has it.
    fn sewn_holds(&self, member_of: &[u32]) -> (Vec<Hold>, Vec<u32>) {
        let mut taken = BTreeSet::new();
        let mut holds = Vec::new();
        let mut held_particles = Vec::new();
        for hold in &self.holds {
            let members = &self.held_particles[hold.particles.start as usize..hold.particles.end as usize];
            let first = held_particles.len() as u32;
            held_particles.extend(members.iter().map(|&m| member_of[m as usize]).filter(|&p| taken.insert(p)));
            let particles = first..held_particles.len() as u32;
            if !particles.is_empty() {
                holds.push(Hold { particles, ..hold.clone() });
            }
        }
        (holds, held_particles)
    }
}

impl Merge {
    /// Every particle stays what it is: the handover between stages of the same model.
    pub fn identity(particle_count: u32) -> Self {
        Self { members: Csr::from_rows((0..particle_count).map(|i| [i])) }
    }
}

/// A triangle as its side in a seam sees it.
struct Unfolded {
    /// Its side in the open model.
    edge: [u32; 2],
    /// Its third corner in the open model.
    tip: u32,
    /// Flat length of the side [m].
    length: f64,
    /// Foot of the tip along the side [1].
    along: f64,
    /// Distance of the tip from the side [m].
    height: f64,
}

/// One spring for several between the same two particles, sorted by kind: the strongest role, and of those that have it the
/// stiffness of all, and the rest length of the shortest and the threshold of the tightest.
fn one_spring(group: &[Spring]) -> Spring {
    let same = group.iter().filter(|s| s.kind == group[0].kind);
    Spring {
        stiffness: same.clone().map(|s| s.stiffness).sum(),
        rest_length: same.clone().map(|s| s.rest_length).fold(f32::INFINITY, f32::min),
        threshold: same.map(|s| s.threshold).fold(f32::INFINITY, f32::min),
        ..group[0]
    }
}
