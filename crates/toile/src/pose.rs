//! The way of a body from the pose that it is dressed in to the start of its motion.

use toile_model::Fit;
use toile_scene::{Body, MovingMesh, Scene};

/// Time in which a dressed body goes over to the start of its motion [s].
const WAY_SECONDS: f64 = 1.0;

/// The way from the pose that garments are sewn in to the start of the motion; `None` where that is the first pose, and where the two do
/// not move the same joints.
pub(crate) fn way(fit: &Fit) -> Option<MovingMesh> {
    MovingMesh::transition(fit.dress_in.as_ref()?, moving_body(&fit.scene)?, WAY_SECONDS)
}

/// The only mesh of a scene that moves.
fn moving_body(scene: &Scene) -> Option<&MovingMesh> {
    let mut moving = scene.bodies.iter().filter_map(|body| match body {
        Body::Moving(moving) => Some(moving),
        Body::Mesh(_) | Body::Shape(_) => None,
    });
    moving.next().filter(|_| moving.next().is_none())
}
