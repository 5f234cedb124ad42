//! Points against the depth and normal maps of the body. W §4.4, eq. 11 and 12.

use crate::Probe;
use crate::maps::BodyMaps;
use glam::{Vec3, vec3};
use toile_model::StepSettings;

/// How far in front of a surface its texels still answer, in texels: on a slope the plane through a texel's centre reaches
/// out of the depth range of the texel.
const REACH: f32 = 4.0;

/// How much deeper than the least deep of four texels another may be and still belong to the same surface, in texels.
const SAME_SURFACE: f32 = 2.0;

/// The surface that each point meets after the coming move, or none. All arrays have the shape [point_count].
///
/// A point is inside when it lies between the front and the back of its texel; the nearer side answers, by the tangent plane
/// at the texel's centre. The planes of the four texels around the point are blended bilinearly, so that the
/// surface has no steps. W §4.4, eq. 11 and 12.
pub fn sample_maps(positions: &[Vec3], velocities: &[Vec3], maps: &BodyMaps, settings: &StepSettings) -> Vec<Probe> {
    positions
        .iter()
        .zip(velocities)
        .map(|(&position, &velocity)| sample(position, position + velocity * settings.dt, maps))
        .map(Option::unwrap_or_default)
        .collect()
}

/// `position` now, `next` after the coming move.
fn sample(position: Vec3, next: Vec3, maps: &BodyMaps) -> Option<Probe> {
    let frame = &maps.frame;
    let across = (next.x - frame.origin_x) / frame.texel - 0.5;
    let down = (frame.origin_y - next.y) / frame.texel - 0.5;
    let [left, top] = [across.floor(), down.floor()];
    if !(left >= 0.0 && left + 1.0 < frame.columns as f32 && top >= 0.0 && top + 1.0 < frame.rows as f32) {
        return None;
    }
    let [right_share, bottom_share] = [across - left, down - top];
    let corners = [
        (left, top, (1.0 - right_share) * (1.0 - bottom_share)),
        (left + 1.0, top, right_share * (1.0 - bottom_share)),
        (left, top + 1.0, (1.0 - right_share) * bottom_share),
        (left + 1.0, top + 1.0, right_share * bottom_share),
    ];
    let planes = corners.map(|(column, row, _)| plane(position, next, column, row, maps));
    let mut nearest = -1e9;
    for plane in planes.iter().filter(|plane| plane.hit) {
        nearest = plane.distance.max(nearest);
    }
    let mut weight_sum = 0.0;
    let mut normal = Vec3::ZERO;
    let mut distance = 0.0;
    let mut velocity = Vec3::ZERO;
    for (plane, (_, _, weight)) in planes.iter().zip(corners) {
        if plane.hit && plane.distance >= nearest - SAME_SURFACE * frame.texel {
            weight_sum += weight;
            normal += plane.normal * weight;
            distance += plane.distance * weight;
            velocity += plane.velocity * weight;
        }
    }
    let length = normal.length();
    if !(weight_sum > 0.0 && length > 0.0) {
        return None;
    }
    Some(Probe { normal: normal / length, distance: distance / weight_sum, velocity: velocity / weight_sum, hit: true })
}

/// What one texel says: the plane through its centre on the nearer side.
fn plane(position: Vec3, next: Vec3, column: f32, row: f32, maps: &BodyMaps) -> Probe {
    let frame = &maps.frame;
    let texel = row as usize * frame.columns as usize + column as usize;
    let [depth_front, depth_back] = [maps.depth[0][texel], maps.depth[1][texel]];
    if !(depth_front < 1.0 && depth_back < 1.0) {
        return Probe::default();
    }
    let range = frame.z_front - frame.z_back;
    let front = frame.z_front - depth_front * range;
    let back = frame.z_back + depth_back * range;
    let reach = REACH * frame.texel;
    if !(next.z < front + reach && next.z > back - reach) {
        return Probe::default();
    }
    let x = frame.origin_x + (column + 0.5) * frame.texel;
    let y = frame.origin_y - (row + 0.5) * frame.texel;
    let distance_front = maps.normals[0][texel].dot(position - vec3(x, y, front));
    let distance_back = maps.normals[1][texel].dot(position - vec3(x, y, back));
    let (side, distance) = if distance_front >= distance_back { (0, distance_front) } else { (1, distance_back) };
    Probe {
        normal: maps.normals[side][texel],
        distance,
        velocity: maps.velocities.as_ref().map_or(Vec3::ZERO, |layers| layers[side][texel]),
        hit: true,
    }
}
