//! glTF bodies: nodes, clips, buffers and faults.

use crate::support::{ellipsoid, fixture};
use base64::Engine;
use serde_json::{Value, json};
use std::fs;
use toile_files::{BodyOptions, NamedMesh, parse_body, read_body, write_glb};

/// A glTF with one ellipsoid, a clip that moves and turns it, and its buffer as bytes.
pub fn animated(interpolation: &str) -> (Value, Vec<u8>) {
    let mesh = ellipsoid();
    let mut bytes: Vec<u8> = Vec::new();
    let mut views = Vec::new();
    let mut add = |data: Vec<u8>| {
        views.push(json!({ "buffer": 0, "byteOffset": bytes.len(), "byteLength": data.len() }));
        bytes.extend(data);
    };
    let floats = |values: &[f32]| values.iter().flat_map(|value| value.to_le_bytes()).collect();
    let positions: Vec<f32> = mesh.positions.iter().flat_map(|position| position.to_array()).collect();
    add(floats(&positions));
    add(mesh.triangles.iter().flatten().flat_map(|index| index.to_le_bytes()).collect());
    add(floats(&[1.0, 3.0]));
    // From (0, 0, 0) to (0.4, 0, 0); a cubic key is in-tangent, value, out-tangent.
    let (start, end) = ([0.0, 0.0, 0.0], [0.4, 0.0, 0.0]);
    let cubic = interpolation == "CUBICSPLINE";
    let moves = if cubic { [start, start, end, end, end, start].concat() } else { [start, end].concat() };
    add(floats(&moves));
    // From no turn to a quarter turn about y, given as −q to test the shorter way.
    let (none, quarter) = ([0.0, 0.0, 0.0, 1.0], [0.0, -0.5f32.sqrt(), 0.0, -0.5f32.sqrt()]);
    let flat = [0.0; 4];
    let turns = if cubic { [flat, none, flat, flat, none, flat].concat() } else { [none, quarter].concat() };
    add(floats(&turns));
    let count = if cubic { 6 } else { 2 };
    let root = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "children": [1], "scale": [0.5, 0.5, 0.5] }, { "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1 }] }],
        "animations": [{ "name": "move", "channels": [
            { "sampler": 0, "target": { "node": 1, "path": "translation" } },
            { "sampler": 1, "target": { "node": 1, "path": "rotation" } }],
            "samplers": [{ "input": 2, "output": 3, "interpolation": interpolation },
                         { "input": 2, "output": 4, "interpolation": interpolation }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": mesh.positions.len(), "type": "VEC3",
              "min": [-0.25, 0.0, -0.2], "max": [0.25, 1.6, 0.2] },
            { "bufferView": 1, "componentType": 5125, "count": 3 * mesh.triangles.len(), "type": "SCALAR" },
            { "bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [1.0], "max": [3.0] },
            { "bufferView": 3, "componentType": 5126, "count": count, "type": "VEC3" },
            { "bufferView": 4, "componentType": 5126, "count": count, "type": "VEC4" }],
        "bufferViews": views,
        "buffers": [{ "byteLength": bytes.len() }],
    });
    (root, bytes)
}

pub fn embedded(mut root: Value, bytes: &[u8]) -> Vec<u8> {
    let text = base64::engine::general_purpose::STANDARD.encode(bytes);
    root["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{text}").into();
    root.to_string().into_bytes()
}

/// Centre of the posed ellipsoid in x, and its extent in x, at a time of the clip.
fn pose(interpolation: &str, clip: Option<&str>, time: f64) -> [f32; 2] {
    let (root, bytes) = animated(interpolation);
    let options = BodyOptions { clip: clip.map(String::from), time, ..BodyOptions::default() };
    let body = parse_body(&embedded(root, &bytes), "a.gltf", &options).expect("a readable body");
    let [low, high] = body.mesh.bounds().expect("vertices");
    [0.5 * (low.x + high.x), high.x - low.x]
}

fn assert_near(got: [f32; 2], expected: [f32; 2]) {
    assert!((got[0] - expected[0]).abs() < 1e-6 && (got[1] - expected[1]).abs() < 1e-6, "{got:?} {expected:?}");
}

