//! The exact distance against shapes whose distance is known.

use crate::support::Random;
use glam::{DVec3, Vec3, dvec3, vec3};
use toile_reference::ExactDistance;
use toile_scene::Mesh;

/// How deep a point lies inside the box of half size `half` around the origin.
fn box_penetration(point: DVec3, half: DVec3) -> f64 {
    let outside = point.abs() - half;
    let deepest = outside.max_element().min(0.0);
    -(outside.max(DVec3::ZERO).length() + deepest)
}

fn points(count: usize) -> Vec<DVec3> {
    let mut random = Random(3);
    (0..count).map(|_| random.vector().as_dvec3()).collect()
}

/// Largest difference from the box of half size (0.5, 0.25, 0.75).
fn box_error(mesh: &Mesh) -> f64 {
    let distance = ExactDistance::new(mesh);
    points(2000)
        .into_iter()
        .map(|p| (distance.penetration(p) - box_penetration(p, dvec3(0.5, 0.25, 0.75))).abs())
        .fold(0.0, f64::max)
}

fn test_box() -> Mesh {
    Mesh::cuboid(vec3(-0.5, -0.25, -0.75), vec3(0.5, 0.25, 0.75))
}

#[test]
fn a_box_is_exact_inside_and_outside() {
    let error = box_error(&test_box());
    assert!(error < 1e-12, "{error}");
}

#[test]
fn the_oracle_of_the_box_sees_turned_triangles() {
    let mut mesh = test_box();
    for triangle in &mut mesh.triangles {
        triangle.swap(1, 2);
    }
    assert!(box_error(&mesh) > 0.1);
}

#[test]
fn a_sphere_is_exact_to_its_facets() {
    let distance = ExactDistance::new(&Mesh::sphere(Vec3::ZERO, 0.5, 128));
    for point in points(2000) {
        let expected = 0.5 - point.length();
        let difference = expected - distance.penetration(point);
        assert!((-1e-7..1e-4).contains(&difference), "{point} {difference}");
    }
}

#[test]
fn holes_do_not_turn_the_sign() {
    // An open tube: without caps, a point beyond its end is nearest to the border of the hole.
    let mut mesh = test_box();
    mesh.triangles.retain(|t| t.iter().all(|i| mesh.normals[*i as usize].y == 0.0));
    let distance = ExactDistance::new(&mesh);
    for outside in [dvec3(0.0, 2.0, 0.0), dvec3(0.45, 0.9, 0.1), dvec3(-0.4, -0.6, 0.7), dvec3(0.6, 0.3, 0.0)] {
        assert!(distance.penetration(outside) < 0.0, "{outside}");
    }
    for inside in [DVec3::ZERO, dvec3(0.4, 0.1, 0.0), dvec3(0.0, -0.2, 0.7)] {
        assert!(distance.penetration(inside) > 0.0, "{inside}");
    }
}

#[test]
fn a_summary_shows_the_deepest_and_broken_points() {
    let distance = ExactDistance::new(&test_box());
    let line = (1..=200).map(|i| dvec3(0.5 - 1e-3 * f64::from(i), 0.0, 0.0));
    let summary = distance.penetrations(line).unwrap();
    assert!((summary.max - 0.2).abs() < 1e-9 && (summary.p99 - 0.198).abs() < 1e-9, "{summary:?}");
    assert_eq!(distance.penetrations([]), None);
    let broken = distance.penetrations([DVec3::ZERO, DVec3::NAN]).unwrap();
    assert!(broken.max.is_nan());
}
