//! Panels of all shapes.

use crate::support::*;
use glam::{DQuat, DVec2, DVec3, dvec2};
use std::f64::consts::TAU;
use std::fmt::Write;
use toile_model::{Model, ModelError, NO_CORNER, SpringKind};
use toile_scene::{Curve, Panel, Rule};

fn arc(radius: f64, right: bool) -> Curve {
    Curve::Arc { radius, large: false, right }
}

fn circle() -> Panel {
    panel("circle", [(dvec2(-0.2, 0.0), arc(0.2, true)), (dvec2(0.2, 0.0), arc(0.2, true))], 0.0)
}

/// A quarter moon: a half circle, and a flatter arc back inside of it.
fn crescent() -> Panel {
    panel("crescent", [(dvec2(0.0, -0.2), arc(0.2, true)), (dvec2(0.0, 0.2), arc(0.25, false))], 0.0)
}

fn dart() -> Panel {
    polygon(
        "dart",
        &[
            dvec2(0.0, 0.0),
            dvec2(0.4, 0.0),
            dvec2(0.4, 0.3),
            dvec2(0.22, 0.3),
            dvec2(0.2, 0.15),
            dvec2(0.18, 0.3),
            dvec2(0.0, 0.3),
        ],
        0.0,
    )
}

fn notch() -> Panel {
    polygon(
        "notch",
        &[
            dvec2(0.0, 0.0),
            dvec2(0.4, 0.0),
            dvec2(0.4, 0.3),
            dvec2(0.25, 0.3),
            dvec2(0.25, 0.12),
            dvec2(0.15, 0.12),
            dvec2(0.15, 0.3),
            dvec2(0.0, 0.3),
        ],
        0.0,
    )
}

fn needle() -> Panel {
    polygon("needle", &[dvec2(0.0, 0.0), dvec2(0.5, -0.004), dvec2(0.5, 0.004)], 0.0)
}

fn star() -> Panel {
    let point = |k: usize| DVec2::from_angle(TAU * k as f64 / 10.0) * if k.is_multiple_of(2) { 0.3 } else { 0.15 };
    polygon("star", &(0..10).map(point).collect::<Vec<_>>(), 0.0)
}

/// A curved band narrower than two steps.
fn band() -> Panel {
    panel(
        "band",
        [
            (dvec2(0.0, 0.0), arc(0.6, true)),
            (dvec2(0.4, 0.0), Curve::Straight),
            (dvec2(0.4, 0.03), arc(0.57, false)),
            (dvec2(0.0, 0.03), Curve::Straight),
        ],
        0.0,
    )
}

fn trapezoid() -> Panel {
    polygon("trapezoid", &[dvec2(0.0, 0.0), dvec2(0.5, 0.0), dvec2(0.42, 0.4), dvec2(0.08, 0.4)], 0.0)
}

fn mirrored(panel: &Panel) -> Panel {
    let mut mirrored = panel.clone();
    mirrored.name = format!("mirrored {}", panel.name);
    for edge in &mut mirrored.edges {
        edge.start.x = -edge.start.x;
        if let Curve::Arc { right, .. } = &mut edge.curve {
            *right = !*right;
        }
    }
    mirrored
}

#[test]
fn shapes_become_valid_meshes_with_good_angles() {
    let mut table = String::new();
    for (shape, bound) in [
        (circle(), 36.0),
        (crescent(), 33.0),
        (dart(), 45.0),
        (notch(), 50.0),
        (needle(), 0.7),
        (star(), 28.0),
        (band(), 30.0),
        (trapezoid(), 38.0),
    ] {
        for shape in [mirrored(&shape), shape] {
            for spacing in [0.05, 0.03, 0.02, 0.01, 0.005] {
                let garment = alone(shape.clone());
                let model = build(&garment, spacing);
                check_model(&model);
                check_meshes(&model, &garment);
                let worst = model.panels[0].worst_angle;
                assert!(worst > bound, "{} at {spacing}: {worst}°", shape.name);
                let triangles = model.quads.iter().filter(|q| q[3] == NO_CORNER).count();
                writeln!(
                    table,
                    "{:<20} {spacing:<5} {:>6} particles {:>6} quads {triangles:>4} triangles {:>6} springs {:>3} colours {worst:>3.0}°",
                    shape.name,
                    model.particle_count(),
                    model.quads.len() - triangles,
                    model.spring_count(),
                    model.colour_count(),
                )
                .unwrap();
            }
        }
    }
    insta::assert_snapshot!("shapes", table);
}

