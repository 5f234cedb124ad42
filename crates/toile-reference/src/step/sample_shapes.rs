//! Points against the analytic shapes.

use crate::Probe;
use glam::{Vec3, Vec3Swizzles, vec3};
use std::cmp::Ordering;
use toile_model::{ShapeKind, ShapeStep, StepSettings};

/// Farther than anything [m].
const FAR: f32 = 1e30;

/// Writes the shape that answers a point into its probe, where no surface that was seen before does: one that the point reaches within this
/// step before those that it does not, and the nearer first. A point whose way, seen from a shape, would enter it meets it where it
/// does. All arrays but `shapes` have the shape [point_count].
pub fn sample_shapes(
    probes: &mut [Probe],
    positions: &[Vec3],
    velocities: &[Vec3],
    shapes: &[ShapeStep],
    settings: &StepSettings,
) {
    for ((probe, &position), &velocity) in probes.iter_mut().zip(positions).zip(velocities) {
        let is_reached = |seen: &Probe| {
            seen.distance + (velocity - seen.velocity).dot(seen.normal) * settings.dt < settings.contact_margin
        };
        let order =
            |one: &Probe, other: &Probe| is_reached(other).cmp(&is_reached(one)).then_with(|| nearer(one, other));
        let seen = shapes.iter().filter_map(|shape| look_at(shape, position, velocity, settings));
        // What is no number has no distance.
        let seen = seen.filter(|seen| seen.distance < FAR);
        let answer = seen.reduce(|first, next| if order(&next, &first).is_lt() { next } else { first });
        if let Some(answer) = answer.filter(|answer| !probe.hit || order(answer, probe).is_lt()) {
            *probe = answer;
        }
    }
}

/// The plane that a point sees of a shape; none in its very middle, where no direction leads out.
fn look_at(shape: &ShapeStep, position: Vec3, velocity: Vec3, settings: &StepSettings) -> Option<Probe> {
    let radial = position - shape.centre;
    match shape.kind {
        ShapeKind::Sphere => {}
        ShapeKind::Capsule => return look_at_capsule(shape, radial, velocity, settings),
        ShapeKind::Plane => return Some(look_at_plane(shape, radial)),
        ShapeKind::Box => return Some(look_at_box(shape, radial, velocity, settings)),
    }
    let way = (velocity - shape.velocity) * settings.dt;
    let entry = if settings.swept { sphere_entry(radial, way, shape.radius) } else { None };
    plane(shape, radial, entry.map_or(radial, |share| radial + way * share), Vec3::ZERO)
}

/// The plane that touches a shape under the place `met`, as far from the place `core` of its middle line as the radius: its distance from
/// `radial`, all relative to the centre of the shape [m].
fn plane(shape: &ShapeStep, radial: Vec3, met: Vec3, core: Vec3) -> Option<Probe> {
    let outward = met - core;
    let length = outward.length();
    (length > 0.0).then(|| {
        let normal = outward / length;
        // The cross product of spin and radius, added term by term: the order is part of the answer.
        let velocity = (shape.velocity + shape.spin.yzx() * met.zxy()) - shape.spin.zxy() * met.yzx();
        Probe { normal, distance: normal.dot(radial - core) - shape.radius, velocity, hit: true }
    })
}

/// The plane that a point sees of a capsule, `radial` from its centre [m].
fn look_at_capsule(shape: &ShapeStep, radial: Vec3, velocity: Vec3, settings: &StepSettings) -> Option<Probe> {
    // Seen from the capsule, which turns: what turns with it stands still.
    let turning = shape.spin.yzx() * radial.zxy() - shape.spin.zxy() * radial.yzx();
    let way = ((velocity - shape.velocity) - turning) * settings.dt;
    let entry = if settings.swept { capsule_entry(shape, radial, way) } else { None };
    let met = entry.map_or(radial, |share| radial + way * share);
    let along = met.dot(shape.axis) / shape.axis.dot(shape.axis);
    plane(shape, radial, met, shape.axis * along.clamp(-1.0, 1.0))
}

/// After which part of its way a place outside of a capsule meets it: its side where the endless cylinder around it is entered between its
/// ends, else the sphere around the end beyond which that happens.
fn capsule_entry(shape: &ShapeStep, start: Vec3, way: Vec3) -> Option<f32> {
    let axis = shape.axis;
    let axis_squared = axis.dot(axis);
    let mut along = start.dot(axis) / axis_squared;
    let start_across = start - axis * along;
    let way_across = way - axis * (way.dot(axis) / axis_squared);
    if start_across.dot(start_across) > shape.radius * shape.radius {
        let share = sphere_entry(start_across, way_across, shape.radius)?;
        along = (start + way * share).dot(axis) / axis_squared;
        if along.abs() <= 1.0 {
            return Some(share);
        }
    } else if along.abs() <= 1.0 {
        return None;
    }
    sphere_entry(start - axis * along.signum(), way, shape.radius)
}

