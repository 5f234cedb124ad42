//! Sheets alone, under every rule, and on spheres: device and reference agree bit for bit over whole runs.

use crate::life::Life;
use toile::{Cloth, Colliders, Error};
use toile_lab::DrawnMaps;
use toile_lab::fixtures::{scene, shapes, sheet_model};
use toile_lab::kernels::{first_difference, vec3_words};
use toile_lab::with;
use toile_model::{ModelError, StepSettings};
use toile_scene::{Friction, MapKind, Mesh, Polish, Rule, VelocityModification, Wind};
use toile_workspace::{arrived, finish_frame, gpu};

#[test]
fn a_hanging_sheet_agrees_under_every_rule() {
    for n in ["16", "33"] {
        for (_, rule) in Rule::ALL {
            let mut hang = scene("hang", &[("n", n)]);
            hang.settings.velocity_modification = VelocityModification::new(rule);
            hang.settings.velocity_modification.sweeps = Some(3);
            let model = sheet_model(&hang);
            let mut life = Life::new(&model, &StepSettings::new(&hang.settings, &model), None, Vec::new());
            let status = life.agree(&format!("hang {n} {rule:?}"), 20);
            assert!(status.elongation_max > 0.0, "the sheet hangs");
        }
    }
}

/// A host makes model and step by itself, each from settings of its own.
#[test]
fn a_sheet_agrees_under_another_rule_than_it_was_made_for_or_is_refused() {
    let under = |rule| {
        let mut hang = scene("hang", &[("n", "9")]);
        hang.settings.velocity_modification = VelocityModification::new(rule);
        let model = sheet_model(&hang);
        (StepSettings::new(&hang.settings, &model), model)
    };
    for (_, made_for) in Rule::ALL {
        let (_, model) = under(made_for);
        for (name, rule) in Rule::ALL {
            let (step, _) = under(rule);
            if rule == Rule::Hierarchical && made_for != rule {
                let refused = Cloth::new(&gpu().device, &model, &step, Colliders::default());
                assert!(matches!(refused, Err(Error::Model(ModelError::Rule))), "made for {made_for:?}");
                continue;
            }
            Life::new(&model, &step, None, Vec::new()).agree(&format!("made for {made_for:?}, under {name}"), 3);
        }
    }
    let (mut step, model) = under(Rule::Average);
    step.polish = Some(Polish { target: 0.05, sweeps: 3 });
    let refused = Cloth::new(&gpu().device, &model, &step, Colliders::default());
    assert!(matches!(refused, Err(Error::Model(ModelError::Polish))));
}

#[test]
fn a_sheet_on_a_sphere_agrees_under_every_rule_and_both_friction_laws() {
    for (name, laws) in [
        ("ball", vec![Friction::Coulomb, Friction::Papers { velocity_kept: 0.9, force_removed: 0.2 }]),
        ("moving-ball", vec![Friction::Coulomb]),
    ] {
        for law in laws {
            for (_, rule) in Rule::ALL {
                // Lower, so that it touches within few frames.
                let mut ball = scene(name, &[("n", "17"), ("sheet.0.corner", "[-0.5, 0.256, 0.5]")]);
                ball.settings.velocity_modification = VelocityModification::new(rule);
                ball.settings.velocity_modification.sweeps = Some(3);
                ball.settings.friction = law;
                let model = sheet_model(&ball);
                let mut life = Life::new(&model, &StepSettings::new(&ball.settings, &model), None, shapes(&ball));
                life.agree(&format!("{name} {rule:?} {law:?}"), 15);
                assert!(life.contacts_max > 0, "{name} {rule:?}: the sheet touches the sphere");
            }
        }
    }
}

#[test]
fn a_sheet_of_several_levels_agrees() {
    for (name, n) in [("hang", "16"), ("hang", "40"), ("ball", "17")] {
        let lower = if name == "ball" { vec![("sheet.0.corner", "[-0.5, 0.256, 0.5]")] } else { Vec::new() };
        let sheet = scene(name, &[vec![("n", n)], lower].concat());
        let model = sheet_model(&sheet);
        assert!(model.levels.len() > 1, "the sheet has levels");
        let mut life = Life::new(&model, &StepSettings::new(&sheet.settings, &model), None, shapes(&sheet));
        let status = life.agree(&format!("{name} {n}"), 20);
        assert!(status.elongation_max > 0.0, "the sheet is stretched");
    }
}

#[test]
fn a_sheet_that_its_guard_holds_agrees() {
    // One sweep leaves enough to the guard that each of its passes matters.
    let hard = [("n", "17"), ("sweeps", "1"), ("gravity", "[0, -400, 0]"), ("sheet.0.corner", "[-0.5, 0.256, 0.5]")];
    let ball = scene("ball", &hard);
    let model = sheet_model(&ball);
    let mut settings = StepSettings::new(&ball.settings, &model);
    settings.guard_passes = 4;
    Life::new(&model, &settings, None, shapes(&ball)).agree("ball, four passes of the guard", 10);
}

