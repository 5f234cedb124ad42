//! Seams: which particles meet, and what the sewn model is.

use crate::support::*;
use glam::{DVec2, dvec2};
use toile_model::{Merge, Model, Spring, SpringKind};
use toile_scene::{Curve, Garment};

/// Front and back of a tube, 0.4 m apart: the sides of two rectangles of 0.3 m × 0.2 m. The back runs clockwise.
fn tube() -> Garment {
    let mut back = rectangle("back", [0.3, 0.2], -0.2);
    back.edges.reverse();
    // Starts at (0, 0.2): edges are top, right, bottom, left.
    garment(vec![rectangle("front", [0.3, 0.2], 0.2), back], &[([0, 1], [1, 1]), ([0, 3], [1, 3])])
}

/// A skirt of 0.4 m gathered to a band of 0.3 m below it.
fn gathered() -> Garment {
    let skirt = polygon("skirt", &[dvec2(-0.05, 0.05), dvec2(0.35, 0.05), dvec2(0.35, 0.25), dvec2(-0.05, 0.25)], 0.0);
    garment(vec![rectangle("band", [0.3, 0.04], 0.0), skirt], &[([0, 2], [1, 0])])
}

/// Four squares that meet in one corner.
fn cross() -> Garment {
    let at = |x: f64, y: f64, name: &str| {
        let corners = [dvec2(0.0, 0.0), dvec2(0.1, 0.0), dvec2(0.1, 0.1), dvec2(0.0, 0.1)];
        polygon(name, &corners.map(|p| p + dvec2(x, y)), 0.0)
    };
    let panels = vec![at(0.0, 0.0, "a"), at(0.11, 0.0, "b"), at(0.11, 0.11, "c"), at(0.0, 0.11, "d")];
    garment(panels, &[([0, 1], [1, 3]), ([1, 2], [2, 0]), ([2, 3], [3, 1]), ([3, 0], [0, 2])])
}

fn dart() -> Garment {
    let points = [
        dvec2(0.0, 0.0),
        dvec2(0.4, 0.0),
        dvec2(0.4, 0.3),
        dvec2(0.22, 0.3),
        dvec2(0.2, 0.15),
        dvec2(0.18, 0.3),
        dvec2(0.0, 0.3),
    ];
    garment(vec![polygon("dart", &points, 0.0)], &[([0, 3], [0, 4])])
}

fn sewn(garment: &Garment, spacing: f64) -> (Model, Model, Merge) {
    let open = build(garment, spacing);
    check_model(&open);
    check_meshes(&open, garment);
    let (sewn, merge) = open.sewn();
    check_model(&sewn);
    check_merge(&open, &sewn, &merge);
    (open, sewn, merge)
}

fn check_merge(open: &Model, sewn: &Model, merge: &Merge) {
    let mut members: Vec<u32> = merge.members.values.clone();
    members.sort_unstable();
    assert!(members.into_iter().eq(0..open.particle_count()), "each particle is a member once");
    assert!((0..merge.members.row_count()).all(|k| merge.members.row(k).is_sorted()));
    for k in 0..sewn.positions.len() {
        let row = merge.members.row(k);
        let mass: f32 = row.iter().map(|&i| open.masses[i as usize]).sum();
        assert!((sewn.masses[k] / mass - 1.0).abs() < 1e-5);
        let mean = row.iter().map(|&i| open.positions[i as usize] * open.masses[i as usize]).sum::<glam::Vec3>() / mass;
        assert!(sewn.positions[k].distance(mean) < 1e-5);
        assert_eq!(sewn.flat[k], open.flat[row[0] as usize]);
    }
    assert!(sewn.seam_pairs.is_empty() && sewn.springs.iter().all(|s| s.kind != SpringKind::Seam));
}

fn find(model: &Model, a: u32, b: u32) -> Option<Spring> {
    model.springs.iter().find(|s| s.ends == [a.min(b), a.max(b)]).copied()
}

