//! Sheets: the grid of D §3.

use crate::support::{alone, check_model, rectangle, settings, spring_count, with};
use glam::{DVec3, Vec3, dvec2, dvec3, vec2};
use toile_model::{Model, SpringKind};
use toile_scene::{Pin, Sheet};

fn sheet(columns: u32, rows: u32) -> Sheet {
    let mut sheet =
        Sheet::new("sheet", [columns, rows], dvec2(0.1 * f64::from(columns - 1), 0.2 * f64::from(rows - 1)));
    sheet.corner = dvec3(-0.5, 2.0, 0.25);
    sheet.down = DVec3::NEG_Y;
    sheet
}

fn model(columns: u32, rows: u32) -> Model {
    let model = Model::from_sheet(&sheet(columns, rows), &settings(1.0));
    check_model(&model);
    model
}

#[test]
fn a_model_has_the_numbers_of_its_own_fabric() {
    let mut own = settings(1.0).fabric;
    own.areal_density = 0.7;
    own.structural_stiffness = 3.0;
    let fabric = Some(own.clone());
    let garment = alone(rectangle("panel", [0.2, 0.3], 0.0));
    let sheets = [sheet(3, 2), with(sheet(3, 2), |sheet| sheet.fabric = fabric.clone())];
    let [default, sheet] = sheets.map(|sheet| Model::from_sheet(&sheet, &settings(1.0)));
    let garments = [garment.clone(), with(garment, |garment| garment.fabric = fabric)];
    let [plain, garment] = garments.map(|garment| Model::from_garment(&garment, &settings(0.05)).expect("it meshes"));
    for (one, other, area) in [(default, sheet, 0.2 * 0.2), (plain, garment, 0.2 * 0.3)] {
        let mass = |model: &Model| f64::from(model.masses.iter().sum::<f32>());
        assert!((mass(&one) - 0.15 * area).abs() < 1e-6 && (mass(&other) - 0.7 * area).abs() < 1e-6);
        assert_eq!((one.stiffness[0] == 3.0, other.stiffness[0] == 3.0), (false, true));
    }
}

#[test]
fn a_sheet_has_the_springs_of_the_papers() {
    for (l, n) in [(2, 2), (2, 5), (3, 3), (7, 4), (12, 30)] {
        let model = model(l, n);
        let (l, n) = (l as usize, n as usize);
        assert_eq!(model.positions.len(), l * n);
        assert_eq!(model.quads.len(), (l - 1) * (n - 1));
        assert_eq!(spring_count(&model, SpringKind::Structural), (l - 1) * n + l * (n - 1));
        assert_eq!(spring_count(&model, SpringKind::Shear), 2 * (l - 1) * (n - 1));
        assert_eq!(spring_count(&model, SpringKind::Bend), (l - 2) * n + l * (n - 2));
    }
}

#[test]
fn a_sheet_needs_eight_colours_at_any_size() {
    for (l, n) in [(3, 3), (4, 5), (16, 16), (17, 33), (64, 64)] {
        assert_eq!(model(l, n).colour_count(), 8, "{l} × {n}");
    }
}

#[test]
fn particles_of_a_sheet_are_row_major_and_start_where_it_is_placed() {
    let model = model(4, 3);
    let particle = 2 * 4 + 1;
    assert!(model.positions[particle].distance(Vec3::new(-0.4, 1.6, 0.25)) < 1e-6);
    assert!(model.flat[particle].distance(vec2(0.1, 0.4)) < 1e-6);
}

#[test]
fn the_outside_of_a_sheet_is_right_cross_down() {
    let model = model(3, 3);
    for [a, b, c] in model.triangles() {
        let [a, b, c] = [a, b, c].map(|i| model.positions[i as usize]);
        assert!((b - a).cross(c - a).dot(Vec3::X.cross(Vec3::NEG_Y)) > 0.0);
    }
}

#[test]
fn rest_lengths_and_stiffnesses_of_a_sheet_follow_from_its_cells() {
    let model = model(5, 5);
    let find = |ends| *model.springs.iter().find(|s| s.ends == ends).unwrap();
    for (ends, kind, rest_length, stiffness) in [
        ([6, 7], SpringKind::Structural, 0.1, 30.0),
        ([6, 11], SpringKind::Structural, 0.2, 30.0),
        ([6, 12], SpringKind::Shear, 0.05_f64.sqrt(), 12.0),
        ([7, 11], SpringKind::Shear, 0.05_f64.sqrt(), 12.0),
        ([6, 8], SpringKind::Bend, 0.2, 3.0),
        ([6, 16], SpringKind::Bend, 0.4, 3.0),
    ] {
        let spring = find(ends);
        assert_eq!((spring.kind, spring.stiffness), (kind, stiffness));
        assert!((f64::from(spring.rest_length) - rest_length).abs() < 1e-6, "{spring:?}");
    }
}

#[test]
fn the_mass_of_a_sheet_is_density_times_area() {
    let model = model(5, 4);
    let mass: f64 = model.masses.iter().map(|&m| f64::from(m)).sum();
    assert!((mass - 0.15 * 0.4 * 0.6).abs() < 1e-8, "{mass}");
    // A corner has a quarter of the mass of an inner particle.
    assert!((model.masses[0] * 4.0 - model.masses[6]).abs() < 1e-8);
}

#[test]
fn a_pinned_particle_keeps_its_mass_and_has_no_inverse_mass() {
    let mut sheet = sheet(4, 4);
    sheet.pins = vec![Pin { column: 3, row: 1 }];
    let model = Model::from_sheet(&sheet, &settings(1.0));
    let pinned: Vec<usize> = (0..16).filter(|&i| model.inverse_masses[i] == 0.0).collect();
    assert_eq!(pinned, [7]);
    assert!(model.masses[7] > 0.0);
}

#[test]
#[should_panic(expected = "at least two columns and two rows")]
fn a_sheet_of_one_row_is_misuse() {
    let mut thin = sheet(4, 2);
    thin.rows = 1;
    Model::from_sheet(&thin, &settings(1.0));
}