/// The plane itself, seen from `radial` [m] relative to its centre.
fn look_at_plane(shape: &ShapeStep, radial: Vec3) -> Probe {
    let height = shape.axis.dot(radial);
    let below = radial - shape.axis * height;
    let velocity = (shape.velocity + shape.spin.yzx() * below.zxy()) - shape.spin.zxy() * below.yzx();
    Probe { normal: shape.axis, distance: height - shape.radius, velocity, hit: true }
}

/// Turns of the search for where a way enters a box.
const BOX_TURNS: u32 = 6;

/// The plane that a point sees of a box, `radial` from its centre [m]; out of its core leads the nearest face.
fn look_at_box(shape: &ShapeStep, radial: Vec3, velocity: Vec3, settings: &StepSettings) -> Probe {
    let [right, up] = shape.turn;
    let forward = right.yzx() * up.zxy() - right.zxy() * up.yzx();
    let turning = shape.spin.yzx() * radial.zxy() - shape.spin.zxy() * radial.yzx();
    let way = ((velocity - shape.velocity) - turning) * settings.dt;
    let start = vec3(right.dot(radial), up.dot(radial), forward.dot(radial));
    let along = vec3(right.dot(way), up.dot(way), forward.dot(way));
    let entry = if settings.swept { box_entry(shape, start, along) } else { None };
    let met = entry.map_or(start, |share| start + along * share);
    let core = within(met, shape.axis);
    let outward = met - core;
    let length = outward.length();
    let (normal, distance) = if length > 0.0 {
        let normal = outward / length;
        (normal, normal.dot(start - core) - shape.radius)
    } else {
        let depth = shape.axis - met.abs();
        let side = |place: f32| if place > 0.0 { 1.0 } else { -1.0 };
        let mut nearest = (depth.x, side(met.x) * Vec3::X);
        for (depth, out) in [(depth.y, side(met.y) * Vec3::Y), (depth.z, side(met.z) * Vec3::Z)] {
            if depth < nearest.0 {
                nearest = (depth, out);
            }
        }
        (nearest.1, -nearest.0 - shape.radius)
    };
    let [x, y, z] = [0, 1, 2].map(|k| vec3(right[k], up[k], forward[k]));
    let place = vec3(x.dot(met), y.dot(met), z.dot(met));
    let velocity = (shape.velocity + shape.spin.yzx() * place.zxy()) - shape.spin.zxy() * place.yzx();
    Probe { normal: vec3(x.dot(normal), y.dot(normal), z.dot(normal)), distance, velocity, hit: true }
}

/// After which part of its way a place meets a box, all along the axes of the box; at once where it is inside. Newton's search on the distance along the way,
/// which is convex: it comes ever nearer and never goes too far.
fn box_entry(shape: &ShapeStep, start: Vec3, way: Vec3) -> Option<f32> {
    let mut share = 0.0;
    for _ in 0..BOX_TURNS {
        let place = start + way * share;
        let outward = place - within(place, shape.axis);
        let length = outward.length();
        let gap = length - shape.radius;
        let is_outside = gap > 0.0;
        if !is_outside {
            break;
        }
        let closing = outward.dot(way) / length;
        let is_closing = closing < 0.0;
        if !is_closing {
            return None;
        }
        share -= gap / closing;
    }
    Some(share).filter(|share| *share < 1.0)
}

/// The place of a box of these half extents around the origin that is nearest to another one.
fn within(place: Vec3, half: Vec3) -> Vec3 {
    place.max(-half).min(half)
}

/// The nearer first; of two that are equally near the one whose normal, then whose velocity is larger in the first coordinate that differs.
fn nearer(one: &Probe, other: &Probe) -> Ordering {
    let larger = |one: Vec3, other: Vec3| other.to_array().partial_cmp(&one.to_array()).unwrap_or(Ordering::Equal);
    let by_distance = one.distance.partial_cmp(&other.distance).unwrap_or(Ordering::Greater);
    by_distance.then(larger(one.normal, other.normal)).then(larger(one.velocity, other.velocity))
}

/// After which part of its way a place outside of a sphere around the origin first meets it: the smaller root of
/// |start + share·way|² = radius²; `None` when it does not come so far.
fn sphere_entry(start: Vec3, way: Vec3, radius: f32) -> Option<f32> {
    let outside = start.dot(start) - radius * radius;
    let closing = start.dot(way);
    let way_squared = way.dot(way);
    let discriminant = closing * closing - way_squared * outside;
    if outside > 0.0 && closing < 0.0 && discriminant > 0.0 {
        return Some((-closing - discriminant.sqrt()) / way_squared).filter(|share| *share < 1.0);
    }
    None
}