/// Particle of the sewn model at a flat place of a panel of the open one.
fn sewn_at(open: &Model, merge: &Merge, panel: usize, flat: DVec2) -> u32 {
    let particles = open.panels[panel].particles.clone();
    let open_particle =
        particles.into_iter().find(|&i| open.flat[i as usize].as_dvec2().distance(flat) < 1e-5).unwrap();
    (0..merge.members.row_count()).find(|&k| merge.members.row(k).contains(&open_particle)).unwrap() as u32
}

#[test]
fn a_seam_pairs_the_particles_across_and_names_its_edges() {
    let open = build(&tube(), 0.05);
    assert_eq!(open.seam_names, ["front.1 to back.1", "front.3 to back.3"]);
    assert_eq!(open.seam_pairs.len(), 2 * 5);
    for pair in &open.seam_pairs {
        let [a, b] = pair.ends.map(|i| open.positions[i as usize]);
        assert!((a.distance(b) - 0.4).abs() < 1e-6, "{a} {b}");
        assert!((pair.closing_speed - 0.4 / 0.3).abs() < 1e-5);
        let spring = find(&open, pair.ends[0], pair.ends[1]).unwrap();
        assert_eq!((spring.kind, spring.rest_length, spring.stiffness), (SpringKind::Seam, 0.0, 0.003));
        assert!(open.limits.iter().all(|l| l.ends != pair.ends));
    }
}

#[test]
fn a_pair_closes_neither_too_slowly_nor_too_fast() {
    let mut near = tube();
    near.panels[0].placement.translation.z = -0.19;
    assert!(build(&near, 0.05).seam_pairs.iter().all(|p| p.closing_speed == 0.2));
    let mut far = tube();
    far.panels[0].placement.translation.z = 2.0;
    assert!(build(&far, 0.05).seam_pairs.iter().all(|p| p.closing_speed == 4.0));
}

#[test]
fn where_distances_do_not_tell_the_winding_does() {
    // Two squares one over the other, seen along the seam: its ends are equally far either way.
    let square = |name, depth| {
        let corners = [dvec2(-0.1, -0.1), dvec2(0.1, -0.1), dvec2(0.1, 0.1), dvec2(-0.1, 0.1)];
        let mut panel = polygon(name, &corners, depth);
        if depth < 0.0 {
            panel.placement.rotation = glam::DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2);
        }
        panel
    };
    let mut garment = garment(vec![square("one", 0.3), square("other", -0.3)], &[([0, 0], [1, 0])]);
    // Loops are followed from the start of each edge: pair k of the first with pair k or with the last but k of the other.
    let along = |open: &Model| {
        let first = &open.seam_pairs[0];
        let [a, b] = first.ends.map(|i| open.flat[i as usize].x);
        (a - b).abs() < 1e-6
    };
    assert!(!along(&build(&garment, 0.05)), "outsides run opposite");
    garment.seams[0].right_wrong = true;
    assert!(along(&build(&garment, 0.05)), "an outside on an inside runs along");
}

#[test]
fn a_sewn_tube_is_a_tube_with_springs_across_the_seam_like_those_beside_it() {
    let (open, sewn, merge) = sewn(&tube(), 0.05);
    assert_eq!(topology(&sewn), [1, 2, 0]);
    assert_eq!(sewn.particle_count(), 12 * 5);
    assert_eq!(sewn.quads.len(), open.quads.len());
    assert_eq!(spring_count(&sewn, SpringKind::Structural), 12 * 5 + 12 * 4);
    assert_eq!(spring_count(&sewn, SpringKind::Shear), 2 * 12 * 4);
    assert_eq!(spring_count(&sewn, SpringKind::Bend), 12 * 5 + 12 * 3);
    let front = sewn_at(&open, &merge, 0, dvec2(0.25, 0.1));
    let back = sewn_at(&open, &merge, 1, dvec2(0.25, 0.1));
    let across = find(&sewn, front, back).unwrap();
    assert_eq!((across.kind, across.stiffness), (SpringKind::Bend, 3.0));
    assert!((across.rest_length - 0.1).abs() < 1e-6);
    let [low, high] = [0.1, 0.15].map(|y| sewn_at(&open, &merge, 0, dvec2(0.3, y)));
    let along = find(&sewn, low, high).unwrap();
    assert_eq!((along.kind, along.stiffness), (SpringKind::Structural, 60.0), "both sides of a seam carry");
}

