//! Motions that no file has: clips that are made for the built-in woman, and bodies that are carried along a way.

use glam::{DQuat, DVec3};
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

/// Parts of the way from one stance to the next, which begins and ends gently.
const PARTS: u32 = 12;

/// A body that goes from stance to stance, gently; the joint that `first` names carries the shift.
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
            Channel::Rotation { node: node(name), keys: gentle(stances, &values, |a, b, share| a.slerp(b, share)) }
        })
        .collect();
    let (place, ..) = rest(rig, node(first));
    let unit = rig.metres_per_unit();
    let places: Vec<DVec3> = stances.iter().map(|stance| place + stance.shift / unit).collect();
    channels.push(Channel::Translation {
        node: node(first),
        keys: gentle(stances, &places, |a, b, share| a.lerp(b, share)),
    });
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

/// Keys that go from value to value by the cubic 3s² − 2s³ of the share s of the time.
fn gentle<T: Copy>(stances: &[Stance<'_>], values: &[T], between: impl Fn(T, T, f64) -> T) -> Keys<T> {
    let mut keys = Keys { interpolation: Interpolation::Linear, times: vec![stances[0].time], values: vec![values[0]] };
    for (times, ends) in stances.windows(2).zip(values.windows(2)) {
        for part in 1..=PARTS {
            let share = f64::from(part) / f64::from(PARTS);
            keys.times.push(times[0].time + share * (times[1].time - times[0].time));
            keys.values.push(between(ends[0], ends[1], share * share * (3.0 - 2.0 * share)));
        }
    }
    keys
}

fn skinned(body: &MovingMesh) -> (&Skin, &Rig) {
    match &body.motion {
        Motion::Skinned { skin, rig } => (skin, rig),
        Motion::Sequence(_) => panic!("the body has joints"),
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
