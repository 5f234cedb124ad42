//! A walk does not depend on where the body faces.

use crate::support::{gpu, walking};
use toile_lab::motion::Made;
use toile_lab::{Worst, turned};
use toile_model::{Fit, FitOptions};
use toile_scene::{Body, Scene};

/// So long she walks [s].
const SECONDS: f64 = 0.5;

fn fitted(scene: &Scene) -> Fit {
    let mut scene = scene.clone();
    scene.settings.texel = 0.01;
    Fit::new(&scene, &FitOptions::default()).expect("the skirt fits")
}

#[test]
fn a_walk_is_the_same_at_every_heading_and_while_turning() {
    let mut scene = walking(&["skirt"], "walk_loop");
    let ahead = fitted(&scene);
    let Body::Moving(woman) = &mut scene.bodies[0] else { panic!("she moves") };
    *woman = Made::Turning.of(woman);
    let fits = [turned(&ahead, 0.8), turned(&ahead, 1.5), fitted(&scene)];
    let of = |fit: &Fit| Worst::of(gpu(), fit, SECONDS).expect("she walks");
    let straight = of(&ahead);
    for (index, fit) in fits.iter().enumerate() {
        let worst = of(fit);
        // Her own cells are 6 cm wide: the middle of one may lie 1 cm deep in a thigh. Wherever she faces, it does so alike.
        assert!((worst.elongation_p99 - straight.elongation_p99).abs() < 0.005, "{index}: {worst:?}, not {straight:?}");
        assert!(worst.elongation_max < straight.elongation_max + 0.02, "{index}: {worst:?}, not {straight:?}");
        let depths = |worst: &Worst| [worst.particles, worst.edges, worst.faces];
        for (depth, ahead) in depths(&worst).into_iter().zip(depths(&straight)) {
            assert!(depth < ahead + 0.003 && depth < 0.01, "{index}: {worst:?}, not {straight:?}");
        }
        assert_eq!(worst.crossed_count, 0, "{index}");
    }
}
