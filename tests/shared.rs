//! Pipelines are made once for a device, whoever uses them.

use toile::gpu::Kernels;
use toile::{Cloth, Colliders, Simulation};
use toile_kernels::TABLE;
use toile_lab::fixtures::{garment, scene};
use toile_lab::with;
use toile_model::{Model, StepSettings};
use toile_scene::{Body, Cloth as Cut, Fabric, Mesh, Scene, Settings};
use toile_workspace::gpu;

/// A sheet that hangs, with the numbers of its step.
fn sheet(n: &str) -> (Model, StepSettings) {
    let Scene { settings, cloths, .. } = scene("hang", &[("n", n)]);
    let [Cut::Sheet(sheet)] = cloths.as_slice() else { panic!("it is a sheet") };
    let model = Model::from_sheet(sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    (model, step)
}

#[test]
fn a_further_cloth_makes_no_pipeline_and_moves_alike() {
    let kernels = Kernels::new(&gpu().device);
    assert_eq!(kernels.made_count(), 0, "none is made before it is needed");
    let (model, step) = sheet("8");
    let fall = |cloth: &mut Cloth| {
        gpu().run(|encoder| cloth.record(&gpu().device, encoder));
        gpu().words(&cloth.frame().positions)
    };
    let mut own = Cloth::new(&gpu().device, &model, &step, Colliders::default()).expect("it fits the device");
    let mut first = Cloth::new(&kernels, &model, &step, Colliders::default()).expect("it fits the device");
    let made = kernels.made_count();
    assert_eq!(made, first.plan().kernels().len(), "those of the plan, and no other");
    let mut further = Cloth::new(&kernels, &model, &step, Colliders::default()).expect("it fits the device");
    let (other, other_step) = sheet("5");
    Cloth::new(&kernels, &other, &other_step, Colliders::default()).expect("it fits the device");
    assert_eq!(kernels.made_count(), made);
    let positions = fall(&mut own);
    assert_eq!(fall(&mut first), positions);
    assert_eq!(fall(&mut further), positions);
}

#[test]
fn all_of_them_are_made_while_the_host_awaits_them() {
    let kernels = Kernels::new(&gpu().device);
    let all = kernels.all_made();
    // The thread that asked goes on.
    assert!(kernels.made_count() < TABLE.len());
    pollster::block_on(all).expect("the device takes them");
    assert_eq!(kernels.made_count(), TABLE.len() + 2);
    pollster::block_on(kernels.all_made()).expect("there is nothing left to make");
}

#[test]
fn all_of_them_are_made_at_once_and_a_dressing_needs_no_more() {
    let kernels = Kernels::new(&gpu().device);
    kernels.make_all();
    let all = TABLE.len() + 2;
    assert_eq!(kernels.made_count(), all, "every kernel, and what draws the papers' maps of both kinds");
    let cotton = Settings::new(Fabric::preset("cotton").expect("a preset"));
    let mut scene = Scene::new(
        "two on a post",
        with(cotton, |settings| {
            settings.spacing = 0.08;
            settings.texel = 0.02;
        }),
    );
    scene.cloths = ["skirt", "shirt_sleeveless"].map(|name| Cut::Garment(garment(name))).to_vec();
    scene.bodies = vec![Body::Mesh(Mesh::sphere(glam::Vec3::Y, 0.1, 16))];
    let mut simulation = Simulation::new(&kernels, &scene).expect("it can be dressed");
    for _ in 0..3 {
        gpu().run(|encoder| assert!(simulation.advance(encoder, 1.0 / 60.0).is_ok()));
    }
    assert_eq!(kernels.made_count(), all);
}
