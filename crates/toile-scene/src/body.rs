//! What the cloth collides with.

use crate::{Mesh, MovingMesh, Shape};

/// Something the cloth collides with.
#[derive(Clone, Debug)]
pub enum Body {
    /// A mesh at rest, sampled through its depth and normal maps.
    Mesh(Mesh),
    /// A mesh that moves, sampled through its depth, normal and velocity maps.
    Moving(MovingMesh),
    /// An analytic shape, tested exactly and without maps.
    Shape(Shape),
}
