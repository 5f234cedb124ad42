//! Points against the depth and normal maps of the body. W §4.4, eq. 11 and 12.

use crate::Probe;
use crate::maps::BodyMaps;
use glam::{Vec3, vec3};
use toile_model::StepSettings;

/// The surface that each point meets after the coming move, or none. All arrays have the shape [point_count].
///
/// A point is inside when it then lies between the front and the back depth of its texel; the nearer side answers, by the
/// tangent plane at the texel's centre. W §4.4, eq. 11 and 12.
pub fn sample_maps(positions: &[Vec3], velocities: &[Vec3], maps: &BodyMaps, settings: &StepSettings) -> Vec<Probe> {
    positions
        .iter()
        .zip(velocities)
        .map(|(&position, &velocity)| sample(position, position + velocity * settings.dt, maps, settings))
        .map(Option::unwrap_or_default)
        .collect()
}

/// `position` now, `next` after the coming move.
fn sample(position: Vec3, next: Vec3, maps: &BodyMaps, settings: &StepSettings) -> Option<Probe> {
    let frame = &maps.frame;
    let slack = settings.contact_margin;
    let column = ((next.x - frame.origin_x) / frame.texel).floor();
    let row = ((frame.origin_y - next.y) / frame.texel).floor();
    if !(column >= 0.0 && column < frame.columns as f32 && row >= 0.0 && row < frame.rows as f32) {
        return None;
    }
    let texel = row as usize * frame.columns as usize + column as usize;
    let [depth_front, depth_back] = [maps.depth[0][texel], maps.depth[1][texel]];
    if !(depth_front < 1.0 && depth_back < 1.0) {
        return None;
    }
    let range = frame.z_front - frame.z_back;
    let front = frame.z_front - depth_front * range;
    let back = frame.z_back + depth_back * range;
    if !(next.z < front + slack && next.z > back - slack) {
        return None;
    }
    let x = frame.origin_x + (column + 0.5) * frame.texel;
    let y = frame.origin_y - (row + 0.5) * frame.texel;
    let distance_front = maps.normals[0][texel].dot(position - vec3(x, y, front));
    let distance_back = maps.normals[1][texel].dot(position - vec3(x, y, back));
    let (side, distance) = if distance_front >= distance_back { (0, distance_front) } else { (1, distance_back) };
    Some(Probe {
        normal: maps.normals[side][texel],
        distance,
        velocity: maps.velocities.as_ref().map_or(Vec3::ZERO, |layers| layers[side][texel]),
        hit: true,
    })
}
