//! Points against the analytic sphere.

use crate::{Ball, Probe};
use glam::Vec3;
use toile_model::StepSettings;

/// Writes the sphere into the probe of each point that it reaches within this step, where the probe has no surface yet or a
/// farther one. All arrays have the shape [point_count].
pub fn sample_sphere(
    probes: &mut [Probe],
    positions: &[Vec3],
    velocities: &[Vec3],
    ball: &Ball,
    settings: &StepSettings,
) {
    for ((probe, &position), &velocity) in probes.iter_mut().zip(positions).zip(velocities) {
        let radial = position - ball.centre;
        let length = radial.length();
        if length > 0.0 {
            let normal = radial / length;
            let distance = length - ball.radius;
            let next = distance + settings.dt * (velocity - ball.velocity).dot(normal);
            if next < settings.contact_margin && (!probe.hit || distance < probe.distance) {
                *probe = Probe { normal, distance, velocity: ball.velocity, hit: true };
            }
        }
    }
}
