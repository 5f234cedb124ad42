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
    let mut options = BodyOptions::default();
    options.clip = clip.map(String::from);
    options.time = time;
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
    let mut options = BodyOptions::default();
    options.clip = Some("move".into());
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
    let mut options = BodyOptions::default();
    options.clip = Some("run".into());
    let error = read_body(&fixture("bodies/walking_woman.glb"), &options).expect_err("no such clip");
    let error = error.to_string();
    let (_, sentence) = error.rsplit_once(": there").expect("the sentence");
    assert_eq!(sentence, " is no clip \"run\"; there is: walk_loop, walk_forward_4cycles, apose_to_walk");
}

#[test]
fn the_walking_woman_walks() {
    let at = |clip: Option<&str>, time| {
        let mut options = BodyOptions::default();
        options.clip = clip.map(String::from);
        options.time = time;
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
    write_glb(&path, &[NamedMesh::new("body", &mesh, [1.0; 3])]).expect("a file");
    let bytes = fs::read(&path).expect("the file");
    parse_body(&bytes, "whole.glb", &BodyOptions::default()).expect("the whole file");
    for length in (0..bytes.len()).step_by(7) {
        let cut = parse_body(&bytes[..length], "cut.glb", &BodyOptions::default());
        assert!(cut.is_err(), "{length} of {} bytes", bytes.len());
    }
}

/// A GLB of a JSON, a buffer, and further chunks.
pub fn glb(root: &Value, bytes: &[u8], pad: u8, further: &[(&[u8; 4], &[u8])]) -> Vec<u8> {
    let mut text = root.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), pad);
    let mut bin = bytes.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut chunks: Vec<(&[u8; 4], &[u8])> = vec![(b"JSON", &text), (b"BIN\0", &bin)];
    chunks.extend(further);
    let body: Vec<u8> =
        chunks.iter().flat_map(|(kind, data)| [&(data.len() as u32).to_le_bytes(), *kind, *data].concat()).collect();
    [b"glTF".as_slice(), &2u32.to_le_bytes(), &(body.len() as u32 + 12).to_le_bytes(), &body].concat()
}

/// The mesh that stands for itself, without its clip.
fn still() -> (Value, Vec<u8>) {
    let (mut root, bytes) = animated("LINEAR");
    root["nodes"] = json!([{ "mesh": 0 }]);
    root.as_object_mut().expect("an object").remove("animations");
    (root, bytes)
}

fn read_still(root: &Value, bytes: &[u8]) -> toile_files::BodyFile {
    parse_body(&embedded(root.clone(), bytes), "a.gltf", &BodyOptions::default()).expect("a readable body")
}

#[test]
fn what_a_transform_mirrors_is_wound_the_other_way() {
    let (root, bytes) = still();
    let whole = read_still(&root, &bytes).mesh;
    let nodes = [
        json!([{ "mesh": 0, "scale": [-1.0, 1.0, 1.0] }]),
        json!([{ "mesh": 0, "scale": [1.0, 1.0, -2.0] }]),
        json!([{ "mesh": 0, "matrix": [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0] }]),
        json!([{ "children": [1], "scale": [1.0, -1.0, 1.0] }, { "mesh": 0, "rotation": [0.0, 0.6, 0.0, 0.8] }]),
        json!([{ "children": [1], "scale": [-1.0, 1.0, 1.0] }, { "mesh": 0, "scale": [-1.0, 1.0, 1.0] }]),
        json!([{ "mesh": 0, "scale": [-1.0, -1.0, -1.0] }]),
    ];
    for nodes in nodes {
        let mut root = root.clone();
        root["nodes"] = nodes.clone();
        let body = read_still(&root, &bytes);
        // Had they been wound as they stand, it would be told that they were turned.
        assert_eq!(body.warnings, [] as [&str; 0], "{nodes}");
        assert!(body.mesh.signed_volume() > 0.0 && body.mesh.triangles.len() == whole.triangles.len());
    }
}

