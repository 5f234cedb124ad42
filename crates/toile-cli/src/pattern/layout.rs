//! Where the panels lie in the picture.

use super::Pattern;
use glam::Vec2;
use std::collections::BTreeMap;
use toile::model::{Csr, NO_CORNER};

/// Size of a metre of cloth [px].
const SCALE: f32 = 780.0;
/// Distance between panels, and from the border [px].
const GAP: f32 = 24.0;
/// Height of the name of a panel [px].
const NAME: f32 = 20.0;
/// Width of a letter of it [px].
const LETTER: f32 = 8.0;
/// Width of a row of panels as part of the side of a square that they would fill [1].
const SHAPE: f32 = 1.6;
/// Lengths that differ by no more count as the same [1].
const SAME: f32 = 0.01;

/// Where the panels of one cloth lie, row by row.
pub(super) struct Layout {
    /// Places of the particles of the panels [px], shape [particle_count].
    pub(super) places: Vec<Vec2>,
    /// Names of the panels and where they begin.
    pub(super) names: Vec<(Vec2, String)>,
    /// Sides of the panels that nothing is sewn to.
    pub(super) edges: Vec<[u32; 2]>,
    /// Sides of the panels that are sewn, also to one another.
    pub(super) seam_sides: Vec<[u32; 2]>,
    /// Right and lower end [px].
    pub(super) size: Vec2,
    panel_of: Vec<usize>,
    members: Csr<u32>,
}

impl Layout {
    /// The panels below `top` [px].
    pub(super) fn new(pattern: &Pattern, top: f32) -> Self {
        let open = &pattern.open;
        // A sheet counts its rows downward, a panel has y up.
        let turn = if pattern.sewn.is_some() { Vec2::new(SCALE, -SCALE) } else { Vec2::splat(SCALE) };
        let mut places: Vec<Vec2> = open.flat.iter().map(|point| *point * turn).collect();
        let mut panel_of = vec![0; places.len()];
        let mut names = Vec::new();
        let boxes: Vec<[Vec2; 2]> = open
            .panels
            .iter()
            .map(|panel| {
                let points = &places[panel.particles.start as usize..panel.particles.end as usize];
                let around = |[low, high]: [Vec2; 2], point: &Vec2| [low.min(*point), high.max(*point)];
                points.iter().fold([Vec2::INFINITY, Vec2::NEG_INFINITY], around)
            })
            .collect();
        let area: f32 = boxes.iter().map(|[low, high]| (*high - *low + GAP).element_product()).sum();
        let widest = boxes.iter().map(|[low, high]| high.x - low.x).fold(SHAPE * area.sqrt(), f32::max);
        let mut corner = Vec2::new(GAP, top + GAP);
        let mut size = corner;
        for (index, (panel, [low, high])) in open.panels.iter().zip(&boxes).enumerate() {
            let extent = *high - *low;
            if corner.x > GAP && corner.x + extent.x > widest + GAP {
                corner = Vec2::new(GAP, size.y);
            }
            names.push((corner + Vec2::Y * (NAME - 8.0), panel.name.clone()));
            for i in panel.particles.clone() {
                places[i as usize] += corner + Vec2::Y * NAME - *low;
                panel_of[i as usize] = index;
            }
            size = size.max(corner + extent + Vec2::new(GAP, NAME + GAP));
            corner.x += extent.x.max(LETTER * panel.name.len() as f32) + GAP;
        }
        let [edges, seam_sides] = rims(pattern);
        Self { places, names, edges, seam_sides, size, panel_of, members: pattern.merge.members.clone() }
    }

    /// From particle to particle of the sewn cloth, each step within a panel and the shortest that there is; no step where two share no panel.
    /// Along a seam, where both sides are as long, it stays on the side that it is on.
    pub(super) fn steps(&self, particles: &[u32]) -> Vec<[u32; 2]> {
        let mut here = None;
        let step = |pair: &[u32]| {
            let [from, to] = [pair[0], pair[1]].map(|particle| self.members.row(particle as usize));
            let all = from.iter().flat_map(|a| to.iter().map(move |b| [*a, *b]));
            let key = |step: &[u32; 2]| self.way(*step).length() * if here == Some(step[0]) { 1.0 - SAME } else { 1.0 };
            let step = all
                .filter(|[a, b]| self.panel_of[*a as usize] == self.panel_of[*b as usize])
                .min_by(|a, b| key(a).total_cmp(&key(b)));
            here = step.map(|step| step[1]);
            step
        };
        particles.windows(2).filter_map(step).collect()
    }

    /// Where a particle of the sewn cloth is [px], once for each particle of the panels that it is.
    pub(super) fn places_of(&self, particle: u32) -> impl Iterator<Item = Vec2> {
        self.members.row(particle as usize).iter().map(|member| self.places[*member as usize])
    }

    /// From one particle of the panels to another [px].
    pub(super) fn way(&self, [from, to]: [u32; 2]) -> Vec2 {
        self.places[to as usize] - self.places[from as usize]
    }
}

/// The sides around the panels: those that stay open, and those that are sewn.
fn rims(pattern: &Pattern) -> [Vec<[u32; 2]>; 2] {
    let open = &pattern.open;
    let mut member_of = vec![0; open.positions.len()];
    for row in 0..pattern.merge.members.row_count() {
        pattern.merge.members.row(row).iter().for_each(|i| member_of[*i as usize] = row as u32);
    }
    let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let mut open_counts: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    for quad in &open.quads {
        let corners = if quad[3] == NO_CORNER { &quad[..3] } else { &quad[..] };
        for (k, corner) in corners.iter().enumerate() {
            *open_counts.entry(sorted([*corner, corners[(k + 1) % corners.len()]])).or_default() += 1;
        }
    }
    let rim = || open_counts.iter().filter(|(_, count)| **count == 1).map(|(side, _)| *side);
    let sewn = |side: [u32; 2]| sorted(side.map(|end| member_of[end as usize]));
    let mut sewn_counts: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    rim().for_each(|side| *sewn_counts.entry(sewn(side)).or_default() += 1);
    let (edges, seams) = rim().partition(|side| sewn_counts[&sewn(*side)] == 1);
    [edges, seams]
}