#[test]
fn two_triangles_across_a_seam_have_a_shear_spring_between_their_tips() {
    let one = polygon("one", &[dvec2(0.0, 0.0), dvec2(0.06, 0.0), dvec2(0.02, 0.05)], 0.0);
    let other = polygon("other", &[dvec2(0.0, -0.01), dvec2(0.03, -0.06), dvec2(0.06, -0.01)], 0.0);
    let (_, sewn, _) = sewn(&garment(vec![one, other], &[([0, 0], [1, 2])]), 0.08);
    assert_eq!(sewn.particle_count(), 4);
    let shear: Vec<&Spring> = sewn.springs.iter().filter(|s| s.kind == SpringKind::Shear).collect();
    assert_eq!(shear.len(), 1);
    assert!((f64::from(shear[0].rest_length) - dvec2(0.02, 0.05).distance(dvec2(0.03, -0.05))).abs() < 1e-6);
}

#[test]
fn the_longer_side_of_a_seam_is_gathered() {
    let (open, sewn, merge) = sewn(&gathered(), 0.05);
    // (0.3 + 0.4) / 2 at 0.05: seven on both sides, and on the sides opposite to them.
    assert_eq!(open.seam_pairs.len(), 8);
    assert_eq!(open.quads.len(), 7 + 7 * 4, "both panels stay grids");
    let [a, b] = [0.0, 0.3 / 7.0].map(|x| sewn_at(&open, &merge, 0, dvec2(x, 0.04)));
    let seam = find(&sewn, a, b).unwrap();
    assert!((f64::from(seam.rest_length) - 0.3 / 7.0).abs() < 1e-6, "{seam:?}");
    assert_eq!(seam.stiffness, 60.0);
    let limit = sewn.limits.iter().find(|l| l.ends == seam.ends).unwrap();
    assert!((limit.max_length - 1.05 * seam.rest_length).abs() < 1e-6);
    assert_eq!(topology(&sewn), [1, 1, 1]);
}

#[test]
fn corners_where_several_seams_meet_become_one_particle() {
    let (open, sewn, merge) = sewn(&cross(), 0.05);
    assert_eq!(open.particle_count(), 4 * 9);
    assert_eq!(sewn.particle_count(), 25);
    assert_eq!((0..25).map(|k| merge.members.row(k).len()).max(), Some(4));
    assert_eq!(topology(&sewn), [1, 1, 1]);
    assert_eq!(spring_count(&sewn, SpringKind::Structural), 40);
    assert_eq!(spring_count(&sewn, SpringKind::Shear), 32);
    assert_eq!(spring_count(&sewn, SpringKind::Bend), 30);
    assert_eq!(sewn.colour_count(), 8);
}

#[test]
fn the_sides_of_a_dart_share_its_tip() {
    let (open, sewn, merge) = sewn(&dart(), 0.03);
    let tip = sewn_at(&open, &merge, 0, dvec2(0.2, 0.15));
    assert_eq!(merge.members.row(tip as usize).len(), 1);
    assert!(open.seam_pairs.iter().all(|p| p.ends[0] != p.ends[1]));
    assert_eq!(open.seam_pairs.len(), 5);
    assert_eq!(topology(&sewn), [1, 1, 1]);
}