#[test]
fn most_of_a_panel_is_regular() {
    let spacing = 0.01;
    for shape in [circle(), dart(), star(), trapezoid()] {
        let model = build(&alone(shape), spacing);
        let square = |quad: &&[u32; 4]| {
            quad[3] != NO_CORNER && {
                let sides =
                    [0, 1, 2, 3].map(|k| model.flat[quad[(k + 1) % 4] as usize].distance(model.flat[quad[k] as usize]));
                sides.iter().all(|s| (s / 0.01 - 1.0).abs() < 0.1)
            }
        };
        let share = model.quads.iter().filter(square).count() as f64 / model.quads.len() as f64;
        assert!(share > 0.6, "{share}");
    }
}

#[test]
fn a_rectangle_becomes_the_grid_of_the_papers_wherever_it_lies() {
    for angle in [0.0, 0.3, 1.0, 2.5, 4.0] {
        for reversed in [false, true] {
            let mut points: Vec<DVec2> = [dvec2(0.0, 0.0), dvec2(0.33, 0.0), dvec2(0.33, 0.18), dvec2(0.0, 0.18)]
                .map(|p| DVec2::from_angle(angle).rotate(p) + dvec2(0.7, -0.2))
                .into();
            if reversed {
                points.reverse();
            }
            let garment = alone(polygon("rectangle", &points, 0.0));
            let model = build(&garment, 0.03);
            check_model(&model);
            check_meshes(&model, &garment);
            let (l, n) = (12, 7);
            assert_eq!(model.positions.len(), l * n);
            assert_eq!(model.quads.len(), (l - 1) * (n - 1));
            assert_eq!(spring_count(&model, SpringKind::Structural), (l - 1) * n + l * (n - 1));
            assert_eq!(spring_count(&model, SpringKind::Shear), 2 * (l - 1) * (n - 1));
            assert_eq!(spring_count(&model, SpringKind::Bend), (l - 2) * n + l * (n - 2));
            assert_eq!(model.colour_count(), 8);
            assert!(
                model
                    .springs
                    .iter()
                    .filter(|s| s.kind == SpringKind::Structural)
                    .all(|s| (s.rest_length - 0.03).abs() < 1e-6)
            );
            assert!((model.panels[0].worst_angle - 90.0).abs() < 0.01);
        }
    }
}

#[test]
fn a_side_made_of_several_edges_still_gives_a_grid() {
    let points = [0.0, 0.1, 0.26, 0.4].map(|x| dvec2(x, 0.0)).into_iter().chain([dvec2(0.4, 0.05), dvec2(0.0, 0.05)]);
    let garment = alone(polygon("waistband", &points.collect::<Vec<_>>(), 0.0));
    let model = build(&garment, 0.025);
    check_meshes(&model, &garment);
    assert_eq!(model.particle_count(), 17 * 3);
    assert_eq!(model.quad_count(), 16 * 2);
}

#[test]
fn the_mass_of_any_panel_is_density_times_area() {
    for shape in [circle(), crescent(), dart(), star()] {
        let model = build(&alone(shape), 0.01);
        let mass: f64 = model.masses.iter().map(|&m| f64::from(m)).sum();
        assert!((mass - 0.15 * flat_area(&model)).abs() < 1e-6 * mass);
    }
    let disc = build(&alone(circle()), 0.005);
    assert!((flat_area(&disc) / (TAU / 2.0 * 0.04) - 1.0).abs() < 2e-4);
}

#[test]
fn rest_lengths_are_distances_in_the_flat_panel_not_in_the_world() {
    let mut shape = star();
    shape.placement.rotation = DQuat::from_rotation_y(1.0);
    shape.placement.translation = DVec3::new(5.0, 1.0, 2.0);
    let model = build(&alone(shape), 0.02);
    for spring in &model.springs {
        let [a, b] = spring.ends.map(|i| model.flat[i as usize]);
        assert!((a.distance(b) - spring.rest_length).abs() < 1e-6);
    }
}

#[test]
fn quads_face_the_outside_of_the_panel_whatever_its_winding() {
    for (shape, outside) in [(trapezoid(), 1.0), (mirrored(&trapezoid()), -1.0)] {
        let model = build(&alone(shape), 0.02);
        for [a, b, c] in model.triangles() {
            let [a, b, c] = [a, b, c].map(|i| model.positions[i as usize]);
            assert!((b - a).cross(c - a).z * outside > 0.0);
        }
    }
}

#[test]
fn bend_springs_go_straight_on_in_the_rim_too() {
    let model = build(&alone(circle()), 0.02);
    let bends = spring_count(&model, SpringKind::Bend);
    // A grid has two per particle but for the two outermost rows and columns.
    assert!(bends as f64 > 1.5 * model.positions.len() as f64, "{bends}");
    for spring in model.springs.iter().filter(|s| s.kind == SpringKind::Bend) {
        let [a, b] = spring.ends;
        let neighbours = |i: u32| {
            model
                .springs
                .iter()
                .filter(move |s| s.kind == SpringKind::Structural && s.ends.contains(&i))
                .map(move |s| s.ends[0] + s.ends[1] - i)
        };
        let straight = neighbours(a).filter(|m| neighbours(b).any(|n| n == *m)).any(|middle| {
            let [a, b, m] = [a, b, middle].map(|i| model.flat[i as usize]);
            (m - a).angle_to(b - m).abs().to_degrees() <= 30.0
        });
        assert!(straight, "{spring:?}");
    }
}

