//! What is found and mended before sewing.

use glam::{DMat3, DQuat, DVec3, Vec3};
use std::f64::consts::FRAC_PI_2;
use std::path::{Path, PathBuf};
use toile_files::{BodyOptions, read_garment, read_moving_body};
use toile_model::{Axis, Finding, Fit, FitError, FitOptions};
use toile_scene::{Body, Cloth, Curve, Edge, Fabric, Garment, Mesh, MovingMesh, Scene, Settings};

fn fixture(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(path)
}

fn woman(clip: &str) -> MovingMesh {
    let mut options = BodyOptions::default();
    options.clip = Some(clip.to_owned());
    read_moving_body(&fixture("bodies/walking_woman.glb"), &options).expect("the fixture").body
}

fn garment(name: &str) -> Garment {
    read_garment(&fixture(&format!("garments/{name}.json"))).expect("the fixture").garment
}

fn scene(body: Body, garments: &[Garment]) -> Scene {
    let mut scene = Scene::new("fit", Settings::new(Fabric::preset("cotton").expect("a preset")));
    scene.cloths = garments.iter().cloned().map(Cloth::Garment).collect();
    scene.bodies = vec![body];
    scene
}

fn fit(body: Body, garments: &[Garment]) -> Result<Fit, FitError> {
    Fit::new(&scene(body, garments), &FitOptions::default())
}

fn mesh_of(fit: &Fit) -> &Mesh {
    match &fit.scene.bodies[0] {
        Body::Mesh(mesh) => mesh,
        Body::Moving(moving) => &moving.mesh,
        Body::Shape(_) => panic!("a mesh"),
    }
}

fn garment_of(fit: &Fit) -> &Garment {
    let Cloth::Garment(garment) = &fit.scene.cloths[0] else { panic!("a garment") };
    garment
}

/// What was found of the panels alone.
fn of_panels(fit: &Fit) -> Vec<&Finding> {
    fit.findings.iter().filter(|finding| !matches!(finding, Finding::RaisedArms { .. })).collect()
}

fn told(fit: &Fit) -> String {
    fit.findings.iter().map(|finding| format!("{finding}\n")).collect()
}

/// Quarter turns without rounding, columns by hand so that nothing is compared with itself.
fn turns() -> [DMat3; 5] {
    [
        DMat3::from_cols(-DVec3::Z, DVec3::Y, DVec3::X),
        DMat3::from_cols(DVec3::Z, DVec3::Y, -DVec3::X),
        DMat3::from_cols(-DVec3::X, DVec3::Y, -DVec3::Z),
        DMat3::from_cols(DVec3::X, DVec3::Z, -DVec3::Y),
        DMat3::from_cols(-DVec3::X, -DVec3::Y, DVec3::Z),
    ]
}

#[test]
fn what_is_fine_stays_to_the_bit() {
    let names = ["dress", "skirt", "trousers", "shirt_sleeves", "shirt_sleeveless"];
    let (garments, body) = (names.map(garment), woman("apose_to_walk").mesh);
    let fit = fit(Body::Mesh(body.clone()), &garments).expect("it fits");
    assert_eq!(fit.findings, []);
    assert_eq!(*mesh_of(&fit), body);
    for (cloth, garment) in fit.scene.cloths.iter().zip(&garments) {
        let Cloth::Garment(fitted) = cloth else { panic!("a garment") };
        assert_eq!(fitted, garment);
    }
}

