//! Meshes that move: skinned, rigid, or given frame by frame.

use crate::clip::Moment;
use crate::{Mesh, Rig, RigidKey, Skin};
use glam::{DMat3, DQuat, DVec3, Vec3};

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
    /// The host skins it, on the device; here it stands still.
    Hosted,
}

/// Vertices at even times, linear in between; before the first and after the last frame they stand still.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshSequence {
    /// Frames per second [1/s].
    pub frame_rate: f64,
    /// Positions [m] and unit normals of each frame, each of shape [vertex_count].
    pub frames: Vec<[Vec<Vec3>; 2]>,
}

impl MovingMesh {
    /// A mesh that moves as a whole by keys: it is given as it stands without any motion.
    pub fn rigid(mesh: Mesh, keys: Vec<RigidKey>) -> Self {
        let mut moving = Self { motion: Motion::Skinned { skin: Skin::rigid(&mesh), rig: Rig::rigid(keys) }, mesh };
        moving.mesh = moving.at(0.0);
        moving
    }

    /// A mesh that the host skins on the device, given as it stands while it is dressed: vertices in the order of the host's buffers.
    pub fn hosted(mesh: Mesh) -> Self {
        Self { mesh, motion: Motion::Hosted }
    }

    /// The way from the first pose of one moving mesh to that of another on the same joints, in some seconds; `None` when vertices or
    /// joints differ, and for sequences.
    pub fn transition(from: &Self, to: &Self, seconds: f64) -> Option<Self> {
        match (&from.motion, &to.motion) {
            (Motion::Skinned { skin, rig: first }, Motion::Skinned { skin: other, rig: last })
                if skin.positions == other.positions && skin.influences == other.influences =>
            {
                let rig = Rig::transition(first, last, seconds)?;
                Some(Self { mesh: from.mesh.clone(), motion: Motion::Skinned { skin: skin.clone(), rig } })
            }
            _ => None,
        }
    }

    /// The same mesh as it stands without its clip; `None` for a sequence, which has no other pose.
    pub fn at_rest(&self) -> Option<Self> {
        let Motion::Skinned { skin, rig } = &self.motion else { return None };
        let motion = Motion::Skinned { skin: skin.clone(), rig: rig.at_rest() };
        let mut resting = Self { mesh: self.mesh.clone(), motion };
        resting.mesh = resting.at(0.0);
        Some(resting)
    }

    /// The same mesh as it stands still at a time of its motion [s]; `None` for a sequence, which goes over to no other pose.
    pub fn held(&self, time: f64) -> Option<Self> {
        let Motion::Skinned { skin, rig } = &self.motion else { return None };
        let motion = Motion::Skinned { skin: skin.clone(), rig: rig.held(time) };
        let mut held = Self { mesh: self.mesh.clone(), motion };
        held.mesh = held.at(0.0);
        Some(held)
    }

    /// The mesh and its motion turned about the origin.
    pub fn turned(&self, turn: DMat3) -> Self {
        let motion = match &self.motion {
            Motion::Skinned { skin, rig } => {
                Motion::Skinned { skin: skin.clone(), rig: rig.turned(DQuat::from_mat3(&turn)) }
            }
            Motion::Sequence(sequence) => Motion::Sequence(sequence.turned(turn)),
            Motion::Hosted => Motion::Hosted,
        };
        Self { mesh: self.mesh.turned(turn), motion }
    }

    /// The mesh at a time [s], computed in f64: every vertex, so for pictures and exact measurement, not for each frame. One that the host skins
    /// stands as it is dressed.
    pub fn at(&self, time: f64) -> Mesh {
        let [positions, normals] = match &self.motion {
            Motion::Skinned { skin, rig } => skin.posed(&rig.joint_matrices(time), &rig.morph_weights(time)),
            Motion::Sequence(sequence) => {
                sequence.at(time).unwrap_or_else(|| [self.mesh.positions.clone(), self.mesh.normals.clone()])
            }
            Motion::Hosted => return self.mesh.clone(),
        };
        Mesh { positions, normals, triangles: self.mesh.triangles.clone() }
    }

    /// Time of the last key or frame [s].
    pub fn duration(&self) -> f64 {
        match &self.motion {
            Motion::Skinned { rig, .. } => rig.duration(),
            Motion::Sequence(sequence) => sequence.duration(),
            Motion::Hosted => 0.0,
        }
    }

