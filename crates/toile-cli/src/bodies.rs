//! The bodies of a scene, kind by kind.

use toile::scene::{Body, Mesh, MovingMesh, Scene, Shape};

/// The mesh bodies of a scene that move.
pub fn moving(scene: &Scene) -> impl Iterator<Item = &MovingMesh> {
    scene.bodies.iter().filter_map(|body| match body {
        Body::Moving(body) => Some(body),
        Body::Mesh(_) | Body::Shape(_) => None,
    })
}

/// The mesh bodies of a scene at rest.
pub fn meshes(scene: &Scene) -> impl Iterator<Item = &Mesh> {
    scene.bodies.iter().filter_map(|body| match body {
        Body::Mesh(mesh) => Some(mesh),
        Body::Moving(_) | Body::Shape(_) => None,
    })
}

/// The shapes of a scene.
pub fn shapes(scene: &Scene) -> Vec<Shape> {
    let shape = |body: &Body| match body {
        Body::Shape(shape) => Some(shape.clone()),
        Body::Mesh(_) | Body::Moving(_) => None,
    };
    scene.bodies.iter().filter_map(shape).collect()
}
