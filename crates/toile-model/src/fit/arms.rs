//! Arms that seams would close around are raised while a garment is sewn.

use super::figure::Figure;
use super::laid::Laid;
use super::section::Skin;
use super::sleeves;
use crate::Inside;
use glam::{DMat4, DQuat, DVec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use toile_scene::{
    EdgeRef, Garment, Influence, Joint, LocalTransform, Mesh, Motion, MovingMesh, Rig, RigNode, Skin as Bound,
};

/// Distance of the points on the ways of seams [m].
const STEP: f64 = 0.01;
/// An arm that points down by less than this is raised already [°].
const LEVEL: f64 = 10.0;
/// The part of an arm that its joint carries at least [1].
const CARRIED: f64 = 0.9;
/// How far a shoulder joint stands from the middle, in half widths of the trunk [1].
const SHOULDER: f64 = 0.95;
/// Over this way along an arm, by the height of the person [1], a mesh without joints begins to go with it.
const BLEND: f64 = 0.03;

/// Number of points on the straight ways of a garment's seams that lie in an arm which no sleeve of it is for. What is sewn there would
/// close around the arm.
pub(crate) fn in_the_way(garment: &Garment, laid: &[Laid], figure: &Figure, inside: &Inside) -> usize {
    let has_sleeve = [true, false].map(|is_left| !sleeves::panels(garment, laid, figure, is_left).is_empty());
    let is_in_arm = |place: &DVec3| {
        let sleeve = has_sleeve[usize::from(figure.leftward(*place) <= 0.0)];
        !sleeve && figure.is_arm(*place) && inside.holds(*place)
    };
    garment.seams.iter().flat_map(|seam| ways(garment, &seam.sides)).filter(is_in_arm).count()
}

/// Points on the straight ways from one edge of a seam to the other, as they are placed [m].
fn ways(garment: &Garment, sides: &[EdgeRef; 2]) -> Vec<DVec3> {
    let [one, mut other] = sides.map(|side| {
        let panel = &garment.panels[side.panel];
        panel.polyline(side.edge, STEP).into_iter().map(|flat| panel.placement.world(flat)).collect::<Vec<_>>()
    });
    let ends = |line: &[DVec3]| Some([*line.first()?, *line.last()?]);
    let (Some([a, b]), Some([c, d])) = (ends(&one), ends(&other)) else { return Vec::new() };
    if a.distance_squared(d) + b.distance_squared(c) < a.distance_squared(c) + b.distance_squared(d) {
        other.reverse();
    }
    let points = (length(&one).max(length(&other)) / STEP).ceil().max(1.0) as u32;
    (0..=points)
        .map(|point| f64::from(point) / f64::from(points))
        .flat_map(|share| {
            let [from, to] = [at(&one, share), at(&other, share)];
            let steps = (from.distance(to) / STEP).ceil().max(1.0) as u32;
            (1..steps).map(move |step| from.lerp(to, f64::from(step) / f64::from(steps)))
        })
        .collect()
}

/// Length of a line [m].
fn length(line: &[DVec3]) -> f64 {
    line.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
}

/// The place at a share of a line's length [m].
fn at(line: &[DVec3], share: f64) -> DVec3 {
    let mut left = share * length(line);
    for ends in line.windows(2) {
        let part = ends[0].distance(ends[1]);
        if left < part {
            return ends[0].lerp(ends[1], left / part);
        }
        left -= part;
    }
    line[line.len() - 1]
}

/// The same body with level arms; `None` where it is no person, where no joint of its rig carries an arm alone, and where the arms are level already.
pub(crate) fn raised(body: &MovingMesh) -> Option<MovingMesh> {
    let Motion::Skinned { skin: bound, rig } = &body.motion else { return None };
    let skin = Skin::of(&body.mesh);
    let figure = Figure::of(&skin)?;
    let turns: Vec<(usize, DQuat)> = [true, false]
        .into_iter()
        .filter_map(|is_left| {
            let turn = turn_to_level(&figure, &skin, is_left)?;
            Some((shoulder(body, bound, rig, &figure, is_left)?, turn))
        })
        .collect();
    if turns.is_empty() {
        return None;
    }
    let rig = turns.into_iter().try_fold(rig.clone(), |rig, (joint, turn)| rig.with_joint_turned(joint, turn))?;
    let mut raised = MovingMesh { mesh: body.mesh.clone(), motion: Motion::Skinned { skin: bound.clone(), rig } };
    raised.mesh = raised.at(0.0);
    Some(raised)
}

/// The turn about the world's axes that brings an arm to level; `None` where it is, or stands not off from the trunk.
fn turn_to_level(figure: &Figure, skin: &Skin, is_left: bool) -> Option<DQuat> {
    let arm = figure.arm(skin, is_left)?.direction;
    let out = figure.out(is_left);
    let rise = arm.y.atan2(arm.dot(out));
    (rise < -LEVEL.to_radians()).then(|| DQuat::from_axis_angle(out.cross(DVec3::Y), -rise))
}

/// The joint that carries an arm and stands nearest to where shoulders are.
fn shoulder(body: &MovingMesh, bound: &Bound, rig: &Rig, figure: &Figure, is_left: bool) -> Option<usize> {
    let places = body.mesh.positions.iter().map(|place| place.as_dvec3()).enumerate();
    let arm: Vec<usize> = places
        .filter(|(_, place)| figure.is_arm(*place) && (figure.leftward(*place) > 0.0) == is_left)
        .map(|(vertex, _)| vertex)
        .collect();
    let mut carried = vec![0.0; rig.nodes().len()];
    for influence in arm.iter().flat_map(|vertex| bound.influences_of(*vertex)) {
        let own = Some(rig.joints()[influence.joint as usize].node);
        for node in std::iter::successors(own, |node| rig.nodes()[*node].parent) {
            carried[node] += f64::from(influence.weight);
        }
    }
    let away = |joint: usize| {
        let place = rig.joint_place(joint, 0.0).w_axis.truncate();
        let outward = if is_left { figure.leftward(place) } else { -figure.leftward(place) };
        (outward - SHOULDER * figure.half_width).abs()
    };
    let joints = rig.joints().iter().enumerate();
    joints
        .filter(|(_, joint)| !arm.is_empty() && carried[joint.node] >= CARRIED * arm.len() as f64)
        .map(|(index, _)| index)
        .min_by(|a, b| away(*a).total_cmp(&away(*b)))
        .filter(|joint| away(*joint) < 0.5 * figure.half_width)
}

/// A person that stands still, with joints at the shoulders; `None` where the mesh is none, or no arm of it stands off from the trunk.
pub(crate) fn jointed(mesh: &Mesh) -> Option<MovingMesh> {
    let skin = Skin::of(mesh);
    let figure = Figure::of(&skin)?;
    let mut nodes = vec![RigNode { parent: None, transform: LocalTransform::IDENTITY }];
    let mut joints = vec![Joint { name: "body".into(), node: 0, inverse_bind: DMat4::IDENTITY }];
    let mut shares = Vec::new();
    for (is_left, name) in [(true, "left arm"), (false, "right arm")] {
        let Some((pivot, share)) = share_of_arm(&skin, &figure, is_left) else { continue };
        let transform = LocalTransform::Parts { translation: pivot, rotation: DQuat::IDENTITY, scale: DVec3::ONE };
        joints.push(Joint { name: name.into(), node: nodes.len(), inverse_bind: DMat4::from_translation(-pivot) });
        nodes.push(RigNode { parent: Some(0), transform });
        shares.push(share);
    }
    if shares.is_empty() {
        return None;
    }
    let mut bound = Bound::rigid(mesh);
    bound.influences.clear();
    bound.influence_offsets.clear();
    bound.influence_offsets.push(0);
    for place in &skin.of_vertex {
        let of_arms: Vec<f32> = shares.iter().map(|share| share[*place as usize] as f32).collect();
        let rest = 1.0 - of_arms.iter().sum::<f32>();
        let influences = std::iter::once(rest).chain(of_arms).enumerate();
        bound.influences.extend(
            influences
                .filter(|(_, weight)| *weight > 0.0)
                .map(|(joint, weight)| Influence { joint: joint as u32, weight }),
        );
        bound.influence_offsets.push(bound.influences.len() as u32);
    }
    let rig = Rig::new(nodes, joints, Vec::new(), None, 1.0).ok()?;
    Some(MovingMesh { mesh: mesh.clone(), motion: Motion::Skinned { skin: bound, rig } })
}

/// Where an arm turns [m], and the share that it has in each place of the skin [1].
fn share_of_arm(skin: &Skin, figure: &Figure, is_left: bool) -> Option<(DVec3, Vec<f64>)> {
    let arm = figure.arm(skin, is_left)?;
    let out = figure.out(is_left);
    let outward = |place: DVec3| if is_left { figure.leftward(place) } else { -figure.leftward(place) };
    let slope = arm.direction.dot(out);
    let pivot = arm.start + arm.direction * ((SHOULDER * figure.half_width - outward(arm.start)) / slope.max(0.2));
    let along = |place: DVec3| (place - pivot).dot(arm.direction);
    let of_arm = |index: &usize| figure.is_arm(skin.places[*index]) && outward(skin.places[*index]) > 0.0;
    let hand = (0..skin.places.len())
        .filter(of_arm)
        .max_by(|a, b| along(skin.places[*a]).total_cmp(&along(skin.places[*b])))?;
    let ways = ways_along(skin, hand);
    // The sides of the trunk lie along the arm too, but not on the way from the hand to the shoulder.
    let blend = BLEND * figure.height();
    let (mut length, mut count) = (0.0, 0.0);
    for (place, way) in skin.places.iter().zip(&ways) {
        let aside = (*place - pivot - arm.direction * along(*place)).length();
        if along(*place).abs() < 0.5 * blend && aside < 2.0 * blend && way.is_finite() {
            length += way;
            count += 1.0;
        }
    }
    if count == 0.0 {
        return None;
    }
    let length = length / count;
    let smooth = |x: f64| {
        let x = x.clamp(0.0, 1.0);
        x * x * (3.0 - 2.0 * x)
    };
    let share = skin.places.iter().zip(&ways).map(|(place, way)| {
        smooth(0.5 + 0.5 * along(*place) / blend) * smooth(0.5 + 0.5 * (length + blend - way) / blend)
    });
    Some((pivot, share.collect()))
}

/// The length of the shortest way over edges from one place of the skin to each [m]; infinite where none leads there.
fn ways_along(skin: &Skin, from: usize) -> Vec<f64> {
    let mut neighbours = vec![Vec::new(); skin.places.len()];
    for triangle in &skin.triangles {
        for side in 0..3 {
            let [a, b] = [triangle[side] as usize, triangle[(side + 1) % 3] as usize];
            neighbours[a].push(b);
            neighbours[b].push(a);
        }
    }
    let mut ways = vec![f64::INFINITY; skin.places.len()];
    ways[from] = 0.0;
    // Lengths are not negative, so their bits are ordered as they are.
    let mut open = BinaryHeap::from([Reverse((0u64, from))]);
    while let Some(Reverse((bits, place))) = open.pop() {
        let way = f64::from_bits(bits);
        if way > ways[place] {
            continue;
        }
        for next in &neighbours[place] {
            let longer = way + skin.places[place].distance(skin.places[*next]);
            if longer < ways[*next] {
                ways[*next] = longer;
                open.push(Reverse((longer.to_bits(), *next)));
            }
        }
    }
    ways
}
