//! The mesh of one flat panel.

use crate::mesh::geometry::{angle_range, corners};
use crate::mesh::outline::Outline;
use glam::DVec2;

/// The mesh of one flat panel.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FlatMesh {
    /// Flat positions [m], row by row.
    pub(crate) points: Vec<DVec2>,
    /// Quads and triangles, counter-clockwise in the flat panel.
    pub(crate) elements: Vec<[u32; 4]>,
    /// Particles of each edge of the outline from its start to its end.
    pub(crate) edges: Vec<Vec<u32>>,
    /// Whether the outline runs clockwise: then the outside of the cloth is the back of the flat panel.
    pub(crate) clockwise: bool,
}

impl FlatMesh {
    /// A mesh whose first points are those of the outline, in their order. Particles are renumbered by their place: row,
    /// then position along the row; shape [point_count].
    pub(crate) fn new(points: Vec<DVec2>, elements: Vec<[u32; 4]>, outline: &Outline, places: &[[f64; 2]]) -> Self {
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        order.sort_by(|&a, &b| {
            let ([row_a, along_a], [row_b, along_b]) = (places[a as usize], places[b as usize]);
            row_a.total_cmp(&row_b).then(along_a.total_cmp(&along_b))
        });
        let mut number = vec![0; points.len()];
        for (new, &old) in order.iter().enumerate() {
            number[old as usize] = new as u32;
        }
        let mut elements: Vec<[u32; 4]> = elements
            .iter()
            .map(|element| {
                let loop_: Vec<u32> = corners(element).iter().map(|&i| number[i as usize]).collect();
                smallest_first(&loop_)
            })
            .collect();
        elements.sort_unstable();
        let edges = (0..outline.starts.len())
            .map(|e| outline.edge(e).into_iter().map(|i| number[i as usize]).collect())
            .collect();
        Self {
            points: order.iter().map(|&i| points[i as usize]).collect(),
            elements,
            edges,
            clockwise: outline.is_clockwise(),
        }
    }

    /// Smallest inner angle of any element [degrees].
    pub(crate) fn worst_angle(&self) -> f64 {
        self.elements.iter().map(|e| angle_range(e, &self.points)[0]).fold(180.0, f64::min)
    }
}

/// An element from its three or four corners, turned so that the smallest index comes first.
pub(crate) fn smallest_first(loop_: &[u32]) -> [u32; 4] {
    let start = (0..loop_.len()).min_by_key(|&k| loop_[k]).unwrap_or(0);
    let mut element = [crate::NO_CORNER; 4];
    for (k, corner) in element.iter_mut().enumerate().take(loop_.len()) {
        *corner = loop_[(start + k) % loop_.len()];
    }
    element
}
