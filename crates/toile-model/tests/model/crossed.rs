//! Cloth on the wrong side of a body.

use crate::support::settings;
use glam::{Vec3, dvec2, dvec3, vec3};
use toile_model::{Model, Solid, crossed_particles};
use toile_scene::{Mesh, Sheet};

/// A level sheet of 10 × 10 cells of 3 cm around the origin.
fn sheet() -> Model {
    let mut sheet = Sheet::new("sheet", [11, 11], dvec2(0.3, 0.3));
    sheet.corner = dvec3(-0.15, 0.0, -0.15);
    Model::from_sheet(&sheet, &settings(0.03))
}

/// A wrist stands through a single cell: no particle and no spring is deep in it.
#[test]
fn a_wrist_through_a_face_is_found() {
    let model = sheet();
    let mut wrist = Mesh::sphere(Vec3::ZERO, 0.022, 24);
    wrist.positions.iter_mut().for_each(|p| *p = *p * vec3(1.0, 10.0, 1.0) + vec3(0.01, 0.0, 0.01));
    let (crossed, depth) = crossed_particles(&model, &model.positions, &Solid::of([&wrist]));
    assert!(crossed.contains(&60) && crossed.len() <= 8, "the corners of its cell: {crossed:?}");
    assert!((0.018..0.023).contains(&depth), "its axis is 2.2 cm deep, not {depth} m");
}

#[test]
fn cloth_that_lies_around_a_limb_is_on_its_right_side() {
    let model = sheet();
    let limb = 0.04;
    // Rolled around a limb along z, as near as it can be.
    let around: Vec<Vec3> = model
        .positions
        .iter()
        .map(|p| {
            let (sin, cos) = (p.x / limb).sin_cos();
            vec3(limb * sin, limb * cos, p.z)
        })
        .collect();
    let mut body = Mesh::sphere(Vec3::ZERO, limb, 48);
    body.positions.iter_mut().for_each(|p| p.z *= 50.0);
    let (crossed, depth) = crossed_particles(&model, &around, &Solid::of([&body]));
    assert!(crossed.is_empty(), "{} particles, {depth} m deep", crossed.len());
}