#[test]
fn clips_are_sampled_as_their_keys_say() {
    // The parent halves everything: 0.25 wide at rest, 0.2 after a quarter turn.
    assert_near(pose("LINEAR", None, 0.0), [0.0, 0.25]);
    assert_near(pose("LINEAR", Some("move"), 0.0), [0.0, 0.25]);
    assert_near(pose("LINEAR", Some("move"), 1.5), [0.05, pose("LINEAR", Some("move"), 1.5)[1]]);
    assert_near(pose("LINEAR", Some("move"), 9.0), [0.2, 0.2]);
    assert_near(pose("STEP", Some("move"), 2.9), [0.0, 0.25]);
    assert_near(pose("STEP", Some("move"), 3.0), [0.2, 0.2]);
    // Hermite with both tangents 0.4 per second over 2 s: 0.4·(3t² − 2t³) + 2·0.4·(2t³ − 3t² + t) halved, at t = 1/4.
    let t = 0.25f32;
    let value = 0.4 * (3.0 * t * t - 2.0 * t * t * t) + 0.8 * (2.0 * t * t * t - 3.0 * t * t + t);
    assert_near(pose("CUBICSPLINE", Some("move"), 1.5), [0.5 * value, 0.25]);
}

#[test]
fn a_turn_takes_the_shorter_way() {
    // At half the time an eighth of a turn: the ellipse 0.125 by 0.1 reaches sqrt((0.125² + 0.1²)/2).
    let [_, width] = pose("LINEAR", Some("move"), 2.0);
    let expected = 2.0 * ((0.125f32.powi(2) + 0.1f32.powi(2)) / 2.0).sqrt();
    assert!((width - expected).abs() < 0.01, "{width} {expected}");
}

#[test]
fn buffers_may_lie_beside_the_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let (mut root, bytes) = animated("LINEAR");
    root["buffers"][0]["uri"] = "the%20body.bin".into();
    fs::write(folder.path().join("the body.bin"), &bytes).expect("a file");
    let path = folder.path().join("body.gltf");
    fs::write(&path, root.to_string()).expect("a file");
    let body = read_body(&path, &BodyOptions::default()).expect("a readable body");
    assert_eq!(body.mesh.triangles.len(), ellipsoid().triangles.len());
    let error = parse_body(root.to_string().as_bytes(), "a.gltf", &BodyOptions::default());
    let error = error.expect_err("no folder").to_string();
    insta::assert_snapshot!(error, @r#"
    a.gltf: buffer 0 lies in the file "the%20body.bin", which bytes in memory cannot have
    "#);
}