#[test]
fn a_polished_sheet_agrees_where_it_holds_and_where_it_misses() {
    let lower = ("sheet.0.corner", "[-0.5, 0.256, 0.5]");
    for (name, rule, target) in
        [("hang", Rule::Hierarchical, 0.0067), ("hang", Rule::Predictive, 0.03), ("ball", Rule::Hierarchical, 0.0062)]
    {
        let hard = [("n", "17"), ("fabric.threshold", "0.01"), lower];
        let mut hard = scene(name, &hard);
        hard.settings.velocity_modification = VelocityModification::new(rule);
        hard.settings.velocity_modification.polish = Some(Polish { target, sweeps: 2 });
        let model = sheet_model(&hard);
        let mut life = Life::new(&model, &StepSettings::new(&hard.settings, &model), None, shapes(&hard));
        let status = life.agree(&format!("{name} {rule:?}, polished"), 10);
        let steps = status.step as u32;
        assert!(status.missed_steps > 0 && status.missed_steps < steps, "{status:?}");
        assert!(status.further_sweeps > 2 * status.missed_steps && status.further_sweeps < 2 * steps, "{status:?}");
    }
}

#[test]
fn a_sheet_in_wind_and_under_pressure_agrees_hanging_and_on_a_sphere() {
    for (name, velocity) in [("hang", glam::dvec3(1.0, 2.0, 8.0)), ("ball", glam::dvec3(3.0, -1.0, 0.0))] {
        let mut windy = scene(name, &[("n", "17")]);
        let model = sheet_model(&windy);
        windy.settings.wind = Some(with(Wind::new(velocity), |wind| wind.pressure = 3.0));
        let settings = StepSettings::new(&windy.settings, &model);
        Life::new(&model, &settings, None, shapes(&windy)).agree(&format!("{name} in wind and under pressure"), 20);
    }
}

#[test]
fn a_sheet_on_maps_and_a_sphere_together_agrees() {
    let ball = scene("ball", &[("n", "17"), ("sheet.0.corner", "[-0.5, 0.256, 0.5]")]);
    let model = sheet_model(&ball);
    let settings = StepSettings::new(&ball.settings, &model);
    let body = Mesh::sphere(glam::vec3(0.2, 0.05, 0.0), 0.2, 24);
    let layers =
        DrawnMaps::draw(gpu(), MapKind::Layers, &[(&body, settings.thickness)], 0.01).expect("the device answers");
    let mut life = Life::new(&model, &settings, Some(&layers), shapes(&ball));
    life.agree("a sphere and maps", 15);
    assert!(life.contacts_max > 4, "{} contacts", life.contacts_max);
}

/// As a host records them: whole frames, several in one go, so that every step of a frame finds its own sphere.
#[test]
fn whole_frames_of_a_simulation_agree() {
    for name in ["hang", "moving-ball"] {
        let lower = ("sheet.0.corner", "[-0.5, 0.256, 0.5]");
        let scene = if name == "hang" { scene(name, &[("n", "17")]) } else { scene(name, &[("n", "17"), lower]) };
        let model = sheet_model(&scene);
        let settings = StepSettings::new(&scene.settings, &model);
        let colliders = toile::Colliders::new(None, shapes(&scene));
        let mut cloth = Cloth::new(&gpu().device, &model, &settings, colliders).expect("it fits");
        let colliders = toile_reference::Colliders::new(None, shapes(&scene));
        let mut reference = toile_reference::Reference::new(&model, &settings, colliders);
        for _ in 0..3 {
            gpu().run(|encoder| (0..5).for_each(|_| cloth.record(&gpu().device, encoder)));
            (0..5).for_each(|_| reference.frame());
            let positions = vec3_words(&gpu().vec3s(&cloth.frame().positions));
            let fault = first_difference(&positions, &vec3_words(reference.positions()));
            assert!(fault.is_none(), "{name} after step {}: {}", cloth.step(), fault.expect("there is one"));
            assert_eq!(finish_frame(&mut cloth).expect("it stays finite"), reference.status(), "{name}");
        }
    }
}

#[test]
fn a_force_of_the_wrong_sign_is_seen_in_the_first_step() {
    let hang = scene("hang", &[("n", "16")]);
    let model = sheet_model(&hang);
    let settings = StepSettings::new(&hang.settings, &model);
    let mut life = Life::new(&model, &settings, None, Vec::new());
    let mut upward = settings;
    upward.gravity = -upward.gravity;
    life.reference = toile_reference::Reference::new(&model, &upward, Default::default());
    gpu().run(|encoder| life.solver.record_steps(&gpu().device, encoder, 0..1, 1));
    life.reference.step();
    assert!(life.difference().is_some_and(|fault| fault.starts_with("positions")));
}

/// A host drops an encoder when its window is gone; what it records later still tells its status.
#[test]
fn frames_that_are_never_submitted_take_no_status_away() {
    let scene = scene("hang", &[("n", "8")]);
    let model = sheet_model(&scene);
    let settings = StepSettings::new(&scene.settings, &model);
    let device = &gpu().device;
    let mut cloth = Cloth::new(device, &model, &settings, Default::default()).expect("the model fits the device");
    for _ in 0..20 {
        let mut encoder = device.create_command_encoder(&Default::default());
        cloth.record(device, &mut encoder);
    }
    gpu().run(|encoder| cloth.record(device, encoder));
    let status = arrived("the status of the frame", || cloth.status().expect("it is finite"));
    assert_eq!(status.step, cloth.step());
}
