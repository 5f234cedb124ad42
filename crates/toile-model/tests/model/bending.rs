//! Bending rigidity: the flat cloth is at rest, and a bent one has the energy that a laboratory's number says.

use crate::support::{garment, rectangle, settings};
use glam::{DVec3, dvec2};
use toile_model::Model;
use toile_scene::{Rule, Settings, Sheet};

const RIGIDITY: f64 = 2e-5;

fn fabric(spacing: f64, bending_rigidity: f64) -> Settings {
    let mut settings = settings(spacing);
    settings.velocity_modification.rule = Rule::Hierarchical;
    settings.fabric.bending_rigidity = bending_rigidity;
    settings
}

/// A sheet of so many cells on a side.
fn sheet(cells: u32, spacing: f64, bending_rigidity: f64) -> Model {
    let sheet = Sheet::new("sheet", [cells + 1, cells + 1], dvec2(1.0, 1.0) * spacing * f64::from(cells));
    Model::from_sheet(&sheet, &fabric(spacing, bending_rigidity))
}

/// Places of a sheet rolled up along x with the angle `turn` at every column [m]; its sides keep their length.
fn rolled(model: &Model, cells: u32, spacing: f64, turn: f64) -> Vec<DVec3> {
    let mut line = vec![DVec3::ZERO];
    for k in 0..cells {
        let angle = turn * f64::from(k);
        line.push(line[k as usize] + DVec3::new(angle.cos(), angle.sin(), 0.0) * spacing);
    }
    let place = |i: usize| line[i % line.len()] + DVec3::Z * f64::from(model.positions[i].z);
    (0..model.positions.len()).map(place).collect()
}

/// Energy of all links [J].
fn energy(model: &Model, places: &[DVec3]) -> f64 {
    let of = |i: usize| {
        let links = model.links.row(i).iter();
        links.map(move |link| {
            let stretch = places[i].distance(places[link.other as usize]) - f64::from(link.rest_length);
            // Each spring is a link of both its ends.
            0.25 * f64::from(link.stiffness) * stretch * stretch
        })
    };
    (0..places.len()).flat_map(of).sum()
}

#[test]
fn a_flat_sheet_with_bending_rigidity_is_at_rest() {
    for (cells, spacing) in [(8, 0.01), (20, 0.004), (30, 0.002)] {
        let model = sheet(cells, spacing, RIGIDITY);
        assert_at_rest(&model, 1e-4 * 2.0 * RIGIDITY / spacing);
        let stressed = model.links.values.iter().filter(|link| link.rest_length < 0.999 * spacing as f32).count();
        assert!(stressed > 100, "the sides pull: {stressed} of them");
    }
}

/// Checks that springs leave no particle more than a force [N].
fn assert_at_rest(model: &Model, force_max: f64) {
    for i in 0..model.positions.len() {
        let force: DVec3 = model
            .links
            .row(i)
            .iter()
            .map(|link| {
                let span = (model.positions[link.other as usize] - model.positions[i]).as_dvec3();
                let tension = f64::from(link.stiffness) * (span.length() - f64::from(link.rest_length));
                span.normalize() * tension
            })
            .sum();
        // Rest lengths are f32: about 1e-9 m, times a stiffness of a few N/m.
        assert!(force.length() < force_max, "particle {i}: {force}, of {force_max} N");
    }
}

/// ½·B·κ² per area, whatever the spacing; the first and last column do not bend.
#[test]
fn a_rolled_sheet_has_the_energy_of_its_rigidity() {
    // Across two sides, across four, and across more than a row has.
    for (cells, spacing) in [(12, 0.01), (24, 0.008), (24, 0.006), (40, 0.004), (10, 0.004)] {
        for rigidity in [0.2 * RIGIDITY, 0.5 * RIGIDITY] {
            let model = sheet(cells, spacing, rigidity);
            assert_eq!(model.bending_carried, 1.0);
            let curvature = 8.0;
            let bent = rolled(&model, cells, spacing, curvature * spacing);
            let flat = rolled(&model, cells, spacing, 0.0);
            let found = energy(&model, &bent) - energy(&model, &flat);
            let area = f64::from(cells * (cells - 1)) * spacing * spacing;
            let expected = 0.5 * rigidity * curvature * curvature * area;
            // The chord of a turn of 0.08 is shorter than its square says by 1e-3; the springs' own stiffness adds as much.
            assert!((found / expected - 1.0).abs() < 0.01, "{cells} cells: {found} J, not {expected} J");
        }
    }
}

/// What the papers' springs do alone: a thousandth of that at this curvature, and it falls with its square.
#[test]
fn without_rigidity_a_small_curvature_costs_almost_nothing() {
    let (cells, spacing) = (12, 0.01);
    let model = sheet(cells, spacing, 0.0);
    let at = |curvature: f64| energy(&model, &rolled(&model, cells, spacing, curvature * spacing));
    let rigid = 0.5 * RIGIDITY * 64.0 * f64::from(cells * (cells - 1)) * spacing * spacing;
    assert!(at(8.0) < 1e-2 * rigid, "{} J of {rigid} J", at(8.0));
    assert!((at(8.0) / at(4.0) - 16.0).abs() < 0.2, "{} and {}", at(8.0), at(4.0));
}

/// Across eight sides, which is as many as a row has, the step carries 21 times what it does across two.
#[test]
fn what_the_step_cannot_carry_is_told() {
    let carried = |spacing| sheet(8, spacing, RIGIDITY).bending_carried;
    assert_eq!([carried(0.01), carried(0.004)], [1.0; 2]);
    let [fine, finer] = [carried(0.002), carried(0.001)];
    assert!((0.05..0.9).contains(&fine), "{fine}");
    assert!((15.9..16.1).contains(&(fine / finer)), "it falls with the fourth power of the spacing: {fine} to {finer}");
}

/// Arches of eight sides and more, in sheets whose rows have fewer, and around tubes that are hardly longer or shorter around.
#[test]
fn no_two_springs_join_the_same_particles() {
    let spacing = 0.004;
    let mut models = vec![sheet(8, 0.01, RIGIDITY), sheet(20, spacing, RIGIDITY), sheet(8, 0.002, RIGIDITY)];
    for cells in 2..8 {
        let side = |name, depth| rectangle(name, [spacing * f64::from(cells), 0.06], depth);
        let tube = garment(vec![side("front", 0.01), side("back", -0.01)], &[([0, 1], [1, 1]), ([0, 3], [1, 3])]);
        let (model, _) = Model::from_garment(&tube, &fabric(spacing, RIGIDITY)).expect("it meshes").sewn();
        assert!(model.bending_carried > 0.2, "{} of a tube of {} sides", model.bending_carried, 2 * cells);
        models.push(model);
    }
    for model in models {
        assert_eq!(model.links.values.len(), 2 * model.springs.len(), "as many whatever the rigidity is");
        for i in 0..model.positions.len() {
            let live = model.links.row(i).iter().filter(|link| link.stiffness > 0.0);
            let mut others: Vec<u32> = live.map(|link| link.other).collect();
            others.sort_unstable();
            assert!(others.windows(2).all(|pair| pair[0] < pair[1]), "particle {i}: {others:?}");
            assert!(!others.contains(&(i as u32)), "particle {i} and itself");
        }
    }
}
