//! Scans whose floor is one piece with the body: the floor is cut off and told, and what only looks like one stays.

use crate::support::obj_text;
use fastrand::Rng;
use glam::{Quat, Vec3, vec3};
use std::f32::consts::{FRAC_PI_2, TAU};
use toile_files::{BodyFile, BodyOptions, parse_body};
use toile_scene::Mesh;

const AROUND: u32 = 32;

/// The height and half width [m] of a body from the floor to the crown.
const BODY: [[f32; 2]; 9] =
    [[0.0, 0.16], [0.1, 0.14], [0.3, 0.13], [0.6, 0.17], [0.9, 0.2], [1.2, 0.21], [1.4, 0.2], [1.55, 0.1], [1.7, 0.0]];

/// What is turned about the y axis: rings by height and radius, each moved by its angle; the last ring is a point.
fn turned(profile: &[[f32; 2]], place: impl Fn(Vec3) -> Vec3) -> Mesh {
    let mut mesh = Mesh { positions: Vec::new(), normals: Vec::new(), triangles: Vec::new() };
    for [height, radius] in profile {
        for step in 0..AROUND {
            let (sin, cos) = (TAU * step as f32 / AROUND as f32).sin_cos();
            mesh.positions.push(place(vec3(radius * sin, *height, radius * cos)));
        }
    }
    for ring in 1..profile.len() as u32 {
        for step in 0..AROUND {
            let at = |ring: u32, step: u32| ring * AROUND + step % AROUND;
            let [a, b] = [at(ring - 1, step), at(ring - 1, step + 1)];
            let [c, d] = [at(ring, step), at(ring, step + 1)];
            mesh.triangles.extend([[a, b, c], [c, b, d]]);
        }
    }
    mesh
}

/// The body with a floor around it, up to a radius, in rings of 8 cm.
fn on_floor(radius: f32) -> Vec<[f32; 2]> {
    let count = ((radius - 0.24) / 0.08) as usize;
    let floor = (0..=count).map(|ring| [0.0, radius + (0.24 - radius) * ring as f32 / count as f32]);
    floor.chain(BODY).collect()
}

fn read(mesh: &Mesh) -> BodyFile {
    parse_body(obj_text(mesh).as_bytes(), "a.obj", &BodyOptions::default()).expect("a readable body")
}

/// The volume of the body whose soles are flat [m³].
fn volume() -> f64 {
    let closed: Vec<[f32; 2]> = [[0.0, 0.0]].into_iter().chain(BODY).collect();
    let body = read(&turned(&closed, |p| p));
    assert_eq!(body.warnings.len(), 1, "{:?}", body.warnings);
    body.mesh.signed_volume()
}

/// What must be left of a body whose floor is cut off.
fn assert_body(mesh: &Mesh, what: &str) -> String {
    let body = read(mesh);
    let told = body.warnings.iter().find(|told| told.starts_with("floor that is one piece with the body cut off: "));
    let told = told.unwrap_or_else(|| panic!("{what}: {:?}", body.warnings));
    let lost = 1.0 - body.mesh.signed_volume() / volume();
    assert!((-0.01..0.03).contains(&lost), "{what}: {lost} of the volume is lost");
    let places = &body.mesh.positions;
    let farthest = places.iter().flat_map(|a| places.iter().map(|b| a.distance(*b))).fold(0.0, f32::max);
    assert!((1.7..1.76).contains(&farthest), "{what}: {farthest} m");
    assert!(!body.warnings.iter().any(|told| told.contains("holes")), "{what}: {:?}", body.warnings);
    told.clone()
}

#[test]
fn a_floor_that_is_one_piece_with_the_body_is_cut_off() {
    let square =
        |p: Vec3| if p.y == 0.0 && p.x.hypot(p.z) > 0.3 { p / (p.x.abs().max(p.z.abs()) / p.x.hypot(p.z)) } else { p };
    let told = assert_body(&turned(&on_floor(1.5), square), "square");
    assert!(told.ends_with(" of 3.00 m by 3.00 m"), "{told}");
    for radius in [0.6, 0.8, 1.0, 2.0] {
        assert_body(&turned(&on_floor(radius), |p| p), &format!("a floor of {radius} m"));
    }
    for (number, turn) in [
        Quat::from_rotation_x(FRAC_PI_2),
        Quat::from_rotation_x(-FRAC_PI_2),
        Quat::from_rotation_z(FRAC_PI_2),
        Quat::from_rotation_x(3.0),
        Quat::from_rotation_x(0.1) * Quat::from_rotation_z(0.2),
        Quat::from_rotation_y(0.7) * Quat::from_rotation_x(0.8),
    ]
    .into_iter()
    .enumerate()
    {
        assert_body(&turned(&on_floor(1.2), |p| turn * p + vec3(3.0, 0.0, 1.0)), &format!("turn {number}"));
    }
    let mut inside_out = turned(&on_floor(1.2), |p| p);
    inside_out.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    assert_body(&inside_out, "inside out");
}