#[test]
fn an_outline_too_curved_for_the_spacing_gets_more_particles() {
    // One segment would cut off the outer arc and with it the middle of the inner side.
    let arch = panel(
        "arch",
        [
            (dvec2(0.0, 0.18), Curve::Quadratic { control: dvec2(0.2, 0.17) }),
            (dvec2(0.4, 0.0), Curve::Straight),
            (dvec2(0.42, 0.0), Curve::Quadratic { control: dvec2(0.0, 0.42) }),
            (dvec2(-0.42, 0.0), Curve::Straight),
            (dvec2(-0.4, 0.0), Curve::Quadratic { control: dvec2(-0.2, 0.17) }),
        ],
        0.0,
    );
    for (shape, spacing, least) in [(arch, 1.0, 6), (circle(), 2.0, 4), (crescent(), 2.0, 4)] {
        let garment = alone(shape);
        let model = build(&garment, spacing);
        check_model(&model);
        check_meshes(&model, &garment);
        assert!(model.particle_count() >= least);
    }
}

#[test]
fn an_edge_much_shorter_than_the_spacing_becomes_one_particle() {
    let points = [dvec2(0.0, 0.0), dvec2(0.4, 0.02), dvec2(0.4, 0.3), dvec2(0.398, 0.302), dvec2(0.0, 0.3)];
    let garment = alone(polygon("clipped", &points, 0.0));
    let coarse = build(&garment, 0.02);
    check_meshes(&coarse, &garment);
    assert!(coarse.panels[0].worst_angle > 35.0);
    let corner = coarse.flat.iter().filter(|p| p.as_dvec2().distance(dvec2(0.399, 0.301)) < 0.01).count();
    assert_eq!(corner, 1);
    let fine = build(&garment, 0.004);
    let corner = fine.flat.iter().filter(|p| p.as_dvec2().distance(dvec2(0.399, 0.301)) < 0.0018).count();
    assert_eq!(corner, 2);
}

#[test]
fn a_strip_narrower_than_the_spacing_is_one_row() {
    let garment = alone(rectangle("strip", [0.5, 0.004], 0.0));
    let model = build(&garment, 0.05);
    check_meshes(&model, &garment);
    assert_eq!((model.particle_count(), model.quad_count()), (22, 10));
}

#[test]
fn the_same_garment_gives_the_same_model() {
    let garment = alone(star());
    assert_eq!(build(&garment, 0.01), build(&garment, 0.01));
}

#[test]
fn what_cannot_be_a_model_is_said_in_one_sentence() {
    let bow = polygon("bow", &[dvec2(0.0, 0.0), dvec2(0.4, 0.3), dvec2(0.4, 0.0), dvec2(0.0, 0.2)], 0.0);
    let line = polygon("line", &[dvec2(0.0, 0.0), dvec2(0.4, 0.0), dvec2(0.2, 0.0)], 0.0);
    let mut messages = String::new();
    for (panel, spacing) in
        [(circle(), 0.0), (circle(), f64::NAN), (circle(), f64::INFINITY), (circle(), 1e-5), (bow, 0.05), (line, 0.05)]
    {
        let error: ModelError = Model::from_garment(&alone(panel), &settings(spacing)).unwrap_err();
        writeln!(messages, "{error}").unwrap();
    }
    insta::assert_snapshot!("errors", messages);
}

#[test]
fn under_the_predictive_rule_links_are_soft_enough_for_the_step_that_is_wanted() {
    let mut settings = settings(0.01);
    let stiff = Model::from_garment(&alone(star()), &settings).unwrap();
    settings.velocity_modification.rule = Rule::Predictive;
    let soft = Model::from_garment(&alone(star()), &settings).unwrap();
    let step = soft.step_wanted.unwrap();
    let rate = |model: &Model, i: usize| {
        let stiffness: f32 = model.links.row(i).iter().map(|l| l.stiffness).sum();
        f64::from(2.0 * stiffness * model.inverse_masses[i]).sqrt()
    };
    let count = soft.positions.len();
    assert!((0..count).any(|i| rate(&stiff, i) * step > 2.0), "the fabric is too stiff for the step");
    assert!((0..count).all(|i| rate(&soft, i) * step < 2.0 + 1e-5));
    assert_eq!(soft.springs, stiff.springs);
    for i in 0..count as u32 {
        for link in soft.links.row(i as usize) {
            let back = soft.links.row(link.other as usize).iter().find(|l| l.other == i).unwrap();
            assert_eq!(link.stiffness, back.stiffness, "both ends of a spring pull alike");
        }
    }
}
