//! The step that is chosen from the springs: stable for long at the bound itself, and not far below what the springs allow.

use crate::support::{Grid, Parts, Random, changed, settings, with};
use glam::{DVec3, Vec3, vec3};
use toile_files::parse_garment;
use toile_model::{Link, Model, Spring, SpringKind, StepSettings};
use toile_reference::{Colliders, Reference};
use toile_scene::{Fabric, Rule, Settings, VelocityModification};

const STEPS: u32 = 100_000;

fn cotton() -> Settings {
    let settings = Settings::new(Fabric::preset("cotton").expect("a preset"));
    let mut changed = settings;
    changed.velocity_modification = VelocityModification::new(Rule::None);
    changed.spacing = 0.1;
    changed
}

/// The step at the bound, without safety, and nothing that would take energy away.
fn at_bound(model: &Model) -> StepSettings {
    // A frame of a thousand seconds, so that cutting it into whole steps changes nothing.
    let step = StepSettings::new(
        &with(cotton(), |settings| {
            settings.safety = 1.0;
            settings.frame_rate = 1e-3;
        }),
        model,
    );
    let mut changed = settings();
    changed.dt = step.dt;
    changed.gravity = Vec3::ZERO;
    changed.damping = 0.0;
    changed
}

/// Elastic energy [J].
fn elastic(model: &Model, positions: &[Vec3]) -> f64 {
    let links = (0..positions.len()).flat_map(|i| model.links.row(i).iter().map(move |link| (i, link)));
    let energy = links.map(|(i, link)| {
        let length = positions[i].as_dvec3().distance(positions[link.other as usize].as_dvec3());
        // Both ends of a spring have a link.
        0.25 * f64::from(link.stiffness) * (length - f64::from(link.rest_length)).powi(2)
    });
    energy.sum()
}

/// Energy above that at rest [J].
fn energy(model: &Model, reference: &Reference) -> f64 {
    let kinetic = reference.velocities().iter().zip(&model.masses);
    let kinetic: f64 = kinetic.map(|(v, m)| 0.5 * f64::from(*m) * v.as_dvec3().length_squared()).sum();
    kinetic + elastic(model, reference.positions()) - elastic(model, &model.positions)
}

/// Largest energy [J] in the first hundredth of a run, and in all of it, of a model at rest that is displaced. Looked at every fifth
/// step: no mode keeps in step with that for long.
fn energies(model: &Model, step: &StepSettings, displaced: impl Fn(usize) -> Vec3, steps: u32) -> [f64; 2] {
    let start = changed(model.clone(), |start| {
        start.positions.iter_mut().enumerate().for_each(|(i, position)| *position += displaced(i));
    });
    let mut reference = Reference::new(&start, step, Colliders::default());
    let mut largest = |steps: u32| {
        (0..steps / 5).fold(0.0, |largest: f64, _| {
            reference.steps(5);
            // NaN must not be lost.
            let energy = energy(model, &reference);
            if energy.is_finite() { largest.max(energy) } else { f64::INFINITY }
        })
    };
    let first = largest(steps / 100);
    [first, largest(steps - steps / 100).max(first)]
}

/// A grid of which half is a hundred times heavier, when wanted.
fn grid(heavy: f32) -> Model {
    changed(Grid::horizontal(6, 0.02).model(), |model| {
        for i in (0..36).filter(|i| i % 6 < 3) {
            model.masses[i] *= heavy;
            model.inverse_masses[i] /= heavy;
        }
    })
}

/// The skirt, sewn and then left alone until it is at rest; its front is so many times as heavy as its back.
fn skirt(heavy: f32) -> Model {
    let text = include_str!("../../../../fixtures/garments/skirt.json");
    let garment = parse_garment(text, "skirt").expect("it is whole").garment;
    let open = changed(Model::from_garment(&garment, &cotton()).expect("it meshes"), |open| {
        for i in open.panels[0].particles.clone() {
            open.masses[i as usize] *= heavy;
            open.inverse_masses[i as usize] /= heavy;
        }
    });
    let (sewn, _) = open.sewn();
    let mut damped = at_bound(&sewn);
    damped.dt *= 0.5;
    damped.damping = 5.0;
    let mut reference = Reference::new(&sewn, &damped, Colliders::default());
    reference.steps(20_000);
    assert!(reference.kinetic_energy() < 1e-8, "it is at rest");
    changed(sewn, |sewn| sewn.positions = reference.positions().to_vec())
}

