//! The force of the air on each quad as on a flat plate. W §2.2.

use crate::Particles;
use crate::particles::doubled_area;
use glam::Vec3;
use toile_model::{Csr, NO_CORNER};
use toile_scene::{AIR_DENSITY, Wind};

/// Force of the air on each quad or triangle [N], shape [quad_count]: drag along the relative wind and lift across it, as
/// [`Wind`] defines them, divided by what keeps a step of `dt` [s] from overshooting the wind.
///
/// The mass of a quad is the sum of what its corners have for each of their quads (`particle_quads`, one row per particle).
pub fn quad_wind(
    particles: &Particles,
    quads: &[[u32; 4]],
    particle_quads: &Csr<u32>,
    wind: &Wind,
    dt: f32,
) -> Vec<Vec3> {
    let air = wind.velocity.as_vec3();
    let [drag, lift] = [wind.drag as f32, wind.lift as f32];
    let mass_share = |i: u32| particles.masses[i as usize] / particle_quads.row(i as usize).len() as f32;
    let velocity = |i: u32| particles.velocities[i as usize];
    quads
        .iter()
        .map(|&[a, b, c, d]| {
            let three = (velocity(a) + velocity(b)) + velocity(c);
            let three_masses = (mass_share(a) + mass_share(b)) + mass_share(c);
            let (middle, mass) = if d == NO_CORNER {
                (three * (1.0 / 3.0), three_masses)
            } else {
                ((three + velocity(d)) * 0.25, three_masses + mass_share(d))
            };
            let area_vector = doubled_area(&particles.positions, [a, b, c, d]) * 0.5;
            let relative = air - middle;
            let speed = relative.length();
            let area = area_vector.length();
            if !(area > 0.0 && speed > 0.0) {
                return Vec3::ZERO;
            }
            let outside = area_vector / area;
            let along_outside = relative.dot(outside);
            let leeward = if along_outside < 0.0 { -outside } else { outside };
            let through = along_outside.abs();
            let flow = ((0.5 * AIR_DENSITY as f32) * area) * through;
            let crosswise = leeward * speed - relative * (through / speed);
            let rate = (flow * (drag + lift)) / mass;
            (relative * drag + crosswise * lift) * (flow / (1.0 + dt * rate))
        })
        .collect()
}
