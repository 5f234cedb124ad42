//! What a plan has of the maps.

use glam::{Vec3, vec3};
use toile_gpu::{Plan, Solver};
use toile_kernels::{Need, TABLE};
use toile_lab::DrawnMaps;
use toile_lab::fixtures::{scene, sheet_model};
use toile_model::{MapBox, Model, StepSettings};
use toile_scene::{MapKind, Mesh, Rule, VelocityModification};
use toile_workspace::gpu;

const TEXEL: f32 = 0.005;
const THICKNESS: f32 = 0.004;

fn sheet(rule: Rule) -> (Model, StepSettings) {
    let mut hang = scene("hang", &[("n", "16")]);
    hang.settings.velocity_modification = VelocityModification::new(rule);
    let model = sheet_model(&hang);
    let settings = StepSettings::new(&hang.settings, &model);
    (model, settings)
}

#[test]
fn without_a_body_nothing_of_the_contacts_exists() {
    let (model, settings) = sheet(Rule::Predictive);
    let solver = Solver::new(&gpu().device, &model, &settings, None, Vec::new()).expect("it fits the device");
    let contact =
        [Need::Body, Need::StillSides, Need::MovingSides, Need::StillLayers, Need::MovingLayers, Need::Shapes];
    for kernel in solver.plan().kernels() {
        let row = TABLE.iter().find(|row| row.kernel == kernel).expect("every kernel has a row");
        assert!(!contact.contains(&row.need), "{} needs a body", kernel.name());
    }
    let names: Vec<&str> = solver.buffer_sizes().map(|(name, _)| name).collect();
    for name in ["side_box", "layer_box", "midpoints", "probes", "contacts", "ball"] {
        assert!(!names.contains(&name), "{name} among {names:?}");
    }
    let cloth = toile::Cloth::new(&gpu().device, &model, &settings, Default::default()).expect("it fits");
    assert_eq!(cloth.bytes(), solver.bytes());
    assert!(cloth.contacts().is_none());
}

#[test]
fn plan_and_bytes_do_not_depend_on_the_triangles_of_the_body() {
    let (model, settings) = sheet(Rule::Predictive);
    let map_box = MapBox::around([vec3(-0.4, -0.4, -0.4), vec3(0.4, 0.4, 0.4)], TEXEL);
    let with = |count: u32| {
        let mesh = Mesh::sphere(Vec3::ZERO, 0.3, count);
        let layers =
            DrawnMaps::draw_in(gpu(), MapKind::Sides, &[(&mesh, THICKNESS)], map_box).expect("the device answers");
        let colliders = toile::Colliders::new(Some(layers.maps.clone()), Vec::new());
        let cloth = toile::Cloth::new(&gpu().device, &model, &settings, colliders).expect("it fits");
        (mesh.triangles.len(), cloth.plan().clone(), cloth.bytes(), layers.maps.bytes())
    };
    let [coarse, fine]: [(usize, Plan, u64, u64); 2] = [with(8), with(150)];
    assert!(fine.0 > 100 * coarse.0);
    assert_eq!(coarse.1, fine.1);
    assert_eq!((coarse.2, coarse.3), (fine.2, fine.3));
    assert!(coarse.2 > coarse.3, "the bytes of a simulation hold those of its maps");
}