/// The fastest mode of the springs around a state at rest, of unit length, and the step that it allows [s]: 2 over its rate. A power iteration
/// of the stiffness along the springs.
fn fastest_mode(model: &Model) -> (Vec<DVec3>, f64) {
    let place = |i: usize| model.positions[i].as_dvec3();
    let mut random = Random(5);
    let mut mode: Vec<DVec3> = model.positions.iter().map(|_| random.vector().as_dvec3()).collect();
    let mut squared_rate = 0.0;
    for _ in 0..3000 {
        let pushed: Vec<DVec3> = (0..mode.len())
            .map(|i| {
                let pull = |link: &Link| {
                    let axis = (place(link.other as usize) - place(i)).normalize();
                    axis * axis.dot(mode[i] - mode[link.other as usize]) * f64::from(link.stiffness)
                };
                model.links.row(i).iter().map(pull).sum::<DVec3>() * f64::from(model.inverse_masses[i])
            })
            .collect();
        squared_rate = pushed.iter().map(|p| p.length_squared()).sum::<f64>().sqrt();
        mode = pushed.iter().map(|p| *p / squared_rate).collect();
    }
    (mode, 2.0 / squared_rate.sqrt())
}

/// So many vectors of up to a length, without any order.
fn noise(length: f32) -> impl Fn(usize) -> Vec3 {
    let mut random = Random(3);
    let vectors: Vec<Vec3> = (0..200).map(|_| random.vector() * length).collect();
    move |i| vectors[i]
}

/// The energy of what swings changes within a step's time; it does not grow when its largest value stays, but for rounding.
fn does_not_grow([first, largest]: [f64; 2]) -> bool {
    first > 0.0 && largest < 1.2 * first
}

#[test]
fn a_grid_is_stable_for_long_at_the_bound() {
    for heavy in [1.0, 100.0] {
        let model = grid(heavy);
        let found = energies(&model, &at_bound(&model), noise(1e-4), STEPS);
        assert!(does_not_grow(found), "masses 1 : {heavy}: {found:?} J");
    }
}

#[test]
fn a_sewn_garment_is_stable_for_long_at_the_bound() {
    for heavy in [1.0, 100.0] {
        let model = skirt(heavy);
        let found = energies(&model, &at_bound(&model), noise(1e-3), STEPS);
        assert!(does_not_grow(found), "masses 1 : {heavy} across its seams: {found:?} J");
    }
}

/// Two particles on one spring: the bound is no estimate.
fn pair() -> Model {
    let spring =
        Spring { ends: [0, 1], rest_length: 0.1, stiffness: 20.0, threshold: 0.05, kind: SpringKind::Structural };
    let positions = vec![Vec3::ZERO, vec3(0.1, 0.0, 0.0)];
    Parts { positions, masses: vec![1e-3; 2], springs: vec![spring], ..Parts::default() }.model()
}

#[test]
fn the_fastest_mode_grows_just_above_its_limit_and_not_below() {
    // Springs at rest have no stiffness across themselves, as the bound allows for: flat cloth could do with half as many steps again.
    for (model, bound) in [(pair(), 1.0), (grid(1.0), 0.657), (grid(100.0), 0.645)] {
        let step = at_bound(&model);
        let (mode, limit) = fastest_mode(&model);
        let found_bound = f64::from(step.dt) / limit;
        assert!((found_bound - bound).abs() < 1e-3, "the bound is {found_bound} of the limit, not {bound}");
        let run = |part: f64, steps: u32| {
            let mut step = step.clone();
            step.dt = (part * limit) as f32;
            energies(&model, &step, |i| mode[i].as_vec3() * 1e-5, steps)
        };
        let below = run(0.99, STEPS);
        assert!(does_not_grow(below), "{below:?} J");
        let [first, largest] = run(1.01, 500);
        assert!(largest > 1e4 * first, "{first} J, then {largest} J");
    }
}

/// The bound is one for small motions. A garment that collapses from its placed panels turns springs inside out, which brings energy in
/// at any step; the damping of the fabric takes out more.
#[test]
fn a_garment_that_collapses_gains_nothing_with_its_damping() {
    let text = include_str!("../../../../fixtures/garments/skirt.json");
    let garment = parse_garment(text, "skirt").expect("it is whole").garment;
    let (sewn, _) = Model::from_garment(&garment, &cotton()).expect("it meshes").sewn();
    let step = at_bound(&sewn);
    let collapse =
        |damping: f32| energies(&sewn, &with(step.clone(), |step| step.damping = damping), |_| Vec3::ZERO, 10_000);
    let damped = collapse(cotton().fabric.damping as f32);
    assert!(damped[1] <= damped[0], "{damped:?} J");
    let free = collapse(0.0);
    assert!(free[1] > 100.0 * free[0], "the test sees what damping does: {free:?} J");
}
