//! Joints and how they move.

use crate::{Pose, Skin};
use glam::{DMat4, DQuat, DVec3, DVec4, Vec4};

/// How near the joints must come to where they began for a clip to be closed: rows of their matrices [m, 1].
const CLOSED: f32 = 1e-3;

/// Joints and how they move.
#[derive(Clone, Debug)]
pub struct Rig {
    /// Nodes that move the joints, parents before children.
    pub nodes: Vec<Node>,
    /// The joints, shape [joint_count].
    pub joints: Vec<Joint>,
    /// How the nodes move; empty for a rig that stands still.
    pub tracks: Vec<Track>,
    /// Weights of the morph targets where no track moves them, shape [target_count].
    pub morph_weights: Vec<f64>,
    /// End of the motion [s].
    pub duration: f64,
    /// Length of the unit of the nodes [m].
    pub metres_per_unit: f64,
}

/// A node of a rig.
#[derive(Clone, Debug)]
pub struct Node {
    /// Index of its parent, which comes before it.
    pub parent: Option<u32>,
    /// Its transform relative to the parent.
    pub local: Transform,
}

/// A transform relative to a parent.
#[derive(Clone, Copy, Debug)]
pub enum Transform {
    /// As a matrix; no track can move it.
    Matrix(DMat4),
    /// In parts, which tracks can move.
    Parts {
        /// Translation, in the unit of the rig.
        translation: DVec3,
        /// Rotation.
        rotation: DQuat,
        /// Scale.
        scale: DVec3,
    },
}

/// A joint: a node, and where the bind pose has it.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Name, such as "upperarm_l"; may be empty.
    pub name: String,
    /// Index of its node.
    pub node: u32,
    /// From bind space to the space of the node.
    pub inverse_bind: DMat4,
}

/// How one property of a node moves.
#[derive(Clone, Debug)]
pub struct Track {
    /// Index of the node.
    pub node: u32,
    /// What moves.
    pub property: Property,
    /// Its values over time.
    pub keys: Keys,
}

/// What a track moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Property {
    /// Translation, three values per key.
    Translation,
    /// Rotation, a quaternion xyzw per key.
    Rotation,
    /// Scale, three values per key.
    Scale,
    /// Weights of morph targets from this index on.
    MorphWeights(u32),
}

/// Values over time. Before the first and after the last key they stand still.
#[derive(Clone, Debug)]
pub struct Keys {
    /// Times, ascending, at least one [s].
    pub times: Vec<f64>,
    /// Values of each key, one key after the other: `width` of them, or three times as many with [`Interpolation::Cubic`].
    pub values: Vec<f64>,
    /// Values per key.
    pub width: usize,
    /// What is between two keys.
    pub interpolation: Interpolation,
}

/// What is between two keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The value of the earlier key.
    Step,
    /// The straight way; for rotations, the shortest arc.
    Linear,
    /// Cubic splines: each key is in-tangent, value, out-tangent.
    Cubic,
}

/// Where a rigid body is at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidKey {
    /// Time [s].
    pub time: f64,
    /// Displacement from where the body is read [m].
    pub translation: DVec3,
    /// Rotation around the origin, before the displacement.
    pub rotation: DQuat,
}

impl Rig {
    /// The rig of a rigid body: one joint that goes from key to key, straight on and by the shortest arc.
    ///
    /// # Panics
    /// When there is no key.
    pub fn rigid(keys: &[RigidKey]) -> Self {
        let times: Vec<f64> = keys.iter().map(|key| key.time).collect();
        let duration = *times.last().expect("a rigid motion has a key");
        let track = |property, width, values: Vec<f64>| Track {
            node: 0,
            property,
            keys: Keys { times: times.clone(), values, width, interpolation: Interpolation::Linear },
        };
        let identity = Transform::Parts { translation: DVec3::ZERO, rotation: DQuat::IDENTITY, scale: DVec3::ONE };
        Self {
            nodes: vec![Node { parent: None, local: identity }],
            joints: vec![Joint { name: String::new(), node: 0, inverse_bind: DMat4::IDENTITY }],
            tracks: vec![
                track(Property::Translation, 3, keys.iter().flat_map(|key| key.translation.to_array()).collect()),
                track(Property::Rotation, 4, keys.iter().flat_map(|key| key.rotation.to_array()).collect()),
            ],
            morph_weights: Vec::new(),
            duration,
            metres_per_unit: 1.0,
        }
    }

    /// Where the joints stand at a time [s]. A closed motion goes on from its start; any other stands still after its end.
    pub fn pose(&self, time: f64) -> Pose {
        let time = if time > self.duration && self.is_closed() { time.rem_euclid(self.duration) } else { time };
        self.pose_within(time)
    }