#[test]
fn both_sides_of_a_seam_have_the_same_number_of_particles_also_through_other_panels() {
    // a is sewn to b and b to c: all three edges differ in length.
    let panels = [0.30, 0.33, 0.36]
        .map(|w| polygon("panel", &[dvec2(0.0, 0.0), dvec2(w, 0.0), dvec2(w - 0.01, 0.2), dvec2(0.02, 0.21)], 5.0 * w));
    let garment = garment(panels.into(), &[([0, 0], [1, 0]), ([1, 0], [2, 0])]);
    let open = build(&garment, 0.03);
    assert_eq!(open.seam_pairs.len(), 2 * 12);
}

#[test]
fn labelled_edges_are_held_once_at_their_mean_height() {
    let mut garment = tube();
    // Two neighbouring edges share a corner.
    garment.panels[0].edges[2].label = Some("waist".into());
    garment.panels[0].edges[3].label = Some("side".into());
    garment.panels[0].placement.translation.y = 1.0;
    let (open, sewn, _) = sewn(&garment, 0.05);
    assert_eq!(open.held_particles.len(), 7 + 4);
    let labels: Vec<_> = open.holds.iter().map(|h| h.label.as_str()).collect();
    assert_eq!(labels, ["side", "waist"]);
    for hold in &open.holds {
        let members = &open.held_particles[hold.particles.start as usize..hold.particles.end as usize];
        let mean = members.iter().map(|&i| open.positions[i as usize].y).sum::<f32>() / members.len() as f32;
        assert!((hold.height - mean).abs() < 1e-6);
    }
    let distinct: std::collections::BTreeSet<_> = open.held_particles.iter().collect();
    assert_eq!(distinct.len(), open.held_particles.len(), "the shared corner is held once");
    // Sewn, the same edges are held at the same heights, each merged particle once.
    assert_eq!(sewn.holds.len(), 2);
    assert_eq!(sewn.holds[1].height, open.holds[1].height);
    let distinct: std::collections::BTreeSet<_> = sewn.held_particles.iter().collect();
    assert_eq!(distinct.len(), sewn.held_particles.len());
}

#[test]
fn a_closed_outline_sewn_to_itself_collapses_without_broken_quads() {
    // A strip one cell wide whose long sides are sewn together: every quad folds flat.
    let strip = polygon("strip", &[dvec2(0.0, 0.0), dvec2(0.2, 0.0), dvec2(0.2, 0.05), dvec2(0.0, 0.05)], 0.0);
    let open = build(&garment(vec![strip], &[([0, 0], [0, 2])]), 0.05);
    let (sewn, _) = open.sewn();
    assert!(sewn.quads.is_empty());
    assert!(sewn.springs.iter().all(|s| s.ends[0] != s.ends[1]));
}

#[test]
fn a_seam_of_two_curves_joins_them_end_to_end() {
    let neck = |name, depth: f64, sag: f64| {
        let mut panel = rectangle(name, [0.4, 0.3], depth);
        panel.edges[2].curve = Curve::Quadratic { control: dvec2(0.2, 0.3 - sag) };
        panel
    };
    let garment = garment(vec![neck("front", 0.1, 0.2), neck("back", -0.1, 0.18)], &[([0, 2], [1, 2])]);
    let (open, sewn, _) = sewn(&garment, 0.03);
    assert_eq!(topology(&sewn), [1, 1, 1]);
    for pair in &open.seam_pairs {
        let [a, b] = pair.ends.map(|i| open.positions[i as usize]);
        assert!(a.distance(b) < 0.22);
    }
}

#[test]
fn a_corner_between_two_seams_is_one_pair() {
    // Edges 1 and 2 of two squares share the corner (0.1, 0.1); both seams pair it.
    let squares = vec![rectangle("one", [0.1, 0.1], 0.0), rectangle("other", [0.1, 0.1], 0.1)];
    let open = build(&garment(squares, &[([0, 1], [1, 1]), ([0, 2], [1, 2])]), 0.05);
    assert_eq!(open.seam_pairs.len(), 5);
    check_model(&open);
}
