//! What the reference makes of every fixture, as rounded digests that a reviewer can read.

use std::fmt::Write as _;
use toile_lab::fixtures::{GARMENTS, SCENES, body, garment, scene, settings, shapes, sheet_model};
use toile_model::{Merge, Model, StepSettings};
use toile_reference::maps::{BodyMaps, Surface};
use toile_reference::{Colliders, Reference};

#[test]
fn digests_of_the_garments() {
    let body = body();
    let mut text = String::new();
    for name in GARMENTS {
        let settings = settings(0.06);
        let open = Model::from_garment(&garment(name), &settings).expect("it meshes");
        let step = StepSettings::new(&settings, &open);
        let surface = Surface { mesh: &body, thickness: step.thickness, velocities: None, open: false };
        let maps = BodyMaps::around(settings.maps, &[surface], settings.texel as f32);
        let mut reference = Reference::new(&open, &step.sewing(), Colliders::new(Some(maps), Vec::new()));
        (0..5).for_each(|_| reference.frame());
        writeln!(text, "{name}, sewn for 5 frames\n{}", reference.digest()).expect("a string grows");
        let (sewn, merge) = open.sewn();
        let mut reference = reference.sewn(&sewn, &step.easing(), &merge);
        (0..5).for_each(|_| reference.frame());
        let same = Merge::identity(sewn.particle_count());
        let mut reference = reference.sewn(&sewn, &step.draping(), &same);
        (0..5).for_each(|_| reference.frame());
        writeln!(text, "{name}, then eased and draped for 5 each\n{}", reference.digest()).expect("a string grows");
    }
    insta::assert_snapshot!(text);
}

#[test]
fn digests_of_the_scenes() {
    let mut text = String::new();
    for name in SCENES {
        let scene = scene(name, &[("n", "17")]);
        let model = sheet_model(&scene);
        let step = StepSettings::new(&scene.settings, &model);
        let colliders = Colliders::new(None, shapes(&scene));
        let mut reference = Reference::new(&model, &step, colliders);
        (0..20).for_each(|_| reference.frame());
        writeln!(text, "{name}, 20 frames\n{}", reference.digest()).expect("a string grows");
    }
    insta::assert_snapshot!(text);
}