    /// Whether the motion ends as it begins, so that it can be repeated.
    pub fn is_closed(&self) -> bool {
        let [start, end] = [0.0, self.duration].map(|time| self.pose_within(time));
        let near = |(a, b): (&[Vec4; 3], &[Vec4; 3])| a.iter().zip(b).all(|(a, b)| a.abs_diff_eq(*b, CLOSED));
        self.duration > 0.0 && start.joints.iter().zip(&end.joints).all(near)
    }

    /// Index of the joint on which each vertex of a skin hangs most, shape [vertex_count].
    pub fn main_joints(skin: &Skin) -> Vec<u32> {
        let main = |range: &[u32]| {
            let influences = &skin.influences[range[0] as usize..range[1] as usize];
            influences.iter().max_by(|a, b| a.weight.total_cmp(&b.weight)).map_or(0, |influence| influence.joint)
        };
        skin.influence_offsets.windows(2).map(main).collect()
    }

    fn pose_within(&self, time: f64) -> Pose {
        let worlds = self.worlds(time);
        let scale = DMat4::from_scale(DVec3::splat(self.metres_per_unit));
        let rows = |joint: &Joint| {
            let matrix = scale * worlds[joint.node as usize] * joint.inverse_bind;
            [0, 1, 2].map(|row| matrix.row(row).as_vec4())
        };
        let mut weights = self.morph_weights.clone();
        for track in &self.tracks {
            if let Property::MorphWeights(first) = track.property {
                weights[first as usize..].iter_mut().zip(track.keys.at(time, false)).for_each(|(w, value)| *w = value);
            }
        }
        Pose {
            joints: self.joints.iter().map(rows).collect(),
            morph_weights: weights.into_iter().map(|weight| weight as f32).collect(),
        }
    }

    /// World transform of every node at a time [s], in the unit of the rig.
    pub fn worlds(&self, time: f64) -> Vec<DMat4> {
        let mut locals: Vec<Transform> = self.nodes.iter().map(|node| node.local).collect();
        for track in &self.tracks {
            let Transform::Parts { translation, rotation, scale } = &mut locals[track.node as usize] else { continue };
            let value = track.keys.at(time, track.property == Property::Rotation);
            match track.property {
                Property::Translation => *translation = DVec3::from_slice(&value),
                Property::Scale => *scale = DVec3::from_slice(&value),
                Property::Rotation => *rotation = DQuat::from_slice(&value),
                Property::MorphWeights(_) => {}
            }
        }
        let mut worlds: Vec<DMat4> = Vec::with_capacity(locals.len());
        for (node, local) in self.nodes.iter().zip(&locals) {
            let above = node.parent.map_or(DMat4::IDENTITY, |parent| worlds[parent as usize]);
            worlds.push(above * local.matrix());
        }
        worlds
    }
}

impl Transform {
    fn matrix(self) -> DMat4 {
        match self {
            Self::Matrix(matrix) => matrix,
            Self::Parts { translation, rotation, scale } => {
                DMat4::from_scale_rotation_translation(scale, unit(rotation), translation)
            }
        }
    }
}

/// A zero quaternion would turn into NaN and hide which node is at fault.
fn unit(rotation: DQuat) -> DQuat {
    DQuat::from_vec4(DVec4::from(rotation).normalize_or(DVec4::W))
}

impl Keys {
    /// The values at a time [s]; quaternions go by the shortest arc.
    fn at(&self, time: f64, quaternion: bool) -> Vec<f64> {
        let cubic = self.interpolation == Interpolation::Cubic;
        let parts = if cubic { 3 } else { 1 };
        let value = |key: usize, part: usize| {
            let first = (key * parts + part) * self.width;
            &self.values[first..first + self.width]
        };
        let middle = usize::from(cubic);
        let next = self.times.partition_point(|key| *key <= time);
        if next == 0 {
            return value(0, middle).to_vec();
        }
        let last = next - 1;
        if next == self.times.len() || self.interpolation == Interpolation::Step {
            return value(last, middle).to_vec();
        }
        let span = self.times[next] - self.times[last];
        let t = (time - self.times[last]) / span;
        if self.interpolation == Interpolation::Linear {
            let [a, b] = [value(last, 0), value(next, 0)];
            if quaternion {
                let [a, b] = [a, b].map(|q| unit(DQuat::from_slice(q)));
                return a.slerp(b, t).to_array().to_vec();
            }
            return a.iter().zip(b).map(|(a, b)| a + (b - a) * t).collect();
        }
        let (t2, t3) = (t * t, t * t * t);
        (0..self.width)
            .map(|i| {
                (2.0 * t3 - 3.0 * t2 + 1.0) * value(last, 1)[i]
                    + span * (t3 - 2.0 * t2 + t) * value(last, 2)[i]
                    + (3.0 * t2 - 2.0 * t3) * value(next, 1)[i]
                    + span * (t3 - t2) * value(next, 0)[i]
            })
            .collect()
    }
}
