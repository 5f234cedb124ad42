//! The passes that each fixture gets: a scene pays for nothing that it does not have.

use glam::DVec3;
use std::collections::BTreeMap;
use std::fmt::Write;
use toile_gpu::{Maps, Pass, Plan};
use toile_kernels::{Kernel, TABLE};
use toile_lab::fixtures::{GARMENTS, SCENES, garment, scene, settings, shapes, sheet_model};
use toile_model::{Model, StepSettings};
use toile_scene::{Body, Polish, Rule, Scene, Wind};

fn plan(model: &Model, settings: &StepSettings, bodies: &[Body]) -> Plan {
    let maps = if bodies.iter().any(|body| matches!(body, Body::Mesh(_))) {
        Maps::Layers { moving: false }
    } else {
        Maps::None
    };
    let shapes = bodies.iter().any(|body| matches!(body, Body::Shape(_)));
    Plan::new(model, settings, maps, shapes)
}

fn plan_of_scene(scene: &Scene) -> Plan {
    let model = sheet_model(scene);
    plan(&model, &StepSettings::new(&scene.settings, &model), &scene.bodies)
}

/// The plan of a scene and the bytes of its buffers.
fn plan_and_bytes(scene: &Scene) -> (Plan, BTreeMap<String, u64>) {
    let model = sheet_model(scene);
    let plan = plan_of_scene(scene);
    let bytes = plan.buffer_sizes(&model, &StepSettings::new(&scene.settings, &model), &shapes(scene));
    (plan, bytes)
}

#[test]
fn plans_of_the_scenes() {
    let mut text = String::new();
    for name in SCENES {
        writeln!(text, "# {name}\n{}", plan_of_scene(&scene(name, &[]))).expect("text");
    }
    insta::assert_snapshot!(text);
}

#[test]
fn plans_of_the_garments() {
    let body = [Body::Mesh(Default::default())];
    let settings = settings(0.02);
    let mut text = String::new();
    for name in GARMENTS {
        let open = Model::from_garment(&garment(name), &settings).unwrap_or_else(|error| panic!("{error}"));
        let (sewn, _) = open.sewn();
        let sewing = StepSettings::new(&settings, &open).sewing();
        let draping = StepSettings::new(&settings, &sewn).draping();
        writeln!(text, "# {name}, open\n{}", plan(&open, &sewing, &body)).expect("text");
        writeln!(text, "# {name}, sewn\n{}", plan(&sewn, &draping, &body)).expect("text");
    }
    insta::assert_snapshot!(text);
}

#[test]
fn plans_of_the_rules() {
    let mut text = String::new();
    for (_, rule) in Rule::ALL {
        let mut hang = scene("hang", &[("sweeps", "2")]);
        hang.settings.velocity_modification.rule = rule;
        writeln!(text, "# {rule:?}, two sweeps\n{}", plan_of_scene(&hang)).expect("text");
    }
    insta::assert_snapshot!(text);
}

#[test]
fn the_guard_halves_what_second_colours_take_in_its_last_pass_and_nothing_else_is_halved() {
    let ball = scene("ball", &[]);
    let model = sheet_model(&ball);
    for guard_passes in [2, 4] {
        let mut settings = StepSettings::new(&ball.settings, &model);
        settings.guard_passes = guard_passes;
        let plan = plan(&model, &settings, &ball.bodies);
        let (mut guard, mut others) = (Vec::new(), Vec::new());
        for pass in &plan.step {
            if let Some(place) = pass.span {
                let span = plan.spans[place as usize];
                assert_eq!(pass.items, span.first..span.first + span.count);
                if pass.kernel == Kernel::LimitGuard { &mut guard } else { &mut others }.push(span.share);
            }
        }
        let last = guard.split_off(4 * (guard_passes - 1) as usize);
        assert_eq!(last, [1.0, 0.5, 1.0, 0.5]);
        assert!(guard.iter().chain(&others).all(|share| *share >= 1.0) && !others.is_empty());
    }
}

/// Rows by level take turns, the coarsest level first; small levels have a kernel of their own.
#[test]
fn levels_take_turns_from_the_coarsest_to_the_cloth_itself() {
    let hang = scene("hang", &[("n", "128")]);
    let model = sheet_model(&hang);
    let settings = StepSettings::new(&hang.settings, &model);
    let plan = plan_of_scene(&hang);
    let passes = plan.step.iter().skip_while(|pass| pass.kernel != Kernel::LimitSmallLevels).skip(1);
    let first_sweep: Vec<(Kernel, u32, f32)> = passes
        .take_while(|pass| pass.kernel != Kernel::ShiftVelocities)
        .map(|pass| (pass.kernel, pass.items.start, plan.spans[pass.span.expect("it has one") as usize].share))
        .collect();
    let mut by_hand = Vec::new();
    for level in model.levels.iter().rev().filter(|level| !level.is_small()) {
        by_hand.push((Kernel::LeadLevel, level.nodes.start, 1.0));
        for colour in (0..settings.level_passes(level)).flat_map(|_| &level.colours) {
            by_hand.push((Kernel::LimitLevel, colour.start, StepSettings::relaxation(level)));
        }
    }
    assert_eq!(by_hand.iter().filter(|pass| pass.0 == Kernel::LeadLevel).count(), 2, "a coarse level and the cloth");
    assert_eq!(first_sweep, by_hand);
}

