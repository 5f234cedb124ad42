//! Pipelines and constant buffers are made once for a device, whoever uses them.

use toile::gpu::Kernels;
use toile::{Cloth, Colliders, Simulation};
use toile_kernels::TABLE;
use toile_lab::fixtures::{garment, scene};
use toile_lab::with;
use toile_model::{Model, PinTarget, StepSettings};
use toile_scene::{Body, Cloth as Cut, Fabric, Mesh, Scene, Settings, Threshold};
use toile_workspace::gpu;

/// A sheet that hangs, with the numbers of its step.
fn sheet(n: &str) -> (Model, StepSettings) {
    changed_sheet(n, |_| {})
}

/// The same with other settings.
fn changed_sheet(n: &str, change: impl Fn(&mut Settings)) -> (Model, StepSettings) {
    let Scene { mut settings, cloths, .. } = scene("hang", &[("n", n)]);
    change(&mut settings);
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

/// A cloth of a sheet of 12 × 12.
fn hanging(kernels: impl Into<Kernels>) -> Cloth {
    let (model, step) = sheet("12");
    Cloth::new(kernels, &model, &step, Colliders::default()).expect("it fits the device")
}

/// Does frames, and gives all bits of positions and velocities.
fn frames(cloth: &mut Cloth, count: u32) -> [Vec<u32>; 2] {
    (0..count).for_each(|_| gpu().run(|encoder| cloth.record(&gpu().device, encoder)));
    [&cloth.frame().positions, cloth.velocities()].map(|buffer| gpu().words(buffer))
}

#[test]
fn cloths_of_equal_models_have_only_their_state_for_themselves() {
    let kernels = Kernels::new(&gpu().device);
    assert_eq!(kernels.shared_bytes(), 0);
    let first = hanging(&kernels);
    let shared = kernels.shared_bytes();
    assert_eq!(first.own_bytes() + shared, first.bytes());
    assert!(shared > first.own_bytes(), "most of a cloth is its model: {shared} bytes beside {}", first.own_bytes());
    // Its model is made anew.
    let further = hanging(&kernels);
    assert_eq!(kernels.shared_bytes(), shared);
    assert_eq!(further.frame().indices, first.frame().indices);
    assert_ne!(further.frame().positions, first.frame().positions);
    // Nothing of another size is the same, and of another fabric what is numbers.
    let (other, step) = sheet("5");
    let other = Cloth::new(&kernels, &other, &step, Colliders::default()).expect("it fits the device");
    assert_eq!(kernels.shared_bytes(), shared + other.bytes() - other.own_bytes());
    drop(other);
    let (softer, step) = changed_sheet("12", |settings| settings.fabric.threshold = Threshold::even(0.1));
    let softer = Cloth::new(&kernels, &softer, &step, Colliders::default()).expect("it fits the device");
    assert_eq!(softer.frame().indices, first.frame().indices);
    let both = kernels.shared_bytes();
    assert!(both > shared && both < 2 * shared, "{both} bytes of two fabrics, {shared} of one");
    drop([first, further, softer]);
    assert_eq!(kernels.shared_bytes(), 0, "with the last cloth its buffers go");
}

#[test]
fn cloths_that_share_move_alone() {
    let alone = frames(&mut hanging(&gpu().device), 6);
    let kernels = Kernels::new(&gpu().device);
    let mut cloths: Vec<Cloth> = (0..3).map(|_| hanging(&kernels)).collect();
    // Each is a frame ahead of the next, and all are recorded together.
    for round in 0..8 {
        gpu().run(|encoder| {
            let due = cloths.iter_mut().enumerate().filter(|(late, _)| (*late..late + 6).contains(&round));
            due.for_each(|(_, cloth)| cloth.record(&gpu().device, encoder));
        });
    }
    for cloth in &mut cloths {
        assert!(frames(cloth, 0) == alone);
    }
}

#[test]
fn what_changes_of_one_cloth_changes_of_no_other() {
    type Change = fn(&mut Cloth);
    let changes: [(&str, Change); 6] = [
        ("stiffness and limits", |cloth| {
            let (model, _) = changed_sheet("12", |settings| {
                settings.fabric.threshold = Threshold::even(0.15);
                settings.fabric.structural_stiffness = 5.0;
            });
            cloth.set_model(&model);
        }),
        ("gravity and damping", |cloth| {
            let Scene { mut settings, .. } = scene("hang", &[("n", "12")]);
            settings.gravity = glam::dvec3(2.0, -3.0, 0.0);
            settings.fabric.damping = 5.0;
            let step = cloth.settings().with_numbers_of(&settings);
            gpu().run(|encoder| cloth.record_settings(&gpu().device, encoder, &step));
        }),
        ("a particle is held", |cloth| {
            let pins = [PinTarget::still(140)];
            gpu().run(|encoder| cloth.record_pins(&gpu().device, encoder, &pins));
        }),
        ("a pin is let go", |cloth| {
            let pins = [PinTarget::free(0)];
            gpu().run(|encoder| cloth.record_pins(&gpu().device, encoder, &pins));
        }),
        ("it is carried", |cloth| {
            let carry = glam::DMat4::from_rotation_y(1.0);
            gpu().run(|encoder| cloth.record_carry(&gpu().device, encoder, carry));
        }),
        ("it goes back", |cloth| {
            let mut mark = None;
            gpu().run(|encoder| mark = Some(cloth.record_mark(&gpu().device, encoder)));
            frames(cloth, 2);
            gpu().run(|encoder| cloth.record_reset(encoder, &mark.expect("it was just made")));
            gpu().run(|encoder| cloth.record_steps(&gpu().device, encoder, 0..1, 1));
        }),
    ];
    let undisturbed = frames(&mut hanging(&gpu().device), 8);
    for (name, change) in changes {
        let mut alone = hanging(&gpu().device);
        frames(&mut alone, 4);
        change(&mut alone);
        let kernels = Kernels::new(&gpu().device);
        let [mut changed, mut other] = [hanging(&kernels), hanging(&kernels)];
        frames(&mut changed, 4);
        frames(&mut other, 4);
        change(&mut changed);
        let moved = frames(&mut changed, 4);
        assert!(moved != undisturbed, "{name}: nothing has changed");
        assert!(moved == frames(&mut alone, 4), "{name}: the cloth moves otherwise than one that shares nothing");
        assert!(frames(&mut other, 4) == undisturbed, "{name}: the other cloth has changed");
        // Nor has it for one that is put on later.
        assert!(frames(&mut hanging(&kernels), 8) == undisturbed, "{name}: a later cloth has changed");
    }
}

#[test]
fn what_was_recorded_before_keeps_the_model_of_then() {
    let (softer, _) = changed_sheet("12", |settings| settings.fabric.structural_stiffness = 5.0);
    let mut one_by_one = hanging(&gpu().device);
    frames(&mut one_by_one, 4);
    one_by_one.set_model(&softer);
    let expected = frames(&mut one_by_one, 4);
    let mut at_once = hanging(&gpu().device);
    gpu().run(|encoder| {
        (0..4).for_each(|_| at_once.record(&gpu().device, encoder));
        at_once.set_model(&softer);
        (0..4).for_each(|_| at_once.record(&gpu().device, encoder));
    });
    assert!(frames(&mut at_once, 0) == expected);
}

#[test]
fn a_simulation_counts_once_what_its_cloths_share() {
    let mut alike = scene("hang", &[("n", "12")]);
    let mut lower = alike.cloths[0].clone();
    let Cut::Sheet(sheet) = &mut lower else { panic!("it is a sheet") };
    sheet.corner.y -= 0.5;
    alike.cloths.push(lower);
    let mut unlike = alike.clone();
    let Cut::Sheet(sheet) = &mut unlike.cloths[1] else { panic!("it is a sheet") };
    sheet.fabric = Some(with(alike.settings.fabric.clone(), |fabric| fabric.threshold = Threshold::even(0.1)));
    let [alike, unlike] = [alike, unlike].map(|scene| {
        let kernels = Kernels::new(&gpu().device);
        let mut simulation = Simulation::new(&kernels, &scene).expect("it can be simulated");
        // Sheets are on the device from the first call on.
        gpu().run(|encoder| simulation.advance(encoder, 1.0 / 60.0).map(drop).expect("it goes on"));
        assert_eq!(simulation.cloths().count(), 2);
        let own: u64 = simulation.cloths().map(|worn| worn.cloth.own_bytes()).sum();
        let shared = kernels.shared_bytes();
        // What is left is what the lower one sees of the upper one.
        (shared, simulation.bytes() - own - shared)
    });
    assert!(unlike.0 > alike.0, "of another fabric {} bytes are shared, of the same {}", unlike.0, alike.0);
    assert_eq!(alike.1, unlike.1);
}
