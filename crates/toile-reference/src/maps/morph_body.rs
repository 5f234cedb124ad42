//! Bind positions and normals under morph targets.

use glam::Vec3;
use toile_scene::Morphs;

/// Adds to each bind position and normal the displacements of its vertex, each times the weight of its target. Arrays have the
/// shape [vertex_count]; the weights [target_count].
pub fn morph_body(positions: &mut [Vec3], normals: &mut [Vec3], morphs: &Morphs, weights: &[f32]) {
    for (vertex, (position, normal)) in positions.iter_mut().zip(normals).enumerate() {
        let range = morphs.offsets[vertex] as usize..morphs.offsets[vertex + 1] as usize;
        for displacement in &morphs.displacements[range] {
            let weight = weights[displacement.target as usize];
            *position += displacement.position * weight;
            *normal += displacement.normal * weight;
        }
    }
}