#[test]
fn strips_fans_and_two_nodes_of_one_mesh_are_read() {
    let (mut root, bytes) = animated("LINEAR");
    root["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0, "translation": [1.0, 0.0, 0.0] }]);
    root["scenes"][0]["nodes"] = json!([0, 1]);
    root["animations"] = json!([]);
    let read = |root: Value| {
        parse_body(&embedded(root, &bytes), "a.gltf", &BodyOptions::default()).expect("a readable body").mesh
    };
    let single = ellipsoid().triangles.len();
    assert_eq!(read(root.clone()).triangles.len(), 2 * single);
    root["nodes"] = json!([{ "mesh": 0 }, {}]);
    root["meshes"][0]["primitives"][0]["mode"] = 5.into();
    assert!(read(root.clone()).triangles.len() > single);
    root["meshes"][0]["primitives"][0]["mode"] = 6.into();
    assert!(!read(root).triangles.is_empty());
}

#[test]
fn faults_name_accessor_node_or_key() {
    let (root, bytes) = animated("LINEAR");
    let change = |pointer: &str, value: Value| {
        let mut root = root.clone();
        *root.pointer_mut(pointer).expect(pointer) = value;
        root
    };
    let mut circle = change("/nodes/1", json!({ "mesh": 0, "children": [0] }));
    circle["scenes"][0]["nodes"] = json!([0]);
    let cases = [
        change("/accessors/0/count", 4_000_000_000u64.into()),
        change("/accessors/0/bufferView", 99.into()),
        change("/accessors/1/componentType", 5126.into()),
        change("/accessors/0/type", "VEC4".into()),
        change("/bufferViews/0/byteOffset", 9_000_000.into()),
        change("/bufferViews/0/byteLength", 12.into()),
        change("/bufferViews/1/byteOffset", 0.into()),
        change("/buffers/0/byteLength", 10_000_000_000u64.into()),
        change("/accessors/3/count", 1.into()),
        change("/nodes/0/scale", json!([1e38, 1e38, 1e38])),
        circle,
        change("/meshes/0/primitives/0/attributes/POSITION", 77.into()),
    ];
    let options = BodyOptions { clip: Some("move".into()), ..BodyOptions::default() };
    let message =
        |root: Value| parse_body(&embedded(root, &bytes), "a.gltf", &options).expect_err("a refusal").to_string();
    let messages: Vec<String> = cases.into_iter().map(message).collect();
    insta::assert_snapshot!(messages.join("\n"), @r#"
    a.gltf, accessor 0: an accessor of 4000000000 elements needs 48000000000 bytes, but the file has only 1320 left: it is truncated or damaged
    a.gltf, key "accessors[0].bufferView": the glTF is not valid: Index out of bounds
    a.gltf, accessor 1: indices must be unsigned integers
    a.gltf, accessor 0: it must be Vec3 and is Vec4
    a.gltf, accessor 0: an accessor of 110 elements needs 1320 bytes, but the file has only 0 left: it is truncated or damaged
    a.gltf, accessor 0: an accessor of 110 elements needs 1320 bytes, but the file has only 12 left: it is truncated or damaged
    a.gltf, accessor 1: vertex 1070386381 does not exist: there are 110
    a.gltf: buffer 0 needs 10000000000 bytes, but the file has only 3976 left: it is truncated or damaged
    a.gltf, accessor 3: 1 values do not fit 2 keys
    a.gltf: the body is 1.60e38 m tall, and bodies are 0.2 m to 4 m tall: no unit from mm to m makes it a body's size
    a.gltf, node 0: the node is its own ancestor
    a.gltf, key "meshes[0].primitives.attributes.POSITION": accessor 77 does not exist: there are 5
    "#);
}

#[test]
fn an_unknown_clip_lists_the_known_ones() {
    let options = BodyOptions { clip: Some("run".into()), ..BodyOptions::default() };
    let error = read_body(&fixture("bodies/walking_woman.glb"), &options).expect_err("no such clip");
    let error = error.to_string();
    let (_, sentence) = error.rsplit_once(": there").expect("the sentence");
    assert_eq!(sentence, " is no clip \"run\"; there is: walk_loop, walk_forward_4cycles, apose_to_walk");
}

#[test]
fn the_walking_woman_walks() {
    let at = |clip: Option<&str>, time| {
        let options = BodyOptions { clip: clip.map(String::from), time, ..BodyOptions::default() };
        let body = read_body(&fixture("bodies/walking_woman.glb"), &options).expect("the fixture");
        assert_eq!(body.warnings, [] as [&str; 0]);
        assert_eq!((body.mesh.positions.len(), body.mesh.triangles.len()), (13_380, 26_756));
        body.mesh
    };
    let farthest = |a: &toile_scene::Mesh, b: &toile_scene::Mesh| {
        a.positions.iter().zip(&b.positions).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
    };
    let rest = at(None, 0.0);
    let dressing = at(Some("apose_to_walk"), 0.0);
    assert!(farthest(&rest, &dressing) < 1e-4, "{}", farthest(&rest, &dressing));
    let walking = at(Some("walk_loop"), 0.0);
    assert!(farthest(&rest, &walking) > 0.1);
    // The loop of 1.1 s closes.
    assert!(farthest(&walking, &at(Some("walk_loop"), 1.1)) < 1e-4);
    assert!(farthest(&walking, &at(Some("walk_loop"), 0.55)) > 0.1);
}

#[test]
fn every_cut_of_a_glb_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("whole.glb");
    let mesh = ellipsoid();
    write_glb(&path, &[NamedMesh { name: "body", mesh: &mesh, colour: [1.0; 3] }]).expect("a file");
    let bytes = fs::read(&path).expect("the file");
    parse_body(&bytes, "whole.glb", &BodyOptions::default()).expect("the whole file");
    for length in (0..bytes.len()).step_by(7) {
        let cut = parse_body(&bytes[..length], "cut.glb", &BodyOptions::default());
        assert!(cut.is_err(), "{length} of {} bytes", bytes.len());
    }
}
