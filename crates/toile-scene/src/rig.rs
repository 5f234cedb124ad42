//! Joints and how they move.

use crate::clip::{Between, Channel, Clip, Interpolation, Keys, unit};
use crate::{Pose, RigidKey};
use glam::{DMat3, DMat4, DQuat, DVec3};
use std::sync::Arc;

/// How far a joint may end from where it starts [m] when its clip is called closed.
const CLOSED_DISTANCE: f64 = 1e-3;

/// How much a joint may end turned or scaled against its start [1] when its clip is called closed: 1 mm at 1 m.
const CLOSED_TURN: f64 = 1e-3;

/// Joints and how they move. Immutable; clones share their data.
#[derive(Clone, Debug)]
pub struct Rig(Arc<Parts>);

#[derive(Debug)]
struct Parts {
    nodes: Vec<RigNode>,
    /// Every node after its parent.
    order: Vec<usize>,
    joints: Vec<Joint>,
    morph_weights: Vec<f64>,
    clip: Option<Clip>,
    metres_per_unit: f64,
    is_closed: bool,
}

/// A place that moves relative to its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigNode {
    /// Index of the node that carries it; `None` stands in the world.
    pub parent: Option<usize>,
    /// Where it stands when no clip moves it.
    pub transform: LocalTransform,
}

/// Transform of a node relative to its parent, in the unit of the rig.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LocalTransform {
    /// An affine matrix, which no clip can move.
    Matrix(DMat4),
    /// Scale first, then rotation, then translation.
    Parts {
        /// In the unit of the rig.
        translation: DVec3,
        /// Need not be of unit length.
        rotation: DQuat,
        /// Factors along the node's own axes [1].
        scale: DVec3,
    },
}

impl LocalTransform {
    /// No motion against the parent.
    pub const IDENTITY: Self = Self::Parts { translation: DVec3::ZERO, rotation: DQuat::IDENTITY, scale: DVec3::ONE };

    fn matrix(self) -> DMat4 {
        match self {
            Self::Matrix(matrix) => matrix,
            Self::Parts { translation, rotation, scale } => {
                DMat4::from_scale_rotation_translation(scale, unit(rotation), translation)
            }
        }
    }
}

/// What vertices hang on.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name of its node.
    pub name: String,
    /// Index of its node.
    pub node: usize,
    /// From bind space to the space of the node.
    pub inverse_bind: DMat4,
}

/// A node that carries itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct OwnAncestor {
    /// Index of the node.
    pub node: usize,
}

impl Rig {
    /// A rig of nodes in any order, joints, resting weights of the morph targets [1], what moves, and the length of its
    /// unit [m].
    ///
    /// # Errors
    ///
    /// [`OwnAncestor`] when the parents of a node lead in a circle.
    ///
    /// # Panics
    ///
    /// When a parent, joint or channel points at nothing, a channel moves a node that has a matrix, or its values do not fit
    /// its times.
    pub fn new(
        nodes: Vec<RigNode>,
        joints: Vec<Joint>,
        morph_weights: Vec<f64>,
        clip: Option<Clip>,
        metres_per_unit: f64,
    ) -> Result<Self, OwnAncestor> {
        assert!(metres_per_unit > 0.0, "the length of a unit is positive");
        assert!(joints.iter().all(|joint| joint.node < nodes.len()), "every joint has a node");
        for channel in clip.iter().flat_map(|clip| &clip.channels) {
            let (valid, moves) = match channel {
                Channel::Translation { node, keys } | Channel::Scale { node, keys } => (keys.is_valid(), Some(*node)),
                Channel::Rotation { node, keys } => (keys.is_valid(), Some(*node)),
                Channel::MorphWeight { target, keys } => {
                    assert!(*target < morph_weights.len(), "a channel moves a morph target that exists");
                    (keys.is_valid(), None)
                }
            };
            assert!(valid, "the values of a channel fit its times, which do not fall");
            if let Some(node) = moves {
                let has_parts = matches!(nodes[node].transform, LocalTransform::Parts { .. });
                assert!(has_parts, "a channel moves a node with translation, rotation and scale");
            }
        }
        let order = parents_first(&nodes)?;
        let mut parts = Parts { nodes, order, joints, morph_weights, clip, metres_per_unit, is_closed: false };
        parts.is_closed = parts.ends_as_it_starts();
        Ok(Self(Arc::new(parts)))
    }

