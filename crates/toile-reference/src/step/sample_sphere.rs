//! Points against the analytic sphere.

use crate::{Ball, Probe};
use glam::{Vec3, Vec3Swizzles};
use toile_model::StepSettings;

/// Writes the sphere into the probe of each point that it reaches within this step, where the probe has no surface yet or a
/// farther one. A point whose way, seen from the sphere, would enter it meets it where it does. All arrays have the shape
/// [point_count].
pub fn sample_sphere(
    probes: &mut [Probe],
    positions: &[Vec3],
    velocities: &[Vec3],
    ball: &Ball,
    settings: &StepSettings,
) {
    for ((probe, &position), &velocity) in probes.iter_mut().zip(positions).zip(velocities) {
        let radial = position - ball.centre;
        let way = (velocity - ball.velocity) * settings.dt;
        let met = if settings.swept { meeting(radial, way, ball.radius).unwrap_or(radial) } else { radial };
        let length = met.length();
        if length > 0.0 {
            let normal = met / length;
            let distance = normal.dot(radial) - ball.radius;
            // The cross product of spin and radius, added term by term: the order is part of the answer.
            let surface_velocity = (ball.velocity + ball.spin.yzx() * met.zxy()) - ball.spin.zxy() * met.yzx();
            let next = distance + (velocity - surface_velocity).dot(normal) * settings.dt;
            if next < settings.contact_margin && (!probe.hit || distance < probe.distance) {
                *probe = Probe { normal, distance, velocity: surface_velocity, hit: true };
            }
        }
    }
}

/// Where the way from a place outside of a sphere around the origin first meets it: the smaller root of
/// |start + share·way|² = radius².
fn meeting(start: Vec3, way: Vec3, radius: f32) -> Option<Vec3> {
    let outside = start.dot(start) - radius * radius;
    let closing = start.dot(way);
    let way_squared = way.dot(way);
    let discriminant = closing * closing - way_squared * outside;
    if outside > 0.0 && closing < 0.0 && discriminant > 0.0 {
        let share = (-closing - discriminant.sqrt()) / way_squared;
        return (share < 1.0).then(|| start + way * share);
    }
    None
}
