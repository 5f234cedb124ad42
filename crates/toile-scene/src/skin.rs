//! A mesh that bends with joints.

use glam::{Vec3, Vec4};

/// How the vertices of a mesh hang on joints. A rigid body is a skin with one joint.
///
/// A vertex stands at Σ weight·(joint matrix)·(bind position), after the morph targets have moved its bind position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// Bind positions, in the unit of the file, shape [vertex_count].
    pub positions: Vec<Vec3>,
    /// Unit bind normals, shape [vertex_count].
    pub normals: Vec<Vec3>,
    /// Where the influences of each vertex begin, shape [vertex_count + 1].
    pub influence_offsets: Vec<u32>,
    /// Influences of all vertices, one vertex after the other; the weights of a vertex sum to 1.
    pub influences: Vec<Influence>,
    /// Morph targets; `None` without any.
    pub morphs: Option<Morphs>,
}

/// The share that a joint has in a vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Influence {
    /// Index into [`Pose::joints`].
    pub joint: u32,
    /// Share [1], 0 to 1.
    pub weight: f32,
}

/// Displacements of bind positions and normals that a pose mixes in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Morphs {
    /// Where the displacements of each vertex begin, shape [vertex_count + 1].
    pub offsets: Vec<u32>,
    /// Displacements of all vertices, one vertex after the other.
    pub displacements: Vec<Displacement>,
}

/// What one morph target does to one vertex.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Displacement {
    /// Index into [`Pose::morph_weights`].
    pub target: u32,
    /// Displacement of the bind position, in the unit of the file.
    pub position: Vec3,
    /// Change of the bind normal.
    pub normal: Vec3,
}

/// Where the joints stand at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// From bind space to the world [m]: the first three rows of each joint's matrix, shape [joint_count].
    pub joints: Vec<[Vec4; 3]>,
    /// Weight of each morph target, shape [target_count].
    pub morph_weights: Vec<f32>,
}
