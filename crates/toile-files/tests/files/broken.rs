//! Every broken fixture ends in one sentence with file, place and what to do.

use crate::support::fixture;
use std::fs;
use toile_files::{BodyOptions, read_body, read_garment};

fn message(name: &str) -> String {
    let path = fixture("broken").join(name);
    let error = if name.ends_with(".json") {
        read_garment(&path).map(|_| ()).map_err(|error| error.to_string())
    } else {
        read_body(&path, &BodyOptions::default()).map(|_| ()).map_err(|error| error.to_string())
    };
    let error = error.expect_err(name);
    let prefix = fixture("broken").display().to_string() + "/";
    error.strip_prefix(&prefix).expect("the sentence starts with the path").to_string()
}

#[test]
fn every_broken_file_has_its_sentence() {
    let mut names: Vec<String> = fs::read_dir(fixture("broken"))
        .expect("the folder of broken files")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name"))
        .collect();
    names.sort();
    let messages: Vec<String> = names.iter().map(|name| message(name)).collect();
    insta::assert_snapshot!(messages.join("\n"), @r#"
    empty_mesh.obj: the body is empty: it has 74 vertices and no triangle; export the mesh with its faces
    missing_edge.json, stitch 0: panel "back" has no edge 4: its edges are 0 to 3
    missing_panel.json, stitch 1: there is no panel "bakc"; there is: front, back
    nan_coordinate.json, panel "back": vertex 2 at (30, NaN) is not a finite number
    nan_coordinate.obj, line 32: the position (0.1, NaN, 0.2) is not a finite number
    self_crossing.json, panel "front": the outline crosses itself: edge 1 meets edge 3 near (0.1500, 0.2000) m; draw it as one loop, or split the panel there into two that are stitched
    ten_gigabytes.glb: buffer 0 needs 10000000000 bytes, but the file has only 1752 left: it is truncated or damaged
    ten_gigabytes.ply, byte 228: element vertex with 833333334 rows needs 10000000008 bytes, but the file has only 36 left: it is truncated or damaged
    truncated.glb, byte 0: the GLB file by its header needs 2320 bytes, but the file has only 1546 left: it is truncated or damaged
    wrong_units.obj: the body is 160 m tall, and bodies are 0.2 m to 4 m tall: give cm as its unit if it should be 1.60 m
    "#);
}

#[test]
fn broken_files_are_small() {
    for entry in fs::read_dir(fixture("broken")).expect("the folder of broken files") {
        let entry = entry.expect("an entry");
        assert!(entry.metadata().expect("its size").len() < 20_000, "{:?}", entry.path());
    }
}

#[test]
fn a_missing_file_and_a_folder_are_named() {
    let missing = read_garment(&fixture("broken/none.json")).expect_err("no such file").to_string();
    assert!(missing.ends_with("none.json: it cannot be read: No such file or directory (os error 2)"), "{missing}");
    let folder = read_body(&fixture("broken"), &BodyOptions::default()).expect_err("a folder");
    assert!(folder.to_string().ends_with("broken: it cannot be read: it is not a plain file"), "{folder}");
}

#[test]
fn the_flag_of_the_message_makes_the_body_readable() {
    let mut options = BodyOptions::default();
    options.metres_per_unit = 0.01;
    let body = read_body(&fixture("broken/wrong_units.obj"), &options).expect("a body in centimetres");
    let [low, high] = body.mesh.bounds().expect("vertices");
    assert!((high.y - low.y - 1.6).abs() < 1e-5);
    assert_eq!(body.warnings, [] as [&str; 0]);
}
