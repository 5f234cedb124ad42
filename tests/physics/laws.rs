//! Free fall, momentum, pinned particles.

use glam::Vec3;
use toile_lab::fixtures::scene;
use toile_model::{Model, StepSettings};
use toile_report::experiments::validation::laws::{free_fall_error, momentum_error};
use toile_scene::{Cloth, Rule, Scene, VelocityModification};
use toile_workspace::{advance, gpu, lab};

fn simulate(model: &Model, settings: &StepSettings) -> toile::Cloth {
    toile::Cloth::new(&gpu().device, model, settings, Default::default()).expect("it fits the device")
}

/// After n steps of symplectic Euler from rest a body has fallen g·dt²·n(n + 1)/2, which is not ½·g·t². Limits change
/// velocities only along springs that are over-long, and in free fall none is.
#[test]
fn a_free_sheet_falls_as_symplectic_euler_says() {
    for rule in [Rule::None, Rule::Average, Rule::Predictive, Rule::Hierarchical] {
        let error = free_fall_error(&lab(), rule, 16).expect("the device answers");
        assert!(error.from_euler < 1e-6, "{rule:?}: {error:?}");
        assert!(error.from_parabola > 4.0 * error.from_euler, "{rule:?}: the test tells it from the parabola");
    }
}

/// What a crumpled sheet gains of momentum by itself.
fn drift(rule: Rule) -> f64 {
    momentum_error(&lab(), rule).expect("the device answers").linear
}

#[test]
fn springs_and_limits_keep_the_momentum() {
    for rule in [Rule::None, Rule::Average, Rule::Predictive, Rule::Position, Rule::Hierarchical] {
        let drift = drift(rule);
        assert!(drift < 1e-6, "{rule:?}: the centre of mass moves {drift} of the mean way");
    }
}

/// The saboteurs of the test above: two rules that do not keep it, as the papers define them.
#[test]
fn the_papers_first_and_last_rules_do_not_keep_the_momentum() {
    for rule in [Rule::Zero, Rule::Directional] {
        let drift = drift(rule);
        // Without gravity and body Directional has no direction and averages.
        assert_eq!(drift < 1e-6, rule == Rule::Directional, "{rule:?}: {drift}");
    }
}

#[test]
fn springs_keep_the_angular_momentum() {
    let error = momentum_error(&lab(), Rule::None).expect("the device answers");
    assert!(error.angular < 1e-6, "{error:?}");
}

#[test]
fn pinned_particles_do_not_move() {
    for (_, rule) in Rule::ALL {
        let Scene { mut settings, cloths, .. } = scene("hang", &[("n", "16")]);
        settings.velocity_modification = VelocityModification::new(rule);
        settings.velocity_modification.sweeps = Some(2);
        let Cloth::Sheet(sheet) = &cloths[0] else { panic!("hang has a sheet") };
        let model = Model::from_sheet(sheet, &settings);
        let mut cloth = simulate(&model, &StepSettings::new(&settings, &model));
        for _ in 0..20 {
            advance(&mut cloth).expect("it stays finite");
        }
        let end: Vec<Vec3> = gpu().vec3s(&cloth.frame().positions);
        let pinned: Vec<usize> = (0..end.len()).filter(|i| model.inverse_masses[*i] == 0.0).collect();
        assert_eq!(pinned.len(), 2);
        assert!(pinned.iter().all(|i| end[*i] == model.positions[*i]), "{rule:?}");
        assert!(
            end.iter().zip(&model.positions).filter(|(p, start)| p != start).count() > 250,
            "{rule:?}: the rest moves"
        );
    }
}
