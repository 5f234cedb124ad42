//! Motions that no file has: clips that are made for the built-in woman, and bodies that are carried along a way.

use glam::{DQuat, DVec3, dvec3};
use std::f64::consts::{FRAC_PI_2, TAU};
use toile::scene::{
    Channel, Clip, Interpolation, Keys, LocalTransform, Motion, MovingMesh, Rig, RigNode, RigidKey, Skin,
};

/// How a body stands at a time, beside its rest pose.
#[derive(Clone, Debug)]
pub struct Stance<'a> {
    /// Time [s].
    pub time: f64,
    /// Joints by name and how each is turned against its rest, in the axes of its parent.
    pub turns: Vec<(&'a str, DQuat)>,
    /// How far the first joint is shifted against its rest [m].
    pub shift: DVec3,
}

/// Parts of the way from one share of a stance to the next.
const PARTS: u32 = 12;

/// A body that goes straight from stance to stance; the joint that `first` names carries the shift.
///
/// # Panics
/// When the body has no joints, or none of a name.
pub fn posed(body: &MovingMesh, first: &str, stances: &[Stance<'_>]) -> MovingMesh {
    let (skin, rig) = skinned(body);
    let node = |name: &str| {
        let joint = rig.joints().iter().find(|joint| joint.name == name);
        joint.unwrap_or_else(|| panic!("the body has no joint {name}")).node
    };
    let mut names: Vec<&str> = stances.iter().flat_map(|stance| stance.turns.iter().map(|(name, _)| *name)).collect();
    names.sort_unstable();
    names.dedup();
    let turn = |stance: &Stance<'_>, name: &str| {
        let (_, rotation, _) = rest(rig, node(name));
        let turns = stance.turns.iter().filter(|(turned, _)| *turned == name);
        turns.fold(rotation, |rotation, (_, turn)| *turn * rotation)
    };
    let mut channels: Vec<Channel> = names
        .iter()
        .map(|name| {
            let values: Vec<DQuat> = stances.iter().map(|stance| turn(stance, name)).collect();
            Channel::Rotation { node: node(name), keys: straight(stances, values) }
        })
        .collect();
    let (place, ..) = rest(rig, node(first));
    let unit = rig.metres_per_unit();
    let places: Vec<DVec3> = stances.iter().map(|stance| place + stance.shift / unit).collect();
    channels.push(Channel::Translation { node: node(first), keys: straight(stances, places) });
    let duration = stances.last().map_or(0.0, |stance| stance.time);
    moving(body, skin, rig, rig.nodes().to_vec(), Clip { name: "stances".to_owned(), duration, channels })
}

/// A body that goes through its motion again and again while it is carried along keys, which turn it about the origin first.
///
/// # Panics
/// When the body has no joints, or there is no key.
pub fn carried(body: &MovingMesh, keys: &[RigidKey]) -> MovingMesh {
    let (skin, rig) = skinned(body);
    let duration = keys.last().expect("a way has a key").time;
    let round = if rig.is_closed() { rig.duration() } else { f64::INFINITY };
    let mut channels = rig.clip().map_or_else(Vec::new, |clip| clip.channels.clone());
    for channel in &mut channels {
        match channel {
            Channel::Translation { keys, .. } | Channel::Scale { keys, .. } => repeat(keys, round, duration),
            Channel::Rotation { keys, .. } => repeat(keys, round, duration),
            Channel::MorphWeight { keys, .. } => repeat(keys, round, duration),
        }
    }
    let carrier = rig.nodes().len();
    let mut nodes: Vec<RigNode> = rig.nodes().to_vec();
    for node in &mut nodes {
        node.parent = node.parent.or(Some(carrier));
    }
    nodes.push(RigNode { parent: None, transform: LocalTransform::IDENTITY });
    let times: Vec<f64> = keys.iter().map(|key| key.time).collect();
    let unit = rig.metres_per_unit();
    let way = keys.iter().map(|key| key.translation / unit).collect();
    let turns = keys.iter().map(|key| key.rotation).collect();
    let interpolation = Interpolation::Linear;
    channels
        .push(Channel::Translation { node: carrier, keys: Keys { interpolation, times: times.clone(), values: way } });
    channels.push(Channel::Rotation { node: carrier, keys: Keys { interpolation, times, values: turns } });
    moving(body, skin, rig, nodes, Clip { name: "carried".to_owned(), duration, channels })
}