    /// A rig of one joint, whose bind space is the world, that moves by keys and stands still outside of them.
    pub fn rigid(keys: Vec<RigidKey>) -> Self {
        let times: Vec<f64> = keys.iter().map(|key| key.time).collect();
        let clip = times.last().map(|duration| Clip {
            name: "rigid".into(),
            duration: duration.max(0.0),
            channels: vec![
                Channel::Translation {
                    node: 0,
                    keys: Keys {
                        interpolation: Interpolation::Linear,
                        times: times.clone(),
                        values: keys.iter().map(|key| key.translation).collect(),
                    },
                },
                Channel::Rotation {
                    node: 0,
                    keys: Keys {
                        interpolation: Interpolation::Linear,
                        times: times.clone(),
                        values: keys.iter().map(|key| key.rotation).collect(),
                    },
                },
            ],
        });
        Self(Arc::new(Parts {
            nodes: vec![RigNode { parent: None, transform: LocalTransform::IDENTITY }],
            order: vec![0],
            joints: vec![Joint { name: "body".into(), node: 0, inverse_bind: DMat4::IDENTITY }],
            morph_weights: Vec::new(),
            clip,
            metres_per_unit: 1.0,
            // Keys say when it moves; they are no cycle even where the last one leads back.
            is_closed: false,
        }))
    }

    /// The way from the first pose of one rig to that of another with the same nodes and joints, gently started and stopped, in some
    /// seconds; `None` when they are not the same.
    pub fn transition(from: &Self, to: &Self, seconds: f64) -> Option<Self> {
        let [start, end] = [from, to].map(|rig| rig.0.local_transforms(0.0));
        let same = |(a, b): (&RigNode, &RigNode)| a.parent == b.parent;
        let nodes_are_same = start.len() == end.len() && from.0.nodes.iter().zip(&to.0.nodes).all(same);
        if !nodes_are_same || from.0.joints != to.0.joints || from.0.morph_weights.len() != to.0.morph_weights.len() {
            return None;
        }
        let mut channels = Vec::new();
        for (node, ends) in start.iter().zip(&end).enumerate() {
            match ends {
                (LocalTransform::Parts { .. }, LocalTransform::Parts { .. }) => {}
                (a, b) if a == b => continue,
                _ => return None,
            }
            let (
                LocalTransform::Parts { translation, rotation, scale },
                LocalTransform::Parts { translation: next_translation, rotation: next_rotation, scale: next_scale },
            ) = ends
            else {
                unreachable!("both have parts")
            };
            channels.push(Channel::Translation { node, keys: gentle(*translation, *next_translation, seconds) });
            channels.push(Channel::Rotation { node, keys: gentle(*rotation, *next_rotation, seconds) });
            channels.push(Channel::Scale { node, keys: gentle(*scale, *next_scale, seconds) });
        }
        for (target, weights) in from.morph_weights(0.0).into_iter().zip(to.morph_weights(0.0)).enumerate() {
            channels.push(Channel::MorphWeight { target, keys: gentle(weights.0, weights.1, seconds) });
        }
        let clip = Clip { name: "transition".into(), duration: seconds, channels };
        let parts = Parts {
            nodes: to.0.nodes.clone(),
            order: to.0.order.clone(),
            joints: to.0.joints.clone(),
            morph_weights: to.0.morph_weights.clone(),
            clip: Some(clip),
            metres_per_unit: to.0.metres_per_unit,
            is_closed: false,
        };
        Some(Self(Arc::new(parts)))
    }

    /// The same rig without its clip: its joints stand where the file puts them.
    pub fn at_rest(&self) -> Self {
        let Parts { nodes, order, joints, morph_weights, metres_per_unit, .. } = self.0.as_ref();
        Self(Arc::new(Parts {
            nodes: nodes.clone(),
            order: order.clone(),
            joints: joints.clone(),
            morph_weights: morph_weights.clone(),
            clip: None,
            metres_per_unit: *metres_per_unit,
            is_closed: false,
        }))
    }

    /// The same rig without its clip, whose joints stand where the clip puts them at a time [s].
    pub fn held(&self, time: f64) -> Self {
        let Parts { nodes, order, joints, metres_per_unit, .. } = self.0.as_ref();
        let transforms = self.0.local_transforms(self.clip_time(time));
        let held = nodes.iter().zip(transforms).map(|(node, transform)| RigNode { parent: node.parent, transform });
        Self(Arc::new(Parts {
            nodes: held.collect(),
            order: order.clone(),
            joints: joints.clone(),
            morph_weights: self.morph_weights(time),
            clip: None,
            metres_per_unit: *metres_per_unit,
            is_closed: false,
        }))
    }