#[test]
fn a_scene_with_wind_has_its_passes_and_bytes_and_one_without_has_not() {
    for name in SCENES {
        let calm = scene(name, &[]);
        let windy = scene(name, &[("wind", "{ velocity = [1, 0, 0] }")]);
        let quad_count = u64::from(sheet_model(&calm).quad_count());
        let [calm, windy] = [calm, windy].map(|scene| plan_and_bytes(&scene));
        let kernels = |plan: &Plan| plan.step.iter().map(|pass| pass.kernel).collect::<Vec<_>>();
        let mut expected = kernels(&calm.0);
        assert_eq!(expected[0], Kernel::SpringForces);
        expected.splice(1..1, [Kernel::QuadWind, Kernel::WindForces]);
        assert_eq!(kernels(&windy.0), expected, "{name}");
        let pressed = plan_of_scene(&scene(name, &[("wind", "{ velocity = [1, 0, 0], pressure = 20 }")]));
        expected.insert(3, Kernel::PressureForces);
        assert_eq!(kernels(&pressed), expected, "{name}, pressed");
        assert_eq!(windy.0.frame, calm.0.frame, "{name}");
        assert_eq!(windy.1.get("quad_winds"), Some(&(16 * quad_count)), "{name}");
        assert!(!calm.1.contains_key("quad_winds"), "{name}: {:?}", calm.1);
    }
}

#[test]
fn a_polish_repeats_the_sweep_behind_grants_and_a_plan_without_has_neither() {
    for name in SCENES {
        let plain = scene(name, &[]);
        let polished = scene(name, &[("polish", "{ target = 0.05, sweeps = 3 }")]);
        let sweeps = plain.settings.velocity_modification.rule.sweeps() as usize;
        let [plain, polished] = [plain, polished].map(|scene| plan_and_bytes(&scene));
        let is_decision = |pass: &&Pass| pass.kernel == Kernel::GrantSweep;
        let free: Vec<_> = polished.0.step.iter().filter(|pass| pass.grant.is_none()).cloned().collect();
        let undecided: Vec<_> = free.iter().filter(|pass| !is_decision(pass)).cloned().collect();
        let mut expected = plain.0.step.clone();
        let measurement = Pass::over(Kernel::MeasureExcess, 16_002);
        expected.insert(expected.len() - 1, measurement.clone());
        assert_eq!(undecided, expected, "{name}: what needs no grant is the plain step with one measurement");
        assert_eq!(free.iter().filter(is_decision).count(), 4, "{name}: before each further sweep and after the last");

        let is_guard = |pass: &Pass| matches!(pass.kernel, Kernel::LimitGuard | Kernel::KeepOut);
        let (guards, others): (Vec<Pass>, Vec<Pass>) = plain.0.step.iter().cloned().partition(is_guard);
        assert!(!guards.is_empty(), "{name}");
        let sweep: Vec<_> = others[..others.len() - 1].iter().skip_while(|pass| !is_limit(pass)).cloned().collect();
        // Points look at the shapes in the first sweep alone.
        let (looks, later): (Vec<Pass>, Vec<Pass>) =
            sweep.into_iter().partition(|pass| pass.kernel == Kernel::SampleShapes);
        assert_eq!(looks.len(), usize::from(name != "hang"), "{name}");
        let further: Vec<Pass> =
            later[..later.len() / sweeps].iter().chain(&guards).chain([&measurement]).cloned().collect();
        let numbered = further.iter().zip(0..).map(|(pass, place)| {
            let mut pass = pass.clone();
            pass.grant = Some(place);
            pass
        });
        let granted: Vec<_> = polished.0.step.iter().filter(|pass| pass.grant.is_some()).cloned().collect();
        let three: Vec<Pass> = numbered.cycle().take(3 * further.len()).collect();
        assert_eq!(granted, three, "{name}: three times the sweep, each guarded and measured");

        assert_eq!(polished.0.frame, plain.0.frame, "{name}");
        let new: Vec<_> = polished.1.iter().filter(|(buffer, _)| !plain.1.contains_key(*buffer)).collect();
        let bytes = 16 * further.len() as u64;
        let expected = [("polish", 16), ("polish_state", 16), ("sweep_dispatches", bytes), ("sweep_workgroups", bytes)];
        assert_eq!(new.into_iter().map(|(name, size)| (name.as_str(), *size)).collect::<Vec<_>>(), expected, "{name}");
    }
}

