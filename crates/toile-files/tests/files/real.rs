//! Whole patterns and bodies: those that are shipped, and real ones on machines that have them beside the repository.

use crate::support::{fixture, real_data};
use std::fs;
use std::path::Path;
use toile_files::{BodyOptions, read_body, read_garment};
use toile_scene::Curve;

/// What the patterns of a folder hold, a line each.
fn patterns(folder: &Path) -> String {
    let mut lines = Vec::new();
    for entry in fs::read_dir(folder).expect("the patterns") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|extension| extension != "json") {
            continue;
        }
        let garment = read_garment(&path).expect("a readable pattern").garment;
        let edges: usize = garment.panels.iter().map(|panel| panel.edges.len()).sum();
        let edge = || garment.panels.iter().flat_map(|panel| &panel.edges);
        let curved = edge().filter(|edge| edge.curve != Curve::Straight).count();
        let labelled = edge().filter(|edge| edge.label.is_some()).count();
        lines.push(format!(
            "{}: {} panels, {edges} edges, {curved} curved, {labelled} labelled, {} seams",
            garment.name,
            garment.panels.len(),
            garment.seams.len()
        ));
    }
    lines.sort();
    lines.join("\n")
}

#[test]
fn the_shipped_patterns_parse() {
    insta::assert_snapshot!(patterns(&fixture("garments")), @r#"
    circle_skirt: 2 panels, 12 edges, 8 curved, 4 labelled, 2 seams
    dress: 8 panels, 64 edges, 20 curved, 16 labelled, 26 seams
    shirt_sleeveless: 4 panels, 28 edges, 20 curved, 8 labelled, 8 seams
    shirt_sleeves: 8 panels, 44 edges, 24 curved, 8 labelled, 16 seams
    skirt: 4 panels, 44 edges, 8 curved, 4 labelled, 18 seams
    trousers: 6 panels, 64 edges, 16 curved, 4 labelled, 28 seams
    "#);
}

#[test]
#[ignore = "its ten patterns are not part of the repository"]
fn the_ten_patterns_parse() {
    insta::assert_snapshot!(patterns(&real_data().join("patterns/garmentcode")), @r#"
    dress_sleeveless: 6 panels, 66 edges, 26 curved, 18 labelled, 28 seams
    dress_sleeves: 10 panels, 82 edges, 30 curved, 18 labelled, 36 seams
    shirt_long_sleeves: 8 panels, 44 edges, 16 curved, 6 labelled, 16 seams
    shirt_sleeveless: 4 panels, 24 edges, 8 curved, 8 labelled, 6 seams
    shirt_sleeves: 8 panels, 44 edges, 16 curved, 6 labelled, 16 seams
    shorts: 6 panels, 62 edges, 12 curved, 2 labelled, 28 seams
    skirt_2panel: 4 panels, 16 edges, 0 curved, 2 labelled, 6 seams
    skirt_circle: 4 panels, 16 edges, 4 curved, 2 labelled, 6 seams
    skirt_pencil: 4 panels, 44 edges, 14 curved, 2 labelled, 20 seams
    trousers: 6 panels, 62 edges, 12 curved, 2 labelled, 28 seams
    "#);
}

#[test]
fn stitched_ends_lie_near_each_other() {
    let garment = read_garment(&fixture("garments/skirt.json")).expect("a readable pattern").garment;
    for seam in &garment.seams {
        let [a, b] = seam.sides.map(|side| {
            let panel = &garment.panels[side.panel];
            let middle = panel.polyline(side.edge, 1e-3).iter().sum::<glam::DVec2>() / 2.0;
            panel.placement.world(middle)
        });
        // Front and back hang up to half a metre apart, and left never meets right.
        assert!(a.distance(b) < 0.6 && (a.x - b.x).abs() < 0.2, "{a} {b}");
    }
}

#[test]
fn the_shipped_body_has_its_documented_height_and_no_fault() {
    let body = read_body(&fixture("bodies/walking_woman.glb"), &BodyOptions::default()).expect("a readable body");
    assert_eq!((body.mesh.positions.len(), body.mesh.triangles.len()), (13_380, 26_756));
    assert_eq!(body.warnings, [] as [&str; 0]);
    let [low, high] = body.mesh.bounds().expect("vertices");
    assert!((high.y - low.y - 1.593).abs() < 2e-3, "{}", high.y - low.y);
}

#[test]
#[ignore = "its three bodies are not part of the repository"]
fn the_three_bodies_have_their_documented_counts() {
    let data = real_data();
    for (name, vertices, triangles) in [
        ("bodies/mh_female_apose45.obj", 13_380, 26_756),
        ("bodies/mh_female_apose45_loop1.ply", 53_514, 107_024),
        ("walks/mh_female_walk.glb", 13_380, 26_756),
    ] {
        let body = read_body(&data.join(name), &BodyOptions::default()).expect("a readable body");
        assert_eq!((body.mesh.positions.len(), body.mesh.triangles.len()), (vertices, triangles));
        assert_eq!(body.warnings, [] as [&str; 0], "{name}");
        let [low, high] = body.mesh.bounds().expect("vertices");
        assert!((high.y - low.y - 1.593).abs() < 2e-3, "{name}: {}", high.y - low.y);
    }
}

#[test]
#[ignore = "the standing body is not part of the repository"]
fn the_dressing_pose_of_the_walk_is_the_standing_body() {
    let standing = read_body(&real_data().join("bodies/mh_female_apose45.obj"), &BodyOptions::default());
    let standing = standing.expect("a readable body").mesh;
    let mut options = BodyOptions::default();
    options.clip = Some("apose_to_walk".into());
    let walker = read_body(&fixture("bodies/walking_woman.glb"), &options).expect("the fixture").mesh;
    let worst = standing
        .positions
        .iter()
        .map(|p| walker.positions.iter().map(|q| p.distance(*q)).fold(f32::INFINITY, f32::min))
        .fold(0.0, f32::max);
    assert!(worst < 1e-4, "{worst}");
}

#[test]
#[ignore = "its files, each with a condition of other programs, are not part of the repository"]
fn files_that_others_wrote_are_read_or_refused_by_their_cause() {
    let cases = real_data().join("../cases");
    let garment = |name: &str| match read_garment(&cases.join(name).join("g.json")) {
        Ok(file) => {
            let edges: usize = file.garment.panels.iter().map(|panel| panel.edges.len()).sum();
            let (panels, seams) = (file.garment.panels.len(), file.garment.seams.len());
            format!("{name}: {panels} panels, {edges} edges, {seams} seams {:?}", file.warnings)
        }
        Err(error) => error.to_string().split_once("cases/").expect("its path").1.to_owned(),
    };
    let body = |name: &str| match read_body(&cases.join(name), &BodyOptions::default()) {
        Ok(body) => {
            let (triangles, volume) = (body.mesh.triangles.len(), body.mesh.signed_volume());
            format!("{name}: {triangles} triangles, {:.1} l {:?}", 1e3 * volume, body.warnings)
        }
        Err(error) => error.to_string().split_once("cases/").expect("its path").1.to_owned(),
    };
    let garments = ["absolute_metres", "absolute_curv", "no_units", "bom_json", "diamond_keyhole", "wrong_winding"];
    let bodies = [
        "scan.ply",
        "floor_scan/b.obj",
        "neg_scale_glb/b.glb",
        "quantized_glb/b.glb",
        "unlit_glb/b.glb",
        "draco_glb/b.glb",
        "obj_bom_spare/b.obj",
        "obj_backslash/b.obj",
        "zup_ply/scan.ply",
        "facing_x/scan.ply",
    ];
    let told: Vec<String> =
        garments.iter().map(|name| garment(name)).chain(bodies.iter().map(|name| body(name))).collect();
    insta::assert_snapshot!(told.join("\n"), @r#"
    absolute_metres: 4 panels, 44 edges, 20 seams []
    absolute_curv: 4 panels, 44 edges, 20 seams []
    no_units: 2 panels, 8 edges, 2 seams ["it has no key \"properties.units_in_meter\": read as centimetres"]
    bom_json: 4 panels, 44 edges, 18 seams []
    diamond_keyhole: 2 panels, 15 edges, 5 seams []
    wrong_winding: 2 panels, 8 edges, 2 seams []
    scan.ply: 4009 triangles, 46.5 l ["duplicated triangles removed: 3", "boundary edges (the body has holes): 6", "non-manifold edges (shared by more than two triangles): 3"]
    floor_scan/b.obj: 4009 triangles, 46.5 l ["duplicated triangles removed: 3", "floor or backdrop left out: 1 piece of 800 triangles, the largest 2.00 m by 2.00 m", "boundary edges (the body has holes): 6", "non-manifold edges (shared by more than two triangles): 3"]
    neg_scale_glb/b.glb: 5128 triangles, 46.7 l ["boundary edges (the body has holes): 140", "triangles that faced inward turned over: 2"]
    quantized_glb/b.glb: 4009 triangles, 46.5 l ["duplicated triangles removed: 3", "boundary edges (the body has holes): 6", "non-manifold edges (shared by more than two triangles): 3"]
    unlit_glb/b.glb: 4009 triangles, 46.5 l ["duplicated triangles removed: 3", "boundary edges (the body has holes): 6", "non-manifold edges (shared by more than two triangles): 3"]
    draco_glb/b.glb, key "meshes[0].primitives[0]": what KHR_draco_mesh_compression compressed cannot be decoded (General error: Invalid magic): export it without compression
    obj_bom_spare/b.obj: 4009 triangles, 46.5 l ["duplicated triangles removed: 3", "isolated vertices removed: 1", "boundary edges (the body has holes): 6", "non-manifold edges (shared by more than two triangles): 3"]
    obj_backslash/b.obj: 4009 triangles, 46.5 l ["duplicated triangles removed: 3", "boundary edges (the body has holes): 6", "non-manifold edges (shared by more than two triangles): 3"]
    zup_ply/scan.ply: 4009 triangles, 46.5 l ["duplicated triangles removed: 3", "boundary edges (the body has holes): 6", "non-manifold edges (shared by more than two triangles): 3"]
    facing_x/scan.ply: 4009 triangles, 46.5 l ["duplicated triangles removed: 3", "boundary edges (the body has holes): 6", "non-manifold edges (shared by more than two triangles): 3"]
    "#);
}