    /// The same rig without its clip as it stands at time 0, a joint turned about its own place by a rotation of the world. All that it carries goes
    /// with it. `None` where its node has a matrix, which nothing turns, or a parent without directions.
    pub fn with_joint_turned(&self, joint: usize, turn: DQuat) -> Option<Self> {
        let held = self.held(0.0);
        let Parts { nodes, order, joints, morph_weights, metres_per_unit, .. } = held.0.as_ref();
        let mut nodes = nodes.clone();
        let RigNode { parent, transform: LocalTransform::Parts { rotation, .. } } = &mut nodes[joints[joint].node]
        else {
            return None;
        };
        let carrier = match parent {
            Some(parent) => {
                let matrix = held.node_transforms(0.0)[*parent];
                let axes = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate().try_normalize());
                let [Some(x), Some(y), Some(z)] = axes else { return None };
                DQuat::from_mat3(&DMat3::from_cols(x, y, z))
            }
            None => DQuat::IDENTITY,
        };
        *rotation = carrier.inverse() * turn * carrier * unit(*rotation);
        Some(Self(Arc::new(Parts {
            nodes,
            order: order.clone(),
            joints: joints.clone(),
            morph_weights: morph_weights.clone(),
            clip: None,
            metres_per_unit: *metres_per_unit,
            is_closed: false,
        })))
    }

    /// The same rig turned about the origin: a further node carries all that stood in the world.
    pub fn turned(&self, rotation: DQuat) -> Self {
        let Parts { nodes, order, joints, morph_weights, clip, metres_per_unit, is_closed } = self.0.as_ref();
        let carrier = nodes.len();
        let carried = |node: &RigNode| RigNode { parent: node.parent.or(Some(carrier)), transform: node.transform };
        let transform = LocalTransform::Parts { translation: DVec3::ZERO, rotation, scale: DVec3::ONE };
        Self(Arc::new(Parts {
            nodes: nodes.iter().map(carried).chain([RigNode { parent: None, transform }]).collect(),
            order: [carrier].into_iter().chain(order.iter().copied()).collect(),
            joints: joints.clone(),
            morph_weights: morph_weights.clone(),
            clip: clip.clone(),
            metres_per_unit: *metres_per_unit,
            is_closed: *is_closed,
        }))
    }

    /// Where the joints stand at a time [s], rounded to f32. A closed clip repeats; any other stands still after its end.
    pub fn pose(&self, time: f64) -> Pose {
        self.rounded(time, |matrix| matrix)
    }

    /// The same, carried by a transform of the world [m].
    pub fn carried_pose(&self, time: f64, carry: DMat4) -> Pose {
        self.rounded(time, |matrix| carry * matrix)
    }

    fn rounded(&self, time: f64, carried: impl Fn(DMat4) -> DMat4) -> Pose {
        let rows = |matrix: DMat4| [0, 1, 2].map(|row| matrix.row(row).as_vec4());
        Pose {
            joints: self.joint_matrices(time).into_iter().map(|matrix| rows(carried(matrix))).collect(),
            morph_weights: self.morph_weights(time).into_iter().map(|weight| weight as f32).collect(),
        }
    }

    /// World transform of the node of a joint at a time [s], its place in metres.
    pub fn joint_place(&self, joint: usize, time: f64) -> DMat4 {
        DMat4::from_scale(DVec3::splat(self.0.metres_per_unit)) * self.node_transforms(time)[self.0.joints[joint].node]
    }

    /// How many nodes carry that of a joint.
    pub(crate) fn depth(&self, joint: usize) -> usize {
        let parent = |node: &usize| self.0.nodes[*node].parent;
        std::iter::successors(parent(&self.0.joints[joint].node), parent).count()
    }

    /// From bind space to the world [m] for each joint at a time [s].
    pub fn joint_matrices(&self, time: f64) -> Vec<DMat4> {
        let world = self.node_transforms(time);
        let metres = DMat4::from_scale(DVec3::splat(self.0.metres_per_unit));
        self.0.joints.iter().map(|joint| metres * world[joint.node] * joint.inverse_bind).collect()
    }

    /// World transform of each node at a time [s], in the unit of the rig.
    pub fn node_transforms(&self, time: f64) -> Vec<DMat4> {
        self.0.node_transforms(self.clip_time(time))
    }

    /// Weight of each morph target [1] at a time [s].
    pub fn morph_weights(&self, time: f64) -> Vec<f64> {
        self.0.morph_weights(self.clip_time(time))
    }

    /// Length of the clip [s]; 0 without one.
    pub fn duration(&self) -> f64 {
        self.0.duration()
    }

    /// Whether the clip ends as it starts, every joint within 1 mm and a thousandth in turn and scale, every morph weight
    /// within a thousandth. Then it repeats. A rig without a clip and one of rigid keys are not closed.
    pub fn is_closed(&self) -> bool {
        self.0.is_closed
    }

    /// The joints, in the order of [`Pose::joints`].
    pub fn joints(&self) -> &[Joint] {
        &self.0.joints
    }

    /// Names of the joints, in the order of [`Pose::joints`].
    pub fn joint_names(&self) -> impl Iterator<Item = &str> {
        self.0.joints.iter().map(|joint| joint.name.as_str())
    }

    /// The nodes, which [`Joint::node`] and channels point into.
    pub fn nodes(&self) -> &[RigNode] {
        &self.0.nodes
    }

    /// Length of the unit of the rig [m].
    pub fn metres_per_unit(&self) -> f64 {
        self.0.metres_per_unit
    }

    /// The clip, if anything moves.
    pub fn clip(&self) -> Option<&Clip> {
        self.0.clip.as_ref()
    }

    /// The time in the clip at a time of the scene [s].
    fn clip_time(&self, time: f64) -> f64 {
        let duration = self.duration();
        if self.is_closed() && time > duration { time.rem_euclid(duration) } else { time }
    }
}