#[test]
fn a_body_that_lies_or_faces_elsewhere_is_turned_back_exactly() {
    let (skirt, body) = (garment("skirt"), woman("apose_to_walk").mesh);
    let mut sentences = String::new();
    for turn in turns() {
        let fit = fit(Body::Mesh(body.turned(turn)), std::slice::from_ref(&skirt)).expect("it can be turned");
        // Zero has two signs.
        assert!(mesh_of(&fit).positions.iter().zip(&body.positions).all(|(a, b)| a == b), "{turn}");
        sentences += &told(&fit);
    }
    insta::assert_snapshot!(sentences, @r"
    turned the body by -90 degrees about y: it faced +x
    turned the body by 90 degrees about y: it faced -x
    turned the body by 180 degrees about y: it faced -z
    turned the body by -90 degrees about x: +z was up
    turned the body by 180 degrees about z: -y was up
    ");
}

#[test]
fn a_body_that_the_host_skins_is_not_turned_behind_its_back() {
    let (skirt, body) = (garment("skirt"), woman("apose_to_walk").mesh);
    let hosted = |mesh: Mesh| fit(Body::Moving(MovingMesh::hosted(mesh)), std::slice::from_ref(&skirt));
    assert_eq!(hosted(body.clone()).expect("it stands and faces +z").findings, []);
    for turn in turns() {
        assert_eq!(hosted(body.turned(turn)).expect_err("it would have to be turned"), FitError::Hosted, "{turn}");
    }
}

#[test]
fn the_caller_overrules_what_is_seen() {
    let (skirt, body) = (garment("skirt"), woman("apose_to_walk").mesh);
    let turned = scene(Body::Mesh(body.turned(turns()[0])), std::slice::from_ref(&skirt));
    let mut options = FitOptions::default();
    options.up = Some(Axis::Y);
    options.facing = Some(Axis::Z);
    let fit = Fit::new(&turned, &options).expect("it is left");
    assert!(!fit.findings.iter().any(|finding| matches!(finding, Finding::TurnedAbout { .. })), "{}", told(&fit));
    let mut options = FitOptions::default();
    options.facing = Some(Axis::X.opposite());
    let fit = Fit::new(&turned, &options).expect("it is turned the other way");
    assert!(told(&fit).contains("turned the body by 90 degrees about y: it faced -x"), "{}", told(&fit));
}

#[test]
fn a_body_that_moves_turns_with_its_motion() {
    let (woman, turn) = (woman("walk_loop"), turns()[0]);
    let turned = woman.turned(turn);
    for time in [0.0, 0.4] {
        let (is, wanted) = (turned.at(time), woman.at(time).turned(turn));
        let apart = |pair: (&Vec3, &Vec3)| pair.0.distance(*pair.1);
        assert!(is.positions.iter().zip(&wanted.positions).map(apart).fold(0.0, f32::max) < 1e-6);
        assert!(is.normals.iter().zip(&wanted.normals).map(apart).fold(0.0, f32::max) < 1e-5);
        let held = woman.held(time).expect("it has joints");
        assert_eq!(held.mesh, woman.at(time));
        assert_eq!(held.at(1.0), held.mesh, "it stands still");
    }
}

#[test]
fn of_a_ball_nothing_is_said() {
    let mut skirt = garment("skirt");
    skirt.panels.iter_mut().for_each(|panel| panel.placement.translation.y += 3.0);
    for body in [Mesh::sphere(Vec3::Y, 0.2, 24), Mesh::cuboid(Vec3::new(-0.1, 0.0, -0.1), Vec3::new(0.1, 1.7, 0.1))] {
        let fit = fit(Body::Mesh(body.clone()), std::slice::from_ref(&skirt)).expect("no claim");
        assert_eq!(*mesh_of(&fit), body);
        assert!(fit.findings.iter().all(|finding| matches!(finding, Finding::Far { .. })), "{}", told(&fit));
    }
}

#[test]
fn panels_in_a_leg_are_moved_before_it() {
    let body = Body::Mesh(woman("walk_loop").mesh);
    let fit = fit(body.clone(), &[garment("skirt")]).expect("it can be moved");
    // Its hands swing beside the hips, where the side seams close.
    let [Finding::RaisedArms { .. }, Finding::MovedPanel { panel, distance, place, .. }] = fit.findings.as_slice()
    else {
        panic!("{}", told(&fit))
    };
    assert_eq!((panel.as_str(), place.part), ("skirt_front", "left leg"));
    assert!((0.1..0.3).contains(distance) && place.depth > 0.05 && place.area > 0.01, "{}", told(&fit));
    // What has been mended is fine.
    assert_eq!(of_panels(&Fit::new(&fit.scene, &FitOptions::default()).expect("it fits")), [] as [&Finding; 0]);
}

#[test]
fn a_body_that_moves_is_dressed_in_the_pose_that_stands_clear() {
    let fit = fit(Body::Moving(woman("walk_loop")), &[garment("skirt")]).expect("it has a pose");
    assert_eq!(fit.findings, [Finding::Pose { time: None }]);
    assert_eq!(*garment_of(&fit), garment("skirt"));
    assert_eq!(fit.dress_in.map(|pose| pose.mesh), woman("walk_loop").at_rest().map(|pose| pose.mesh));
}

#[test]
fn sleeves_follow_the_arms() {
    let body = woman("apose_to_walk").mesh;
    let mut shirt = garment("shirt_sleeves");
    let placed = shirt.clone();
    for panel in &mut shirt.panels {
        let Some(side) =
            [("left_sleeve", 1.0), ("right_sleeve", -1.0)].iter().find(|(name, _)| panel.name.starts_with(name))
        else {
            continue;
        };
        // Placed for arms that are held level.
        let turn = DQuat::from_rotation_z(side.1 * 0.5 * FRAC_PI_2);
        panel.placement.rotation = turn * panel.placement.rotation;
    }
    let fit = fit(Body::Mesh(body), &[shirt]).expect("they can be turned");
    let turned = fit.findings.iter().filter(|finding| matches!(finding, Finding::TurnedSleeve { .. })).count();
    assert_eq!(turned, 2, "{}", told(&fit));
    for (panel, wanted) in garment_of(&fit).panels.iter().zip(&placed.panels) {
        let apart = panel.placement.rotation.angle_between(wanted.placement.rotation).to_degrees();
        assert!(apart < 5.0, "{}: {apart}°", panel.name);
    }
}

#[test]
fn a_garment_for_another_body_is_moved_to_this_one() {
    let mut body = woman("apose_to_walk").mesh;
    // A man of 1.83 m who stands elsewhere.
    body.positions.iter_mut().for_each(|p| *p = *p * Vec3::new(1.1, 1.15, 1.1) + Vec3::new(2.0, -0.9, 0.0));
    for (name, landmark, wanted) in [("skirt", "waist", 1.0), ("shirt_sleeveless", "neck", 1.33)] {
        let fit = fit(Body::Mesh(body.clone()), &[garment(name)]).expect("it can be moved");
        let [Finding::MovedGarment { way: [x, y, z], landmark: told, .. }, ..] = fit.findings.as_slice() else {
            panic!("{}", told(&fit))
        };
        assert_eq!(*told, landmark);
        let rise = 0.15 * wanted - 0.9;
        assert!((x - 2.0).abs() < 0.03 && (y - rise).abs() < 0.05 && z.abs() < 0.05, "{x} {y} {z}, not {rise}");
    }
}

#[test]
fn what_cannot_be_mended_is_one_sentence() {
    let body = woman("apose_to_walk").mesh;
    let mut skirt = garment("skirt");
    for panel in &mut skirt.panels {
        panel.placement.translation.y += 3.0;
        panel.edges.iter_mut().for_each(|edge| edge.label = None);
    }
    let error = fit(Body::Mesh(body.clone()), &[skirt]).expect_err("it hangs in the air");
    assert!(matches!(&error, FitError::Height { garment, .. } if garment == "skirt"), "{error}");
    // Out of a giant no way is near.
    let mut skirt = garment("skirt");
    skirt.panels[0].placement.rotation = DQuat::from_rotation_y(FRAC_PI_2);
    skirt.panels[0].placement.translation.z = 0.0;
    let mut giant = body;
    giant.positions.iter_mut().for_each(|p| *p *= 4.0);
    let told = fit(Body::Mesh(giant), &[skirt]).map(|fit| told(&fit));
    assert!(told.as_ref().is_err_and(|error| matches!(error, FitError::InBody { .. })), "{told:?}");
}

#[test]
fn a_panel_in_no_seam_is_named() {
    let mut skirt = garment("skirt");
    let mut pocket = skirt.panels[0].clone();
    pocket.name = "pocket".to_owned();
    pocket.placement.translation.z += 0.1;
    skirt.panels.push(pocket);
    let fit = fit(Body::Mesh(woman("apose_to_walk").mesh), &[skirt]).expect("the rest fits");
    assert_eq!(told(&fit), "panel pocket of garment skirt is in no seam: nothing will hold it\n");
    assert!(fit.findings[0].is_warning());
}

/// The garment with panels drawn the other way around, in the same place.
fn drawn_outside_in(garment: &Garment, panels: &[usize]) -> Garment {
    let mut turned = garment.clone();
    for number in panels {
        let panel = &garment.panels[*number];
        let count = panel.edges.len();
        let edges = (0..count).rev().map(|edge| {
            let curve = match panel.edges[edge].curve {
                Curve::Cubic { controls: [a, b] } => Curve::Cubic { controls: [b, a] },
                Curve::Arc { radius, large, right } => Curve::Arc { radius, large, right: !right },
                curve => curve,
            };
            let mut turned = Edge::new(panel.edges[(edge + 1) % count].start, curve);
            turned.label.clone_from(&panel.edges[edge].label);
            turned
        });
        turned.panels[*number].edges = edges.collect();
        for side in turned.seams.iter_mut().flat_map(|seam| &mut seam.sides).filter(|side| side.panel == *number) {
            side.edge = count - 1 - side.edge;
        }
    }
    turned
}

#[test]
fn panels_that_are_drawn_outside_in_are_turned_over_and_named() {
    let body = woman("apose_to_walk").mesh;
    for (name, panels) in [
        ("skirt", [0].as_slice()),
        ("skirt", &[1, 2]),
        ("circle_skirt", &[1]),
        ("circle_skirt", &[0, 1]),
        ("trousers", &[3]),
        ("shirt_sleeves", &[4]),
        ("shirt_sleeves", &[0, 5, 6]),
        ("dress", &[0, 1, 2, 3, 4, 5, 6, 7]),
    ] {
        let drawn = garment(name);
        let turned = drawn_outside_in(&drawn, panels);
        assert_ne!(turned, drawn);
        let fit = fit(Body::Mesh(body.clone()), &[turned]).expect("it fits");
        let mut told: Vec<String> = of_panels(&fit).iter().map(|finding| finding.to_string()).collect();
        told.sort();
        let sentence = |panel: &usize| {
            let panel = &drawn.panels[*panel].name;
            format!("panel {panel} of garment {name} is drawn with its outside in: it was turned over")
        };
        let mut expected: Vec<String> = panels.iter().map(sentence).collect();
        expected.sort();
        assert_eq!(told, expected, "{name}");
        assert!(of_panels(&fit).into_iter().all(Finding::is_warning));
        assert_eq!(*garment_of(&fit), drawn, "{name}");
    }
}

#[test]
fn a_seam_of_outside_to_inside_is_no_fault_of_a_panel() {
    let body = woman("apose_to_walk").mesh;
    let mut skirt = drawn_outside_in(&garment("circle_skirt"), &[1]);
    skirt.seams.iter_mut().for_each(|seam| seam.right_wrong = true);
    let fit = fit(Body::Mesh(body), std::slice::from_ref(&skirt)).expect("it fits");
    assert_eq!(of_panels(&fit), [] as [&Finding; 0]);
    assert_eq!(*garment_of(&fit), skirt);
}

#[test]
fn a_ribbon_with_half_a_turn_is_left_as_it_is_drawn() {
    let body = woman("apose_to_walk").mesh;
    let mut skirt = garment("circle_skirt");
    // One of two seams joins the outside to the inside, so the cloth has one side alone.
    skirt.seams[0].right_wrong = true;
    let fit = fit(Body::Mesh(body), std::slice::from_ref(&skirt)).expect("it fits");
    assert_eq!(of_panels(&fit), [] as [&Finding; 0]);
    assert_eq!(*garment_of(&fit), skirt);
}

#[test]
#[ignore = "its patterns and bodies are not part of the repository"]
fn patterns_of_others_are_drawn_right_and_one_is_not() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let body = woman("apose_to_walk").mesh;
    let mut told = String::new();
    let patterns = std::fs::read_dir(shared.join("data/patterns/garmentcode")).expect("the patterns");
    for path in patterns
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
    {
        let fit = fit(Body::Mesh(body.clone()), &[read_garment(&path).expect("a pattern").garment]).expect("it fits");
        told.extend(
            fit.findings.iter().map(|finding| format!("{finding}\n")).filter(|told| told.contains("turned over")),
        );
    }
    assert_eq!(told, "");
    let skirt = read_garment(&shared.join("cases/absolute_curv/g.json")).expect("a pattern").garment;
    for case in ["zup_ply", "facing_x"] {
        let scan = shared.join(format!("cases/{case}/scan.ply"));
        let body = toile_files::read_body(&scan, &BodyOptions::default()).expect("a body").mesh;
        told += &self::told(&fit(Body::Mesh(body), std::slice::from_ref(&skirt)).expect("it fits"));
    }
    let wrong = read_garment(&shared.join("cases/wrong_winding/g.json")).expect("a pattern").garment;
    let scan = toile_files::read_body(&shared.join("cases/scan.ply"), &BodyOptions::default()).expect("a body").mesh;
    told += &self::told(&fit(Body::Mesh(scan), &[wrong]).expect("it fits"));
    insta::assert_snapshot!(told, @"
    turned the body by -90 degrees about x: +z was up
    turned the body by -90 degrees about y: it faced +x
    panel back of garment g is drawn with its outside in: it was turned over
    ");
}

/// The arms of a body that garments are dressed on, as the lateral reach and the height of its outermost place [m].
fn hand(mesh: &Mesh) -> Vec3 {
    *mesh.positions.iter().max_by(|a, b| a.x.total_cmp(&b.x)).expect("a body has vertices")
}

#[test]
fn arms_that_seams_would_close_around_are_raised_and_lowered_again() {
    let body = woman("apose_to_walk");
    let bodies = [Body::Mesh(body.mesh.clone()), Body::Moving(body.clone())];
    for body in bodies {
        let fit = fit(body, &[garment("circle_skirt")]).expect("it can be dressed");
        assert!(matches!(fit.findings.as_slice(), [Finding::RaisedArms { .. }]), "{}", told(&fit));
        let dress_in = fit.dress_in.as_ref().expect("another pose");
        let (raised, standing) = (hand(&dress_in.mesh), hand(mesh_of(&fit)));
        assert!(raised.y > standing.y + 0.3 && raised.x > standing.x + 0.1, "{standing} {raised}");
        // Legs and trunk stay where they are.
        let below = dress_in.mesh.positions.iter().zip(&mesh_of(&fit).positions).filter(|(_, place)| place.y < 0.7);
        assert!(below.clone().count() > 1000 && below.clone().all(|(a, b)| a.distance(*b) < 1e-5));
    }
}

#[test]
fn a_mesh_at_rest_ends_as_it_stands() {
    let body = woman("apose_to_walk").mesh;
    let fit = fit(Body::Mesh(body.clone()), &[garment("circle_skirt")]).expect("it can be dressed");
    let way = fit.dress_in.expect("a way");
    let end = way.at(way.duration());
    let farthest = end.positions.iter().zip(&body.positions).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    assert!(farthest < 1e-5 && end.triangles == body.triangles, "{farthest}");
    // The skin between trunk and arm is bent, not torn: no edge is drawn out by more than 5 cm.
    let edges = body.triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let length = |mesh: &Mesh, edge: [u32; 2]| {
        let [a, b] = edge.map(|vertex| mesh.positions[vertex as usize]);
        a.distance(b)
    };
    let drawn = edges.map(|edge| length(&way.mesh, edge) - length(&body, edge)).fold(0.0, f32::max);
    assert!(drawn < 0.05, "{drawn}");
}

#[test]
fn arms_stay_where_no_seam_closes_around_them() {
    for name in ["skirt", "trousers", "dress", "shirt_sleeves", "shirt_sleeveless"] {
        let fit = fit(Body::Mesh(woman("apose_to_walk").mesh), &[garment(name)]).expect("it fits");
        assert!(fit.dress_in.is_none(), "{name}: {}", told(&fit));
    }
}
