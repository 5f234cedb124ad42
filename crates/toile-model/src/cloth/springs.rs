//! Springs of flat panels. D §3: structural, shear and bend (the papers' flexion).

use crate::SpringKind;
use crate::mesh::elements::{sectors, sides};
use crate::mesh::fan::opposite_neighbours;
use crate::mesh::geometry::corners;
use glam::DVec2;

/// A spring before it has a stiffness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Role {
    /// The two particles, the lower index first.
    pub(crate) ends: [u32; 2],
    pub(crate) kind: SpringKind,
    /// Vector between them in the flat panel [m]: its length is the rest length.
    pub(crate) flat: DVec2,
}

impl Role {
    pub(crate) fn new(a: u32, b: u32, kind: SpringKind, flat: DVec2) -> Self {
        Self { ends: [a.min(b), a.max(b)], kind, flat }
    }
}

/// The springs of flat meshes, each pair of particles once, sorted by their ends.
///
/// Sides of elements are structural. Diagonals of quads are shear, and so are the opposite corners of two triangles that share a
/// side. Bend springs span two sides that go straight on across a particle. Rest lengths are distances in the flat panel.
pub(crate) fn panel_springs(elements: &[[u32; 4]], flat: &[DVec2]) -> Vec<Role> {
    let role = |a: u32, b: u32, kind| Role::new(a, b, kind, flat[b as usize] - flat[a as usize]);
    let sides = sides(elements, |i| i);
    let mut roles = Vec::with_capacity(6 * flat.len());
    for group in sides.chunk_by(|a, b| a.ends == b.ends) {
        let [a, b] = group[0].ends;
        roles.push(role(a, b, SpringKind::Structural));
        if let [one, other] = group {
            let tip = |element: u32| match corners(&elements[element as usize]) {
                triangle @ [_, _, _] => triangle.iter().copied().find(|c| ![a, b].contains(c)),
                _ => None,
            };
            if let (Some(one), Some(other)) = (tip(one.element), tip(other.element)) {
                roles.push(role(one, other, SpringKind::Shear));
            }
        }
    }
    for element in elements {
        if let &[a, b, c, d] = corners(element) {
            roles.push(role(a, c, SpringKind::Shear));
            roles.push(role(b, d, SpringKind::Shear));
        }
    }
    let sectors = sectors(elements, flat, flat.len(), |i| i);
    for particle in 0..flat.len() {
        for [a, b] in opposite_neighbours(sectors.row(particle)) {
            roles.push(role(a, b, SpringKind::Bend));
        }
    }
    roles.sort_by_key(|r| (r.ends, r.kind));
    roles.dedup_by_key(|r| r.ends);
    roles
}