#[test]
fn normals_of_what_is_mirrored_stay_outside_at_rest_and_in_motion() {
    let (mut root, mut bytes) = animated("LINEAR");
    let mesh = ellipsoid();
    let tilted = mesh.normals.iter().map(|normal| (*normal + glam::vec3(0.05, 0.1, 0.0)).normalize());
    let tilted: Vec<glam::Vec3> = tilted.collect();
    let offset = bytes.len();
    bytes.extend(tilted.iter().flat_map(|normal| normal.to_array()).flat_map(f32::to_le_bytes));
    let views = root["bufferViews"].as_array_mut().expect("views");
    views.push(json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() - offset }));
    root["buffers"][0]["byteLength"] = bytes.len().into();
    let accessors = root["accessors"].as_array_mut().expect("accessors");
    accessors.push(json!({ "bufferView": 5, "componentType": 5126, "count": tilted.len(), "type": "VEC3" }));
    root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 5.into();
    for scale in [[1.0, 1.0, 1.0], [-1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, -1.0, -1.0]] {
        root["nodes"][0]["scale"] = json!(scale);
        let mirror = glam::Vec3::from(scale);
        let text = embedded(root.clone(), &bytes);
        let body = parse_body(&text, "a.gltf", &BodyOptions::default()).expect("a readable body");
        assert_eq!(body.warnings, [] as [&str; 0], "{scale:?}");
        for (normal, tilted) in body.mesh.normals.iter().zip(&tilted) {
            assert!(normal.distance(*tilted * mirror) < 1e-6, "{scale:?} {normal} {tilted}");
        }
        let moving = toile_files::parse_moving_body(&text, "a.gltf", &BodyOptions::default()).expect("a clip").body;
        for time in [0.0, 2.0] {
            let mut options = BodyOptions::default();
            options.clip = Some("move".into());
            options.time = time;
            let rest = parse_body(&text, "a.gltf", &options).expect("a readable body").mesh;
            for (a, b) in moving.at(time).normals.iter().zip(&rest.normals) {
                assert!(a.distance(*b) < 1e-5, "{scale:?} {time} {a} {b}");
            }
        }
    }
}

#[test]
fn half_a_body_may_be_the_mirror_of_the_other_half() {
    let (mut root, bytes) = still();
    // Two bodies side by side, one of them mirrored in its own joint.
    root["nodes"] = json!([
        { "mesh": 0, "translation": [0.5, 0.0, 0.0] },
        { "mesh": 0, "translation": [-0.5, 0.0, 0.0], "scale": [-1.0, 1.0, 1.0] }]);
    root["scenes"][0]["nodes"] = json!([0, 1]);
    let body = read_still(&root, &bytes);
    assert_eq!(body.warnings, [] as [&str; 0]);
    assert!((body.mesh.signed_volume() - 2.0 * ellipsoid().signed_volume()).abs() < 1e-6);
}