/// Keys from one value to another by the cubic 3s² − 2s³ of the share s of the time.
fn gentle<T: Between + Copy>(from: T, to: T, seconds: f64) -> Keys<T> {
    const KEY_COUNT: u32 = 16;
    let shares = || (0..=KEY_COUNT).map(|k| f64::from(k) / f64::from(KEY_COUNT));
    Keys {
        interpolation: Interpolation::Linear,
        times: shares().map(|share| share * seconds).collect(),
        values: shares().map(|share| from.between(to, share * share * (3.0 - 2.0 * share))).collect(),
    }
}

impl Parts {
    fn duration(&self) -> f64 {
        self.clip.as_ref().map_or(0.0, |clip| clip.duration)
    }

    /// Transform of each node relative to its parent at a time of the clip [s].
    fn local_transforms(&self, time: f64) -> Vec<LocalTransform> {
        let mut local: Vec<LocalTransform> = self.nodes.iter().map(|node| node.transform).collect();
        for channel in self.clip.iter().flat_map(|clip| &clip.channels) {
            let (Channel::Translation { node, .. } | Channel::Rotation { node, .. } | Channel::Scale { node, .. }) =
                channel
            else {
                continue;
            };
            let LocalTransform::Parts { translation, rotation, scale } = &mut local[*node] else {
                unreachable!("a channel moves a node with parts");
            };
            match channel {
                Channel::Translation { keys, .. } => *translation = keys.at(time),
                Channel::Rotation { keys, .. } => *rotation = keys.at(time),
                Channel::Scale { keys, .. } => *scale = keys.at(time),
                Channel::MorphWeight { .. } => {}
            }
        }
        local
    }

    fn node_transforms(&self, time: f64) -> Vec<DMat4> {
        let local = self.local_transforms(time);
        let mut world = vec![DMat4::IDENTITY; local.len()];
        for node in &self.order {
            let matrix = local[*node].matrix();
            world[*node] = match self.nodes[*node].parent {
                Some(parent) => world[parent] * matrix,
                None => matrix,
            };
        }
        world
    }

    fn morph_weights(&self, time: f64) -> Vec<f64> {
        let mut weights = self.morph_weights.clone();
        for channel in self.clip.iter().flat_map(|clip| &clip.channels) {
            if let Channel::MorphWeight { target, keys } = channel {
                weights[*target] = keys.at(time);
            }
        }
        weights
    }

    fn ends_as_it_starts(&self) -> bool {
        if self.duration() <= 0.0 {
            return false;
        }
        let [start, end] = [0.0, self.duration()].map(|time| self.node_transforms(time));
        let stands = |joint: &Joint| {
            let [a, b] = [start[joint.node], end[joint.node]];
            let distance = a.w_axis.truncate().distance(b.w_axis.truncate()) * self.metres_per_unit;
            let axes = |m: DMat4| [m.x_axis, m.y_axis, m.z_axis].map(|axis| axis.truncate());
            let change = axes(b - a).into_iter().zip(axes(a));
            // Against the size of the start, because the unit of a joint need not be the metre.
            let turned = change.map(|(change, axis)| change.length() - CLOSED_TURN * axis.length()).fold(0.0, f64::max);
            distance <= CLOSED_DISTANCE && turned <= 0.0
        };
        let [first, last] = [0.0, self.duration()].map(|time| self.morph_weights(time));
        let mixed = first.iter().zip(&last).all(|(a, b)| (a - b).abs() <= CLOSED_TURN);
        self.joints.iter().all(stands) && mixed
    }
}

