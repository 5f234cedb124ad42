//! The way of a body from the pose that it is dressed in to the start of its motion.

use glam::Vec3;
use toile_model::Fit;
use toile_scene::{Body, MovingMesh, Scene};

/// Time in which a dressed body goes over to the start of its motion [s].
const WAY_SECONDS: f64 = 1.0;

/// A body that leads to how the mesh of a scene stands ends no farther from it [m].
const ARRIVED: f32 = 1e-4;

/// The way from the pose that garments are sewn in to the start of the motion, or to how a mesh at rest stands; `None` where that is the
/// first pose, and where the two do not move the same joints or do not meet.
pub(crate) fn way(fit: &Fit) -> Option<MovingMesh> {
    let from = fit.dress_in.as_ref()?;
    let mut moving = fit.scene.bodies.iter().filter_map(|body| match body {
        Body::Moving(moving) => Some(moving),
        Body::Mesh(_) | Body::Shape(_) => None,
    });
    match (moving.next(), moving.next()) {
        (Some(only), None) => MovingMesh::transition(from, only, WAY_SECONDS),
        (None, None) => Some(from.clone()).filter(|from| ends_at_rest(from, &fit.scene)),
        _ => None,
    }
}

/// Whether a body ends as the only mesh of a scene stands.
fn ends_at_rest(from: &MovingMesh, scene: &Scene) -> bool {
    let mut meshes = scene.bodies.iter().filter_map(|body| match body {
        Body::Mesh(mesh) => Some(mesh),
        Body::Moving(_) | Body::Shape(_) => None,
    });
    let (Some(mesh), None) = (meshes.next(), meshes.next()) else { return false };
    let end = from.at(from.duration());
    let is_near = |(a, b): (&Vec3, &Vec3)| a.distance(*b) <= ARRIVED;
    end.positions.len() == mesh.positions.len()
        && end.triangles == mesh.triangles
        && end.positions.iter().zip(&mesh.positions).all(is_near)
}
