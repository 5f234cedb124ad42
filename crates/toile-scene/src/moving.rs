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

impl MeshSequence {
    /// Positions [m] and unit normals at a time [s].
    ///
    /// # Panics
    /// When there is no frame.
    pub fn at(&self, time: f64) -> [Vec<Vec3>; 2] {
        let place = (time * self.frame_rate).clamp(0.0, (self.frames.len() - 1) as f64);
        let first = place.floor() as usize;
        let share = (place - place.floor()) as f32;
        let [a, b] = [&self.frames[first], &self.frames[(first + 1).min(self.frames.len() - 1)]];
        let between = |values: usize| a[values].iter().zip(&b[values]).map(move |(a, b)| a.lerp(*b, share));
        [between(0).collect(), between(1).map(|normal| normal.normalize_or(Vec3::Y)).collect()]
    }
}
