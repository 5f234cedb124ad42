//! The wind on single quads and triangles: drag, lift, shares, and the guard against overshooting.

use crate::support::{Parts, changed};
use glam::{DVec3, Vec3, vec3};
use toile_model::{Model, NO_CORNER};
use toile_reference::{Particles, step};
use toile_scene::{AIR_DENSITY, Wind};

/// Short enough that the guard takes nothing.
const INSTANT: f32 = 1e-9;

/// A square of 1 m² that leans by 30° out of the plane of x and y about x, and a triangle of half its area beside it.
fn leaning() -> Model {
    let down = vec3(0.0, 30f32.to_radians().cos(), 30f32.to_radians().sin());
    let at = |x: f32, y: f32| Vec3::X * x + down * y;
    Parts {
        positions: vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0), at(2.0, 0.0)],
        masses: vec![0.1, 0.2, 0.3, 0.1, 0.1],
        quads: vec![[0, 1, 2, 3], [1, 4, 2, NO_CORNER]],
        ..Parts::default()
    }
    .model()
}

fn winds(model: &Model, velocity: Vec3, wind: &Wind, dt: f32) -> Vec<Vec3> {
    let mut particles = Particles::new(model);
    particles.velocities.fill(velocity);
    step::quad_wind(&particles, &model.quads, &model.particle_quads, wind, dt)
}

#[test]
fn drag_goes_with_the_wind_and_lift_across_it() {
    let model = leaning();
    let [speed, angle] = [4f64, 30f64.to_radians()];
    let pressure = 0.5 * AIR_DENSITY * speed * speed * angle.cos();
    // The sheet leans away from the wind at its top, so that it is pushed down there, and up when the wind turns.
    for (along, across) in [(Vec3::Z, Vec3::NEG_Y), (Vec3::NEG_Z, Vec3::Y)] {
        for moving in [false, true] {
            // Wind over cloth at rest and cloth through air at rest are the same.
            let [air, cloth] = if moving { [Vec3::ZERO, along * -4.0] } else { [along * 4.0, Vec3::ZERO] };
            for (drag, lift) in [(1.1, 0.0), (0.0, 0.6), (1.1, 0.6)] {
                let mut wind = Wind::new(air.as_dvec3());
                wind.drag = drag;
                wind.lift = lift;
                let forces = winds(&model, cloth, &wind, INSTANT);
                for (force, area) in forces.iter().zip([1.0, 0.5]) {
                    let expected = along.as_dvec3() * (drag * pressure * area)
                        + across.as_dvec3() * (lift * pressure * angle.sin() * area);
                    let error = (force.as_dvec3() - expected).length();
                    assert!(error < 1e-5 * pressure, "{force}, not {expected}");
                }
            }
        }
    }
}

#[test]
fn air_that_moves_with_the_cloth_or_along_it_or_past_no_area_does_nothing() {
    let model = leaning();
    let with = Wind::new(DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(winds(&model, vec3(1.0, 2.0, 3.0), &with, INSTANT), [Vec3::ZERO; 2]);
    assert_eq!(winds(&model, Vec3::ZERO, &Wind::new(DVec3::X), INSTANT), [Vec3::ZERO; 2]);
    let model = changed(model, |model| model.positions.fill(Vec3::ONE));
    assert_eq!(winds(&model, Vec3::ZERO, &with, INSTANT), [Vec3::ZERO; 2]);
}

#[test]
fn a_corner_that_is_no_number_gets_no_force_and_gives_none() {
    let model = leaning();
    let mut particles = Particles::new(&model);
    particles.positions[4].y = f32::NAN;
    let winds = step::quad_wind(&particles, &model.quads, &model.particle_quads, &Wind::new(DVec3::Z), INSTANT);
    let [square, triangle] = winds[..] else { panic!("two") };
    assert!(square.length() > 0.1);
    assert_eq!(triangle, Vec3::ZERO);
}

#[test]
fn particles_share_the_wind_of_their_quads_equally() {
    let model = leaning();
    let winds = [vec3(4.0, 0.0, -8.0), vec3(0.0, 3.0, 6.0)];
    let mut forces = vec![Vec3::X; 5];
    step::wind_forces(&mut forces, &winds, &model.quads, &model.particle_quads);
    let [square, triangle] = [vec3(1.0, 0.0, -2.0), vec3(0.0, 1.0, 2.0)];
    let both = square + triangle;
    let expected = [square, both, both, square, triangle].map(|share| Vec3::X + share);
    assert!(forces.iter().zip(expected).all(|(force, expected)| (*force - expected).length() < 1e-6), "{forces:?}");
}

#[test]
fn no_step_overshoots_the_wind() {
    let model = leaning();
    let mut wind = Wind::new(DVec3::new(0.0, 0.5, 20.0));
    wind.lift = 0.0;
    for dt in [1e-4, 1e-2, 1.0, 100.0] {
        let winds = winds(&model, Vec3::ZERO, &wind, dt);
        // Corners have their whole mass for one quad, or half of it for each of two.
        for (force, mass) in winds.iter().zip([0.45, 0.35]) {
            let gained = *force * (dt / mass);
            assert!(gained.dot(wind.velocity.as_vec3()) > 0.0);
            assert!(gained.length() <= wind.velocity.as_vec3().length(), "{dt} s: {gained}");
        }
        let mut forces = vec![Vec3::ZERO; 5];
        step::wind_forces(&mut forces, &winds, &model.quads, &model.particle_quads);
        let total: Vec3 = forces.iter().sum();
        assert!((total - winds[0] - winds[1]).length() < 1e-5 * total.length(), "no force is lost");
    }
}