/// Every node after its parent.
fn parents_first(nodes: &[RigNode]) -> Result<Vec<usize>, OwnAncestor> {
    let mut placed = vec![false; nodes.len()];
    let mut order = Vec::with_capacity(nodes.len());
    for node in 0..nodes.len() {
        let mut path = Vec::new();
        let mut next = Some(node);
        while let Some(open) = next.filter(|open| !placed[*open]) {
            if path.len() == nodes.len() {
                return Err(OwnAncestor { node });
            }
            path.push(open);
            next = nodes[open].parent;
        }
        for open in path.into_iter().rev() {
            placed[open] = true;
            order.push(open);
        }
    }
    Ok(order)
}

#[cfg(test)]
mod tests {
    use super::{Joint, LocalTransform, OwnAncestor, Rig, RigNode};
    use crate::{Channel, Clip, Interpolation, Keys, RigidKey, RigidMotion};
    use glam::{DMat4, DQuat, DVec3, dvec3};
    use std::f64::consts::TAU;

    fn node(parent: Option<usize>) -> RigNode {
        RigNode { parent, transform: LocalTransform::IDENTITY }
    }

    fn joint(node: usize) -> Joint {
        Joint { name: format!("joint {node}"), node, inverse_bind: DMat4::IDENTITY }
    }

    /// One joint, in a unit of half a metre, that turns about y over a second and goes along x.
    fn turning(end: DQuat, far: f64) -> Rig {
        let third = |angle: f64| DQuat::from_rotation_y(angle * TAU / 3.0);
        let linear = Interpolation::Linear;
        let rotation = Keys {
            interpolation: linear,
            times: vec![0.0, 0.4, 0.7, 1.0],
            values: vec![third(0.0), third(1.0), third(2.0), end],
        };
        let translation =
            Keys { interpolation: linear, times: vec![0.0, 1.0], values: vec![DVec3::ZERO, dvec3(far, 0.0, 0.0)] };
        let channels =
            vec![Channel::Rotation { node: 0, keys: rotation }, Channel::Translation { node: 0, keys: translation }];
        let clip = Clip { name: "turn".into(), duration: 1.0, channels };
        Rig::new(vec![node(None)], vec![joint(0)], vec![], Some(clip), 0.5).expect("no circle")
    }

    #[test]
    fn a_parent_carries_its_children_in_any_order() {
        let moved = |parent, x| RigNode {
            parent,
            transform: LocalTransform::Parts {
                translation: dvec3(x, 0.0, 0.0),
                rotation: DQuat::from_rotation_z(TAU / 4.0),
                scale: DVec3::splat(2.0),
            },
        };
        let nodes = vec![moved(Some(2), 1.0), node(None), moved(None, 10.0)];
        let rig = Rig::new(nodes, vec![joint(0)], vec![], None, 0.1).expect("no circle");
        // The child stands 1 along its parent's x, which points up and is twice as long.
        let centre = rig.joint_matrices(0.0)[0].transform_point3(DVec3::ZERO);
        assert!(centre.distance(dvec3(1.0, 0.2, 0.0)) < 1e-12, "{centre}");
        let tip = rig.joint_matrices(0.0)[0].transform_vector3(DVec3::X);
        assert!(tip.distance(dvec3(-0.4, 0.0, 0.0)) < 1e-12, "{tip}");
        let rows = rig.pose(0.0).joints[0];
        assert_eq!([rows[0].w, rows[1].w], [1.0, 0.2]);
    }