#[test]
fn a_floor_may_be_rough_and_rise_to_the_feet_and_to_a_wall() {
    for rough in [0.002, 0.004] {
        let mut rng = Rng::with_seed(7);
        let mut noise = || rough * (2.0 * rng.f32() - 1.0);
        let mut mesh = turned(&on_floor(1.5), |p| p);
        for (number, position) in mesh.positions.iter_mut().filter(|p| p.y < 0.05).enumerate() {
            position.y += noise() + if number % 37 == 0 { 0.012 } else { 0.0 };
        }
        assert_body(&mesh, &format!("rough by {rough} m"));
    }
    let mut rising = on_floor(1.5);
    let first = rising.iter().position(|[height, _]| *height > 0.0).expect("the body") - 1;
    rising.splice(first..=first, [[0.003, 0.2], [0.01, 0.17], [0.03, 0.155]]);
    assert_body(&turned(&rising, |p| p), "rising to the feet");
    // A backdrop behind the body that the floor goes over into.
    let wall = |p: Vec3| if p.z < -0.8 { vec3(p.x, p.y + (-0.8 - p.z) * 2.0, -0.8 + 0.2 * (p.z + 0.8)) } else { p };
    let body = read(&turned(&on_floor(1.5), wall));
    let kinds = ["floor that is one piece with the body cut off: ", "floor or backdrop left out: 1 piece"];
    for (told, kind) in body.warnings[1..].iter().zip(kinds) {
        assert!(told.starts_with(kind), "{:?}", body.warnings);
    }
    assert!((body.mesh.signed_volume() / volume() - 1.0).abs() < 0.03);
}

#[test]
fn what_only_looks_like_a_floor_stays() {
    let wide = |profile: &[[f32; 2]]| turned(profile, |p| p);
    let from = |first: usize| BODY[first..].iter().copied();
    let cases: [(&str, Mesh); 8] = [
        ("a gown that is closed below and open above", {
            wide(&[[0.0, 0.0], [0.0, 0.2], [0.0, 0.4], [0.0, 0.6], [0.9, 0.25], [1.2, 0.22], [1.6, 0.22]])
        }),
        ("open soles", wide(&BODY)),
        ("a gown that is closed below", {
            let gown = [[0.0, 0.0], [0.0, 0.3], [0.0, 0.6], [0.01, 0.6], [0.9, 0.2]].into_iter().chain(from(5));
            wide(&gown.collect::<Vec<_>>())
        }),
        ("a gown that is open below", {
            wide(&[[0.0, 0.7], [0.5, 0.5], [0.9, 0.2]].into_iter().chain(from(5)).collect::<Vec<_>>())
        }),
        ("a plinth", {
            let plinth = [[-0.3, 0.0], [-0.3, 0.6], [0.0, 0.6], [0.0, 0.4]].into_iter().chain(BODY);
            wide(&plinth.collect::<Vec<_>>())
        }),
        ("a plinth that is open below", {
            wide(&[[-0.3, 0.6], [0.0, 0.6], [0.0, 0.4]].into_iter().chain(BODY).collect::<Vec<_>>())
        }),
        ("a brim", {
            let hat = BODY[..8].iter().copied().chain([[1.6, 0.12], [1.6, 0.25]]);
            wide(&[[0.0, 0.0]].into_iter().chain(hat).collect::<Vec<_>>())
        }),
        ("a table", {
            let leg = [[0.0, 0.0], [0.0, 0.1], [0.7, 0.1], [0.7, 0.9], [0.74, 0.9], [0.74, 0.0]];
            wide(&leg)
        }),
    ];
    for (what, mesh) in cases {
        let body = read(&mesh);
        assert!(!body.warnings.iter().any(|told| told.contains("floor")), "{what}: {:?}", body.warnings);
        let read = parse_body(obj_text(&mesh).as_bytes(), "a.obj", &BodyOptions::default()).expect("a body");
        assert!(read.mesh.triangles.len() + 2 * AROUND as usize >= mesh.triangles.len(), "{what}");
    }
}