fn is_limit(pass: &Pass) -> bool {
    matches!(
        pass.kernel,
        Kernel::LimitAttachments
            | Kernel::LimitSmallLevels
            | Kernel::LeadLevel
            | Kernel::LimitLevel
            | Kernel::ShiftVelocities
            | Kernel::LimitPredictive
    )
}

#[test]
fn a_garment_is_sewn_and_eases_without_a_polish() {
    let mut polished = settings(0.03);
    polished.velocity_modification.polish = Some(Polish { target: 0.05, sweeps: 2 });
    let open = Model::from_garment(&garment("skirt"), &polished).unwrap_or_else(|error| panic!("{error}"));
    let step = StepSettings::new(&polished, &open);
    for (settings, polish) in [(&step, true), (&step.sewing(), false), (&step.easing(), false), (&step.draping(), true)]
    {
        assert_eq!(plan(&open, settings, &[]).kernels().contains(&Kernel::GrantSweep), polish);
    }
}

#[test]
fn a_garment_is_dressed_without_wind() {
    let mut windy = settings(0.03);
    windy.wind = Some(Wind::new(DVec3::X));
    let open = Model::from_garment(&garment("skirt"), &windy).unwrap_or_else(|error| panic!("{error}"));
    let step = StepSettings::new(&windy, &open);
    for (settings, wind) in [(&step, true), (&step.sewing(), false), (&step.easing(), false), (&step.draping(), false)]
    {
        assert_eq!(plan(&open, settings, &[]).kernels().contains(&Kernel::QuadWind), wind);
    }
}

#[test]
fn the_passes_of_a_plan_stand_in_the_order_of_the_table() {
    let place = |kernel: &Kernel| TABLE.iter().position(|row| row.kernel == *kernel).expect("every kernel has a row");
    for name in SCENES {
        let plan = plan_of_scene(&scene(name, &[]));
        let places: Vec<usize> = plan.kernels().iter().map(place).collect();
        assert!(places.is_sorted(), "{name}: {:?}", plan.kernels());
    }
}

#[test]
fn a_dispatch_of_any_size_reaches_every_item_once() {
    let pass = |items| toile_gpu::Pass::over(Kernel::Euler, items);
    for items in [1, 64, 65, 65_535 * 64, 65_535 * 64 + 1, 20_000_000] {
        let [x, y] = pass(items).workgroups();
        assert!(x <= 65_535 && y <= 65_535);
        let reached = u64::from(x) * u64::from(y) * 64;
        assert!(reached >= u64::from(items), "{items} items, {x} × {y} workgroups");
        assert!(reached < 2 * u64::from(items) + 64, "{items} items, {x} × {y} workgroups");
    }
}

/// By hand: a further pass over the cells of 65 × 65 particles.
#[test]
fn a_pass_moves_what_its_items_reach() {
    let hang = scene("hang", &[("n", "65"), ("sweeps", "1")]);
    let model = sheet_model(&hang);
    assert_eq!(model.levels[0].colours.len(), 4);
    let traffic = |limit_passes: u32| {
        let mut settings = StepSettings::new(&hang.settings, &model);
        settings.limit_passes = limit_passes;
        Plan::new(&model, &settings, Maps::None, false).traffic(&model, &settings, &[])
    };
    // 32 × 32 cells of a colour with 64 × 64 particles: 40 bytes of a cluster, 16 of a place; 16 of a shift are read and written.
    let colour = 32 * 32 * 40 + 64 * 64 * (16 + 2 * 16);
    assert_eq!(traffic(3) - traffic(2), 4 * colour);
}

#[test]
fn a_particle_of_fine_cloth_costs_no_more_to_move() {
    let per_particle = |n: u32| {
        let hang = scene("hang", &[("n", &n.to_string())]);
        let model = sheet_model(&hang);
        // Finer cloth has further passes, which are no matter here.
        let mut settings = StepSettings::new(&hang.settings, &model);
        settings.limit_passes = 2;
        settings.guard_passes = 2;
        let bytes = Plan::new(&model, &settings, Maps::None, false).traffic(&model, &settings, &[]);
        bytes as f64 / f64::from(n * n)
    };
    let [small, large] = [per_particle(129), per_particle(257)];
    assert!((large / small - 1.0).abs() < 0.02 && large > 1000.0, "{small} and {large} bytes");
}
