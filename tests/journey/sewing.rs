//! What must hold while panels are sewn around a body, and of cloth that is too small for it.

use crate::support::{advance, gpu, standing, start};
use toile::Stage;
use toile_model::{Flaw, Solid, crossed_particles};

/// Seams close around arms and shoulders, and never through them: cloth follows its seams and is not stretched over a limb.
#[test]
fn nothing_crosses_a_limb_while_it_is_sewn() {
    for garment in ["dress", "shirt_sleeves"] {
        let (mut scene, mesh) = standing(garment, 1.0);
        scene.settings.spacing = 0.03;
        scene.settings.texel = 0.01;
        let body = Solid::of([&mesh]);
        let mut simulation = start(&scene);
        while simulation.stage().expect("it can be sewn") == Stage::Sewing {
            advance(&mut simulation, 1.0 / 60.0);
            let worn = simulation.cloths().next().expect("a garment");
            let positions = gpu().vec3s(&worn.cloth.frame().positions);
            let (crossed, depth) = crossed_particles(worn.model, &positions, &body);
            assert!(crossed.is_empty(), "{garment}: {} particles cross her, {depth} m deep", crossed.len());
            let elongation = worn.cloth.status().expect("it stays finite").expect("a frame is done").elongation_max;
            assert!(elongation < 0.3, "{garment} is stretched by {elongation}");
        }
        let dressing = simulation.dressings().next().expect("a garment");
        assert!(dressing.sewing_steps() > 100 && !dressing.is_left_open(), "{dressing:?}");
    }
}

/// Cloth that cannot hold both its limits and the skin stretches as evenly as it can, lies still, and is told to be too tight, and nothing else.
#[test]
fn cloth_that_is_too_tight_lies_still() {
    let (scene, _) = standing("skirt", 1.15);
    let mut simulation = start(&scene);
    while simulation.stage().expect("it can be sewn") != Stage::Dressed {
        advance(&mut simulation, 1.0 / 60.0);
    }
    assert!(simulation.dressings().all(|dressing| dressing.is_at_rest()), "{:?}", simulation.dressings().next());
    let verdicts = simulation.verdicts(&gpu().queue).expect("a device");
    let [Flaw::TooTight { length, rest_length, elongation_max, .. }] = verdicts[0].findings.as_slice() else {
        panic!("{verdicts:?}")
    };
    let elongation = length / rest_length - 1.0;
    assert!((0.05..0.25).contains(&elongation), "its waist is {elongation} longer than it was cut");
    let unevenness = elongation_max / elongation;
    assert!(unevenness < 1.6, "one spring is stretched {unevenness} times as far as the whole waist");
}
