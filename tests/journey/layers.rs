//! Several bodies, several cloths.

use crate::support::{advance, gpu, rolling, start};
use glam::{DVec3, Vec3};
use toile_lab::fixtures::scene;
use toile_scene::{Body, Cloth, Mesh};

fn farthest(simulation: &toile::Simulation, index: usize) -> f32 {
    let worn = simulation.cloths().nth(index).expect("a cloth");
    gpu().vec3s(&worn.cloth.frame().positions).iter().map(|p| p.z).fold(f32::INFINITY, f32::min)
}

/// Without any mesh an outer sheet sees the inner one all the same. They stand upright, the outside of the held one towards the free one,
/// and fall backwards.
#[test]
fn a_sheet_falls_on_a_sheet() {
    let mut pair = scene("hang", &[("n", "16")]);
    let Cloth::Sheet(sheet) = &mut pair.cloths[0] else { panic!("a sheet") };
    // Held at its four corners.
    sheet.down = -DVec3::Y;
    sheet.corner += sheet.right * sheet.size.x;
    sheet.right = -sheet.right;
    let last = sheet.columns - 1;
    sheet.pins =
        [[0, 0], [last, 0], [0, last], [last, last]].map(|[column, row]| toile_scene::Pin { column, row }).to_vec();
    let mut free = sheet.clone();
    free.pins.clear();
    free.corner += DVec3::new(-0.2, -0.2, 0.1);
    free.size *= 0.6;
    let start_z = sheet.corner.z as f32;
    pair.cloths.push(Cloth::Sheet(free));
    pair.settings.texel = 0.02;
    pair.settings.gravity = DVec3::new(0.0, 0.0, -9.81);
    let mut simulation = start(&pair);
    for _ in 0..45 {
        advance(&mut simulation, 1.0 / 60.0);
    }
    let [held, free] = [0, 1].map(|index| farthest(&simulation, index));
    assert!(held < start_z - 0.08, "the held sheet sags: {held} m");
    // Free, it would be at −2.7 m.
    assert!(free > held - 0.05, "the free sheet lies on it: {free} and {held} m");
    assert!(simulation.cloths().next().expect("a sheet").cloth.maps().is_none(), "the inner sheet has nothing to see");
}

/// A body at rest and one that moves are in one map.
#[test]
fn cloth_meets_a_ball_at_rest_and_one_that_rolls() {
    let mut both = rolling(1);
    let centre = Vec3::new(-0.4, 0.0, 0.0);
    both.bodies.push(Body::Mesh(Mesh::sphere(centre, 0.22, 32)));
    let mut simulation = start(&both);
    for _ in 0..20 {
        advance(&mut simulation, 1.0 / 60.0);
    }
    assert_eq!(simulation.bodies().count(), 2);
    let worn = simulation.cloths().next().expect("a sheet");
    let distances = gpu().vec3s(&worn.cloth.frame().positions).into_iter().map(|p| p.distance(centre));
    let (nearest, touching) = distances.fold((f32::INFINITY, 0), |(nearest, count), distance| {
        (nearest.min(distance), count + usize::from(distance < 0.25))
    });
    // A sphere of 32 rings is flatter than a sphere by 1 mm.
    assert!(nearest > 0.218, "none is in the ball at rest: {nearest} m");
    assert!(touching > 10, "{touching} particles lie on it");
    let carried = gpu().vec3s(worn.cloth.velocities()).iter().map(|v| v.x).fold(0.0, f32::max);
    assert!(carried > 0.5, "the other ball takes cloth along: {carried} m/s");
}
