//! Meshes that move: skinned, rigid, or given frame by frame.

use crate::{Mesh, Rig, Skin};
use glam::Vec3;

/// A mesh that moves.
#[derive(Clone, Debug)]
pub struct MovingMesh {
    /// The mesh as it stands at time 0 [m].
    pub mesh: Mesh,
    /// How it moves.
    pub motion: Motion,
}

/// How a mesh moves.
#[derive(Clone, Debug)]
pub enum Motion {
    /// Its vertices follow joints.
    Skinned {
        /// How the vertices hang on the joints.
        skin: Skin,
        /// How the joints move.
        rig: Rig,
    },
    /// Its vertices are given at even times.
    Sequence(MeshSequence),
}

/// Vertices at even times, linear in between; before the first and after the last frame they stand still.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshSequence {
    /// Frames per second [1/s].
    pub frame_rate: f64,
    /// Positions [m] and unit normals of each frame, each of shape [vertex_count].
    pub frames: Vec<[Vec<Vec3>; 2]>,
}