/// Keys of a round that repeats until a time [s].
fn repeat<T: Clone>(keys: &mut Keys<T>, round: f64, until: f64) {
    let per_key = keys.values.len() / keys.times.len();
    let (times, values) = (keys.times.clone(), keys.values.clone());
    let mut start = round;
    while start < until {
        // The first key of a round is the last of the one before.
        keys.times.extend(times.iter().skip(1).map(|time| start + time));
        keys.values.extend(values.iter().skip(per_key).cloned());
        start += round;
    }
}

/// Stances at shares of a whole [1] at times [s], gently begun and stopped in between.
fn eased(profile: &[(f64, f64)], stance: impl Fn(f64, f64) -> Stance<'static>) -> Vec<Stance<'static>> {
    let mut stances = vec![stance(profile[0].0, profile[0].1)];
    for ends in profile.windows(2) {
        let [(start, from), (end, to)] = [ends[0], ends[1]];
        stances.extend((1..=PARTS).map(|part| {
            let part = f64::from(part) / f64::from(PARTS);
            stance(start + part * (end - start), from + smooth(part) * (to - from))
        }));
    }
    stances
}

/// Values at the times of the stances.
fn straight<T>(stances: &[Stance<'_>], values: Vec<T>) -> Keys<T> {
    let times = stances.iter().map(|stance| stance.time).collect();
    Keys { interpolation: Interpolation::Linear, times, values }
}

fn skinned(body: &MovingMesh) -> (&Skin, &Rig) {
    match &body.motion {
        Motion::Skinned { skin, rig } => (skin, rig),
        Motion::Sequence(_) | Motion::Hosted => panic!("the body has joints"),
    }
}

/// Translation in the unit of the rig, rotation and scale of a node at rest.
fn rest(rig: &Rig, node: usize) -> (DVec3, DQuat, DVec3) {
    match rig.nodes()[node].transform {
        LocalTransform::Parts { translation, rotation, scale } => (translation, rotation, scale),
        LocalTransform::Matrix(_) => panic!("a joint that is turned has parts"),
    }
}

/// The body with other nodes and another clip.
fn moving(body: &MovingMesh, skin: &Skin, rig: &Rig, nodes: Vec<RigNode>, clip: Clip) -> MovingMesh {
    let (joints, weights) = (rig.joints().to_vec(), rig.at_rest().morph_weights(0.0));
    let rig = Rig::new(nodes, joints, weights, Some(clip), rig.metres_per_unit()).expect("a tree stays a tree");
    let mut moving = MovingMesh { mesh: body.mesh.clone(), motion: Motion::Skinned { skin: skin.clone(), rig } };
    moving.mesh = moving.at(0.0);
    moving
}

/// Speed of the built-in woman's walk [m/s].
const WALKING_SPEED: f64 = 0.96;

/// How often a way is given [1/s].
const WAY_RATE: f64 = 30.0;

/// A motion that is made for the built-in woman, whose walk is `walk_loop` and whose rest has the arms 45° down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Made {
    /// She walks straight on, turns left by 90° within a second, and walks straight on.
    Corner,
    /// She walks on the spot and turns to the left by 90° a second all the while.
    Turning,
    /// She stands, folds her arms before her, and lets them down.
    ArmsFolded,
    /// She sits down on no chair and stands up again.
    Sitting,
    /// She stretches out her arms and turns on the spot, in the end once a second.
    Pirouette,
}

impl Made {
    /// The motion of the built-in woman, who comes with her `walk_loop`.
    ///
    /// # Panics
    /// When it is another body.
    pub fn of(self, woman: &MovingMesh) -> MovingMesh {
        match self {
            Self::Corner => {
                let heading = |time: f64| smooth((time - 1.5).clamp(0.0, 1.0)) * FRAC_PI_2;
                carried(woman, &way(4.0, WALKING_SPEED, heading))
            }
            Self::Turning => carried(woman, &way(4.0, 0.0, |time| time * FRAC_PI_2)),
            Self::ArmsFolded => {
                posed(woman, "pelvis", &eased(&[(0.0, 0.0), (1.2, 1.0), (2.2, 1.0), (3.4, 0.0), (4.0, 0.0)], folded))
            }
            Self::Sitting => {
                posed(woman, "pelvis", &eased(&[(0.0, 0.0), (0.3, 0.0), (1.8, 1.0), (2.8, 1.0), (4.3, 0.0)], seated))
            }
            Self::Pirouette => {
                let arms = posed(woman, "pelvis", &[stretched(0.0), stretched(5.0)]);
                // Faster and faster for a second, then once in a second.
                let angle = |time: f64| TAU * (0.5 * time.min(1.0).powi(2) + (time - 1.0).max(0.0));
                carried(&arms, &way(5.0, 0.0, angle))
            }
        }
    }
}

/// The cubic 3s² − 2s³ of a share s.
fn smooth(share: f64) -> f64 {
    share * share * (3.0 - 2.0 * share)
}

/// A way of some seconds at a speed [m/s], whose heading from +z to +x is given at every time [rad].
fn way(seconds: f64, speed: f64, heading: impl Fn(f64) -> f64) -> Vec<RigidKey> {
    let mut place = DVec3::ZERO;
    let keys = 0..=(seconds * WAY_RATE).round() as u32;
    keys.map(|key| {
        let time = f64::from(key) / WAY_RATE;
        let rotation = DQuat::from_rotation_y(heading(time));
        let here = RigidKey { time, translation: place, rotation };
        place += rotation * DVec3::Z * (speed / WAY_RATE);
        here
    })
    .collect()
}

/// Both sides of the body turned alike: about x, and against one another about y and z, by vectors of angles [degrees].
fn sides(joints: [&'static str; 2], angles: DVec3) -> [(&'static str, DQuat); 2] {
    let turn = |angles: DVec3| DQuat::from_scaled_axis(angles * TAU / 360.0);
    [(joints[0], turn(angles)), (joints[1], turn(angles * dvec3(1.0, -1.0, -1.0)))]
}

/// The forearms lie across the belly, the left above the right.
fn folded(time: f64, share: f64) -> Stance<'static> {
    // At rest upper arm and forearm lie in one line, 45° down.
    let arm = |joints: [&'static str; 2], side: f64, forearm: DVec3| {
        let rest = dvec3(side, -1.0, 0.0).normalize();
        let upper = DQuat::from_rotation_arc(rest, dvec3(0.25 * side, -0.9, 0.35).normalize());
        let across = DQuat::from_rotation_arc(upper * rest, forearm.normalize());
        // In the axes of the upper arm, which turns too.
        let lower = upper.conjugate() * across * upper;
        [(joints[0], DQuat::IDENTITY.slerp(upper, share)), (joints[1], DQuat::IDENTITY.slerp(lower, share))]
    };
    let left = arm(["upperarm_l", "lowerarm_l"], 1.0, dvec3(-0.85, 0.25, 0.5));
    let right = arm(["upperarm_r", "lowerarm_r"], -1.0, dvec3(0.85, -0.1, 0.45));
    Stance { time, turns: [left, right].concat(), shift: DVec3::ZERO }
}

/// Thighs level, shins upright, the trunk a little forward; the feet stay where they are.
fn seated(time: f64, share: f64) -> Stance<'static> {
    // From hip to knee; the shins stay upright.
    let thigh = dvec3(0.0, -0.3632, 0.0311);
    let angle = 85.0 * share;
    let mut turns = sides(["thigh_l", "thigh_r"], dvec3(-angle, 0.0, 0.0)).to_vec();
    turns.extend(sides(["calf_l", "calf_r"], dvec3(angle, 0.0, 0.0)));
    turns.push(("spine_01", DQuat::from_rotation_x(0.2 * share)));
    Stance { time, turns, shift: thigh - DQuat::from_rotation_x(-angle.to_radians()) * thigh }
}

/// The arms are level.
fn stretched(time: f64) -> Stance<'static> {
    Stance { time, turns: sides(["upperarm_l", "upperarm_r"], dvec3(0.0, 0.0, 45.0)).to_vec(), shift: DVec3::ZERO }
}
