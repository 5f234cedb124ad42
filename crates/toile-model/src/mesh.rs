//! Flat meshes of panels: particles along the outlines, a grid or a lattice between them, and who is next to whom.

pub(crate) mod elements;
pub(crate) mod fan;
pub(crate) mod flat_mesh;
pub(crate) mod geometry;
mod grid;
pub(crate) mod inside;
mod lattice;
mod outline;
mod rectangle;
mod rim;
mod smoothing;

use crate::ModelError;
use flat_mesh::FlatMesh;
use geometry::{angle_range, corners, element_area, signed_area};
use glam::DVec2;
use outline::outlines;
use toile_scene::Garment;

/// The mesh of each panel.
pub(crate) fn panel_meshes(garment: &Garment, spacing: f64) -> Result<Vec<FlatMesh>, ModelError> {
    let outlines = outlines(garment, spacing)?;
    garment
        .panels
        .iter()
        .zip(&outlines)
        .map(|(panel, outline)| {
            grid::mesh(outline)
                .or_else(|| rim::mesh(outline, spacing))
                .filter(|mesh| is_valid(mesh, outline.points.iter().copied()))
                .ok_or_else(|| ModelError::Mesh { panel: panel.name.clone(), spacing })
        })
        .collect()
}

/// Whether no element is inverted, every particle is used and the elements cover the outline exactly.
fn is_valid(mesh: &FlatMesh, outline: impl Iterator<Item = DVec2> + Clone) -> bool {
    let mut used = vec![false; mesh.points.len()];
    let mut area = 0.0;
    for element in &mesh.elements {
        let [low, high] = angle_range(element, &mesh.points);
        if !(low > 0.0 && high < 180.0) {
            return false;
        }
        area += element_area(element, &mesh.points);
        corners(element).iter().for_each(|&i| used[i as usize] = true);
    }
    let wanted = signed_area(outline).abs();
    used.iter().all(|&u| u) && (area - wanted).abs() <= 1e-9 * wanted
}