    #[test]
    fn a_joint_turns_about_its_own_place_and_takes_along_what_it_carries() {
        let quarter = DQuat::from_rotation_z(TAU / 4.0);
        let placed = |parent, x, rotation| RigNode {
            parent,
            transform: LocalTransform::Parts { translation: dvec3(x, 0.0, 0.0), rotation, scale: DVec3::splat(2.0) },
        };
        // A trunk that is turned itself, an arm and a hand, each one unit along the x of what carries it.
        let nodes =
            vec![placed(None, 1.0, quarter), placed(Some(0), 1.0, quarter), placed(Some(1), 1.0, DQuat::IDENTITY)];
        let rig = Rig::new(nodes, vec![joint(0), joint(1), joint(2)], vec![], None, 0.5).expect("no circle");
        let places = |rig: &Rig| [0, 1, 2].map(|joint| rig.joint_place(joint, 0.0).w_axis.truncate());
        let before = places(&rig);
        let turn = DQuat::from_rotation_x(0.7);
        let turned = rig.with_joint_turned(1, turn).expect("it has parts");
        let [trunk, arm, hand] = places(&turned);
        assert!(trunk.distance(before[0]) < 1e-12 && arm.distance(before[1]) < 1e-12, "{trunk} {arm}");
        let expected = before[1] + turn * (before[2] - before[1]);
        assert!((before[2] - before[1]).length() > 1.0 && hand.distance(expected) < 1e-12, "{hand} {expected}");
        let fixed = RigNode { parent: None, transform: LocalTransform::Matrix(DMat4::IDENTITY) };
        let fixed = Rig::new(vec![fixed], vec![joint(0)], vec![], None, 1.0).expect("no circle");
        assert!(fixed.with_joint_turned(0, turn).is_none());
    }

    #[test]
    fn a_circle_of_parents_is_refused() {
        let circle = vec![node(None), node(Some(2)), node(Some(1))];
        assert_eq!(Rig::new(circle, vec![], vec![], None, 1.0).expect_err("a circle"), OwnAncestor { node: 1 });
    }

    #[test]
    fn a_clip_is_closed_when_turn_and_place_return() {
        let whole = DQuat::from_rotation_y(TAU);
        assert!(turning(whole, 0.0).is_closed());
        // The unit is half a metre: 1.9 mm in the file are 0.95 mm in the world.
        assert!(turning(whole, 0.0019).is_closed());
        assert!(!turning(whole, 0.0021).is_closed());
        assert!(turning(DQuat::from_rotation_y(TAU + 0.0009), 0.0).is_closed());
        assert!(!turning(DQuat::from_rotation_y(TAU + 0.0011), 0.0).is_closed());
    }

    #[test]
    fn a_closed_clip_repeats_and_an_open_one_stands_still() {
        let closed = turning(DQuat::from_rotation_y(TAU), 0.0);
        assert_eq!(closed.pose(3.25), closed.pose(0.25));
        assert_ne!(closed.pose(0.25), closed.pose(0.0));
        let open = turning(DQuat::from_rotation_y(5.0), 0.0);
        assert_eq!(open.pose(3.25), open.pose(1.0));
        assert_eq!(open.pose(-1.0), open.pose(0.0));
    }

    #[test]
    fn morph_weights_rest_or_follow_their_channel() {
        let keys = Keys { interpolation: Interpolation::Linear, times: vec![0.0, 2.0], values: vec![0.0, 1.0] };
        let channels = vec![Channel::MorphWeight { target: 1, keys }];
        let clip = Clip { name: String::new(), duration: 2.0, channels };
        let rig = Rig::new(vec![], vec![], vec![0.25, 0.5], Some(clip), 1.0).expect("no circle");
        assert_eq!(rig.pose(0.5).morph_weights, [0.25, 0.25]);
        assert!(!rig.is_closed());
    }

    #[test]
    fn a_rigid_rig_moves_as_its_keys_say_and_does_not_repeat() {
        let key = |time, x, angle| RigidKey {
            time,
            translation: dvec3(x, 0.0, 0.0),
            rotation: DQuat::from_rotation_y(angle),
        };
        let keys = vec![key(0.5, 0.0, 0.0), key(1.0, 1.0, 2.0), key(2.0, 0.0, 0.0)];
        let motion = RigidMotion { keys: keys.clone() };
        let rig = Rig::rigid(keys);
        assert_eq!((rig.duration(), rig.is_closed()), (2.0, false));
        for time in [0.0, 0.6, 1.0, 1.9, 2.7] {
            let (translation, rotation) = motion.at(time);
            let expected = DMat4::from_rotation_translation(rotation, translation);
            assert!(rig.joint_matrices(time)[0].abs_diff_eq(expected, 1e-12), "{time}");
        }
        assert_eq!(rig.pose(2.7), rig.pose(0.0));
        assert_eq!(Rig::rigid(Vec::new()).joint_matrices(1.0), [DMat4::IDENTITY]);
    }
}
