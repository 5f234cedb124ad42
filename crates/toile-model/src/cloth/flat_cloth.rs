//! The flat panels that a cloth is made of.

use crate::mesh::elements::sides;
use crate::{Csr, PanelMesh};
use glam::DVec2;
use toile_scene::Threshold;

/// Flat panels and which of their particles are one.
pub(crate) struct Cloth<'a> {
    /// Elements of all panels.
    pub(crate) elements: &'a [[u32; 4]],
    /// Panel of each element.
    pub(crate) panels: Vec<u32>,
    /// Flat positions [m].
    pub(crate) flat: &'a [DVec2],
    /// The particle of the sewn cloth that each particle of the panels is.
    pub(crate) member_of: &'a [u32],
    /// Number of particles of the sewn cloth.
    pub(crate) particle_count: usize,
    /// Elongation that the fabric allows, by direction.
    pub(crate) threshold: Threshold,
}

impl<'a> Cloth<'a> {
    /// The panels of an open model, and the particles of the cloth that theirs become.
    pub(crate) fn new(
        elements: &'a [[u32; 4]],
        panels: &[PanelMesh],
        flat: &'a [DVec2],
        member_of: &'a [u32],
        particle_count: usize,
        threshold: Threshold,
    ) -> Self {
        let panels = panels.iter().zip(0..).flat_map(|(mesh, panel)| mesh.quads.clone().map(move |_| panel)).collect();
        Self { elements, panels, flat, member_of, particle_count, threshold }
    }

    /// Open sides of the elements of each panel, as flat particles.
    pub(crate) fn rims(&self) -> Csr<[u32; 2]> {
        let panel_count = self.panels.iter().max().map_or(0, |last| last + 1);
        let mut rows = vec![Vec::new(); panel_count as usize];
        for group in sides(self.elements, |i| i).chunk_by(|a, b| a.ends == b.ends) {
            if let [side] = group {
                rows[self.panels[side.element as usize] as usize].push(side.ends);
            }
        }
        Csr::from_rows(rows)
    }

    /// Whether the straight line between two points of a panel stays inside, when a way of so many metres does.
    pub(crate) fn is_inside(&self, panel: u32, [a, b]: [DVec2; 2], way: f64, rims: &Csr<[u32; 2]>) -> bool {
        if way <= a.distance(b) * (1.0 + 1e-9) {
            return true;
        }
        let middle = a.midpoint(b);
        let mut crossings = 0;
        let mut is_on_rim = false;
        for ends in rims.row(panel as usize) {
            let [p, q] = ends.map(|i| self.flat[i as usize]);
            let side = |u: DVec2, v: DVec2, w: DVec2| (v - u).perp_dot(w - u);
            let crosses = side(a, b, p) * side(a, b, q) < 0.0 && side(p, q, a) * side(p, q, b) < 0.0;
            if crosses {
                return false;
            }
            is_on_rim |= (p.distance(middle) + middle.distance(q)) <= p.distance(q) * (1.0 + 1e-9);
            if (p.y > middle.y) != (q.y > middle.y) {
                let x = p.x + (middle.y - p.y) / (q.y - p.y) * (q.x - p.x);
                crossings += u32::from(x > middle.x);
            }
        }
        is_on_rim || crossings % 2 == 1
    }
}