    /// Whether the motion repeats after its end; see [`Rig::is_closed`]. A sequence stands still, and of what the host skins nothing is known.
    pub fn is_closed(&self) -> bool {
        match &self.motion {
            Motion::Skinned { rig, .. } => rig.is_closed(),
            Motion::Sequence(_) | Motion::Hosted => false,
        }
    }
}

impl MeshSequence {
    /// Time of the last frame [s]; the first is at 0.
    pub fn duration(&self) -> f64 {
        self.frames.len().saturating_sub(1) as f64 / self.frame_rate
    }

    /// The frames turned about the origin.
    fn turned(&self, turn: DMat3) -> Self {
        let turned = |v: &Vec3| (turn * v.as_dvec3()).as_vec3();
        let frame = |parts: &[Vec<Vec3>; 2]| parts.each_ref().map(|part| part.iter().map(turned).collect());
        Self { frame_rate: self.frame_rate, frames: self.frames.iter().map(frame).collect() }
    }

    /// Positions [m] and unit normals at a time [s]; `None` without a frame.
    pub fn at(&self, time: f64) -> Option<[Vec<Vec3>; 2]> {
        if self.frames.is_empty() {
            return None;
        }
        let (last, share) = match Moment::of(|frame| frame as f64 / self.frame_rate, self.frames.len(), time) {
            Moment::At(frame) => return Some(self.frames[frame].clone()),
            Moment::Between { last, share, .. } => (last, share),
        };
        let pairs = |part: usize| self.frames[last][part].iter().zip(&self.frames[last + 1][part]);
        let between = |(a, b): (&Vec3, &Vec3)| a.as_dvec3().lerp(b.as_dvec3(), share);
        let positions = pairs(0).map(|pair| between(pair).as_vec3()).collect();
        let normals = pairs(1).map(|pair| between(pair).normalize_or(DVec3::Y).as_vec3()).collect();
        Some([positions, normals])
    }
}

#[cfg(test)]
mod tests {
    use super::{MeshSequence, Motion, MovingMesh};
    use crate::{Mesh, RigidKey};
    use glam::{DQuat, Vec3, dvec3, vec3};

    #[test]
    fn a_sequence_is_linear_between_its_frames_and_still_outside() {
        let frame = |x: f32, normal| [vec![vec3(x, 0.0, 0.0)], vec![normal]];
        let frames = vec![frame(0.0, Vec3::X), frame(1.0, Vec3::Y), frame(-1.0, Vec3::Y)];
        let mesh = Mesh { positions: vec![Vec3::ZERO], normals: vec![Vec3::X], triangles: vec![] };
        let moving = MovingMesh { mesh, motion: Motion::Sequence(MeshSequence { frame_rate: 4.0, frames }) };
        assert_eq!((moving.duration(), moving.is_closed()), (0.5, false));
        let x = [-1.0, 0.0, 0.125, 0.25, 0.3125, 0.5, 3.0].map(|time| moving.at(time).positions[0].x);
        assert_eq!(x, [0.0, 0.0, 0.5, 1.0, 0.5, -1.0, -1.0]);
        let half = moving.at(0.125).normals[0];
        assert!(half.distance(vec3(0.5f32.sqrt(), 0.5f32.sqrt(), 0.0)) < 1e-6, "{half}");
    }

    #[test]
    fn a_rigid_mesh_stands_where_its_first_key_puts_it() {
        let mesh = Mesh { positions: vec![Vec3::X], normals: vec![Vec3::X], triangles: vec![] };
        let rotation = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
        let key = |time, x| RigidKey { time, translation: dvec3(x, 0.0, 1.0), rotation };
        let moving = MovingMesh::rigid(mesh, vec![key(0.0, 2.0), key(1.0, 3.0)]);
        assert!(moving.mesh.positions[0].distance(vec3(2.0, 1.0, 1.0)) < 1e-6);
        assert!(moving.mesh.normals[0].distance(Vec3::Y) < 1e-6);
        assert!(moving.at(0.5).positions[0].distance(vec3(2.5, 1.0, 1.0)) < 1e-6);
    }
}