#[test]
fn extensions_that_do_not_touch_the_shape_are_passed_over() {
    let (root, bytes) = still();
    let whole = read_still(&root, &bytes).mesh;
    for name in ["KHR_materials_unlit", "KHR_texture_basisu", "KHR_xmp_json_ld", "EXT_texture_webp", "VRMC_vrm"] {
        let mut root = root.clone();
        root["extensionsUsed"] = json!([name]);
        root["extensionsRequired"] = json!([name]);
        root["extensions"] = json!({ name: { "lights": [{}] } });
        root["materials"] =
            json!([{ "extensions": { name: {} }, "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } }]);
        // Of a texture that is compressed no image is given in the way of the format itself.
        root["textures"] = json!([{ "extensions": { name: { "source": 0 } } }]);
        root["images"] = json!([{ "uri": "a.ktx2" }]);
        root["meshes"][0]["primitives"][0]["material"] = 0.into();
        root["meshes"][0]["primitives"][0]["extensions"] = json!({ name: { "mappings": [] } });
        let body = read_still(&root, &bytes);
        assert_eq!((body.mesh, body.warnings), (whole.clone(), Vec::new()), "{name}");
    }
}

#[test]
fn extensions_that_touch_the_shape_are_refused_by_name_with_what_to_do() {
    let (root, bytes) = still();
    let refusal = |change: &dyn Fn(&mut Value)| {
        let mut root = root.clone();
        change(&mut root);
        parse_body(&embedded(root, &bytes), "a.gltf", &BodyOptions::default()).expect_err("a refusal").to_string()
    };
    let required = |name: &'static str| move |root: &mut Value| root["extensionsRequired"] = json!([name]);
    let messages = [
        refusal(&required("KHR_gaussian_splatting")),
        refusal(&required("KHR_accessor_float64")),
        refusal(&required("ACME_shape")),
        // Numbers that no codec wrote.
        refusal(&|root| {
            root["meshes"][0]["primitives"][0]["extensions"] =
                json!({ "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0 } } });
            root["accessors"][0].as_object_mut().expect("an object").remove("bufferView");
        }),
        refusal(&|root| {
            root["bufferViews"][0]["extensions"] = json!({ "EXT_meshopt_compression": { "buffer": 0, "byteLength": 1320,
                "byteStride": 12, "count": 110, "mode": "ATTRIBUTES" } });
        }),
        refusal(&|root| {
            root["bufferViews"][0]["extensions"] =
                json!({ "EXT_meshopt_compression": { "buffer": 7, "byteLength": 1320 } });
        }),
        refusal(&|root| root["nodes"][0]["extensions"] = json!({ "EXT_mesh_gpu_instancing": { "attributes": {} } })),
        refusal(&|root| root["asset"]["version"] = "1.0".into()),
        refusal(&|root| {
            root["buffers"]
                .as_array_mut()
                .expect("buffers")
                .push(json!({ "byteLength": 1, "uri": "https://a.b/c.bin" }))
        }),
    ];
    insta::assert_snapshot!(messages.join("\n"), @r#"
    a.gltf: the file needs the extension KHR_gaussian_splatting, which is not read: make a mesh of the splats
    a.gltf: the file needs the extension KHR_accessor_float64, which is not read: export numbers as 32-bit floats
    a.gltf: the file needs the extension ACME_shape, which is not read: export it without it
    a.gltf, key "meshes[0].primitives[0]": what KHR_draco_mesh_compression compressed cannot be decoded (General error: Invalid magic): export it without compression
    a.gltf, key "bufferViews[0]": what EXT_meshopt_compression compressed cannot be decoded (invalid encoded stream): export it without compression
    a.gltf, key "bufferViews[0]": what EXT_meshopt_compression compressed cannot be decoded (its bytes are not in the file): export it without compression
    a.gltf: nodes[0] needs the extension EXT_mesh_gpu_instancing, which is not read: make the instances real before the export
    a.gltf, key "asset.version": it is glTF 1.0: export it as glTF 2.0
    a.gltf: buffer 1 lies on the web at "https://a.b/c.bin": download it beside the file, or export a GLB
    "#);
}

#[test]
fn a_file_that_has_its_numbers_beside_the_compressed_ones_is_read() {
    let (mut root, bytes) = still();
    let whole = read_still(&root, &bytes).mesh;
    root["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    root["meshes"][0]["primitives"][0]["extensions"] = json!({ "KHR_draco_mesh_compression": { "bufferView": 0 } });
    let body = read_still(&root, &bytes);
    assert_eq!((body.mesh, body.warnings), (whole, Vec::new()));
}

#[test]
fn quantized_positions_of_every_type_are_read() {
    let whole = ellipsoid();
    // Of each axis the part of its whole range [0, 1] or [−1, 1], in numbers of up to so many.
    for (component, most, is_signed, normalized) in [
        (5121, 255.0, false, true),
        (5120, 127.0, true, true),
        (5123, 65_535.0, false, true),
        (5122, 32_767.0, true, true),
        (5123, 65_535.0, false, false),
        (5122, 32_767.0, true, false),
    ] {
        let (mut root, mut bytes) = still();
        let wide = if matches!(component, 5122 | 5123) { 2 } else { 1 };
        let offset = bytes.len();
        for position in &whole.positions {
            let part = (*position - glam::vec3(0.0, 0.8, 0.0)) / glam::vec3(0.25, 0.8, 0.2);
            for value in part.to_array() {
                let value = if is_signed { value * most } else { 0.5 * (value + 1.0) * most };
                bytes.extend(&(value.round() as i32).to_le_bytes()[..wide]);
            }
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        }
        root["bufferViews"][0] =
            json!({ "buffer": 0, "byteOffset": offset, "byteLength": bytes.len() - offset, "byteStride": 4 * wide });
        root["buffers"][0]["byteLength"] = bytes.len().into();
        root["accessors"][0] = json!({ "bufferView": 0, "componentType": component, "normalized": normalized,
            "count": whole.positions.len(), "type": "VEC3" });
        let unit = if normalized { 1.0 } else { most };
        let (low, size) =
            if is_signed { ([0.0, 0.8, 0.0], [0.25, 0.8, 0.2]) } else { ([-0.25, 0.0, -0.2], [0.5, 1.6, 0.4]) };
        root["nodes"][0]["translation"] = json!(low);
        root["nodes"][0]["scale"] = json!(size.map(|side: f32| side / unit));
        root["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
        root["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        let body = read_still(&root, &bytes);
        assert_eq!(body.warnings, [] as [&str; 0], "{component}");
        assert_eq!(body.mesh.positions.len(), whole.positions.len());
        let step = 1.7 / most;
        for (a, b) in body.mesh.positions.iter().zip(&whole.positions) {
            assert!(a.distance(*b) < step, "{component} {a} {b}");
        }
    }
}

#[test]
fn files_that_validators_let_pass_and_exporters_write_are_read() {
    let (root, bytes) = still();
    let whole = read_still(&root, &bytes).mesh;
    let read = |file: &[u8], name: &str| {
        let body = parse_body(file, name, &BodyOptions::default()).expect("a readable body");
        assert_eq!(body.mesh, whole);
        body.warnings
    };
    for pad in [b' ', 0] {
        assert_eq!(read(&glb(&root, &bytes, pad, &[]), "a.glb"), [] as [&str; 0]);
    }
    let text = embedded(root.clone(), &bytes);
    assert_eq!(read(&[b"\xef\xbb\xbf", text.as_slice()].concat(), "a.gltf"), [] as [&str; 0]);
    // No bounds, no scene, an accessor of zeros that moves nothing, a mesh without positions, points beside triangles.
    let mut bare = root.clone();
    bare["accessors"][0].as_object_mut().expect("an object").retain(|key, _| key != "min" && key != "max");
    bare["scenes"] = json!([]);
    bare.as_object_mut().expect("an object").remove("scene");
    let zeros = bare["accessors"].as_array().expect("accessors").len();
    let zero = json!({ "componentType": 5126, "count": whole.positions.len(), "type": "VEC3" });
    bare["accessors"].as_array_mut().expect("accessors").push(zero);
    bare["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": zeros }]);
    bare["meshes"][0]["weights"] = json!([1.0]);
    bare["meshes"][0]["primitives"].as_array_mut().expect("primitives").extend([
        json!({ "attributes": { "COLOR_0": 0 } }),
        json!({ "attributes": { "POSITION": 0 }, "mode": 0 }),
        json!({ "attributes": { "POSITION": 0, "_LABEL": 0 }, "mode": 1 }),
    ]);
    assert_eq!(read(&embedded(bare, &bytes), "a.gltf"), [] as [&str; 0]);
}

#[test]
fn what_nothing_reads_of_a_gltf_is_told_once_by_name() {
    let (mut root, bytes) = still();
    root["nodes"] = json!([{ "mesh": 0, "weight": 3 }, { "mesh": 0, "weight": 3, "translation": [9.0, 0.0, 0.0] },
        { "children": [3], "extensions": { "KHR_node_visibility": { "visible": false }, "ACME_hat": {} } },
        { "mesh": 0, "translation": [2.0, 0.0, 0.0] }]);
    root["scenes"] = json!([{ "nodes": [0, 2] }, { "nodes": [1] }]);
    root["extensionsUsed"] = json!(["ACME_hat", "ACME_shoe", "KHR_node_visibility"]);
    root["garment"] = json!({});
    root["meshes"][0]["primitives"][0]["attributes"]["VELOCITY"] = 0.into();
    let body = parse_body(&glb(&root, &bytes, b' ', &[(b"ACME", b"1234")]), "a.glb", &BodyOptions::default());
    let body = body.expect("a readable body");
    assert_eq!(body.mesh.triangles.len(), ellipsoid().triangles.len());
    insta::assert_snapshot!(body.warnings.join("\n"), @r#"
    not read: a chunk of the type "ACME" (byte 5132)
    not read: the extension ACME_hat
    not read: the extension ACME_shoe
    not read: what KHR_node_visibility hides (node 2)
    not read: the key "garment" of a file
    not read: the attribute "VELOCITY" (key "meshes[0].primitives[0]")
    not read: the key "weight" of a node (key "nodes[0]")
    not read: scenes beside the one that is shown (key "scenes[1]")
    "#);
}

#[test]
fn what_pointers_move_is_moved() {
    let (mut root, bytes) = animated("LINEAR");
    let mut options = BodyOptions::default();
    options.clip = Some("move".into());
    options.time = 2.0;
    let expected = parse_body(&embedded(root.clone(), &bytes), "a.gltf", &options).expect("a readable body");
    let pointer =
        |pointer: &str| json!({ "path": "pointer", "extensions": { "KHR_animation_pointer": { "pointer": pointer } } });
    root["animations"][0]["channels"][0]["target"] = pointer("/nodes/1/translation");
    root["animations"][0]["channels"][1]["target"] = pointer("/nodes/1/rotation");
    root["extensionsRequired"] = json!(["KHR_animation_pointer"]);
    let body = parse_body(&embedded(root.clone(), &bytes), "a.gltf", &options).expect("a readable body");
    assert_eq!((body.mesh, body.warnings), (expected.mesh.clone(), Vec::new()));
    let channels = root["animations"][0]["channels"].as_array_mut().expect("channels");
    channels.push(json!({ "sampler": 0, "target": pointer("/materials/0/emissiveFactor") }));
    channels.push(json!({ "sampler": 0, "target": pointer("/meshes/0/weights") }));
    channels.push(json!({ "sampler": 0, "target": { "path": "translation" } }));
    let body = parse_body(&embedded(root, &bytes), "a.gltf", &options).expect("a readable body");
    assert_eq!(body.mesh, expected.mesh);
    insta::assert_snapshot!(body.warnings.join("\n"), @r#"
    not read: the motion of "/meshes/0/weights" (key "animations[0].channels[3]")
    not read: a channel that names no node (key "animations[0].channels[4]")
    "#);
}

#[test]
fn a_json_of_more_than_a_body_has_is_refused_at_once() {
    let (mut root, bytes) = still();
    let read = |root: &Value| parse_body(&embedded(root.clone(), &bytes), "a.gltf", &BodyOptions::default());
    root["nodes"].as_array_mut().expect("nodes").extend(vec![json!({}); 100_000]);
    read(&root).expect("a readable body");
    root["nodes"].as_array_mut().expect("nodes").extend(vec![json!({}); 100_000]);
    let refused = |root: &Value, what: &str| {
        let error = read(root).expect_err("too much").to_string();
        let known = error.starts_with("a.gltf: a glTF JSON of more than ");
        assert!(known && error.ends_with(&format!(" {what} cannot be read")), "{error}");
    };
    refused(&root, "objects");
    root["nodes"] = json!([{ "mesh": 0, "weights": vec![0; 1_500_000] }]);
    refused(&root, "values");
}
