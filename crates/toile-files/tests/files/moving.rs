//! Bodies that move: they are what the same file gives at each time.

use crate::gltf_bodies::{animated, embedded};
use crate::support::{ellipsoid, fixture, obj_text, with};
use serde_json::{Value, json};
use toile_files::{BodyOptions, parse_body, parse_moving_body, read_body, read_mesh_sequence, read_moving_body};
use toile_scene::{Mesh, Motion, MovingMesh};

fn options(clip: &str, time: f64) -> BodyOptions {
    let mut options = BodyOptions::default();
    options.clip = Some(clip.into());
    options.time = time;
    options
}

/// Largest distance of two meshes with the same triangles [m].
fn farthest(a: &Mesh, b: &Mesh) -> f32 {
    assert_eq!(a.triangles, b.triangles);
    a.positions.iter().zip(&b.positions).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

fn most_turned(a: &Mesh, b: &Mesh) -> f32 {
    a.normals.iter().zip(&b.normals).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

fn woman(clip: &str) -> MovingMesh {
    let file = read_moving_body(&fixture("bodies/walking_woman.glb"), &options(clip, 0.0)).expect("the fixture");
    assert_eq!(file.warnings, [] as [&str; 0]);
    file.body
}

const CLIPS: [&str; 3] = ["walk_loop", "walk_forward_4cycles", "apose_to_walk"];

#[test]
fn the_walking_woman_stands_at_every_time_where_the_file_says() {
    for clip in CLIPS {
        let body = woman(clip);
        for time in [0.0, 0.0333, 0.41, 0.77, 1.09, 2.0, 4.3, 7.0] {
            if body.is_closed() && time > body.duration() {
                continue;
            }
            let expected = read_body(&fixture("bodies/walking_woman.glb"), &options(clip, time)).expect("the fixture");
            let got = body.at(time);
            assert!(farthest(&got, &expected.mesh) < 1e-6, "{clip} {time}: {}", farthest(&got, &expected.mesh));
            assert!(most_turned(&got, &expected.mesh) < 1e-4, "{clip} {time}: {}", most_turned(&got, &expected.mesh));
        }
        assert!(farthest(&body.at(0.0), &body.mesh) < 1e-6);
    }
}

#[test]
fn only_the_loop_is_closed() {
    assert_eq!(CLIPS.map(|clip| woman(clip).is_closed()), [true, false, false]);
    let walk = woman("walk_loop");
    assert!((walk.duration() - 1.1).abs() < 1e-6);
    // A body at rest takes the last pose of a clip for any later time.
    let late = read_body(&fixture("bodies/walking_woman.glb"), &options("walk_loop", 1.4)).expect("the fixture");
    assert!(farthest(&late.mesh, &walk.at(walk.duration())) < 1e-6);
    let again = walk.at(2.0 * walk.duration() + 0.3);
    assert!(farthest(&again, &walk.at(0.3)) < 1e-6);
    let Motion::Skinned { rig, .. } = &walk.motion else { panic!("a skin") };
    assert_eq!((rig.joints().len(), rig.joint_names().nth(1)), (53, Some("pelvis")));
    let forward = woman("walk_forward_4cycles");
    assert_eq!(forward.at(9.0), forward.at(forward.duration()));
    let first = read_moving_body(&fixture("bodies/walking_woman.glb"), &BodyOptions::default()).expect("a clip");
    assert_eq!(first.body.at(0.5), walk.at(0.5));
}

/// A glTF of two ellipsoids. The first hangs on two joints by two sets and has two morph targets; the second is carried by
/// a node that turns. Everything moves for two seconds.
pub fn puppet() -> (Value, Vec<u8>) {
    let mesh = ellipsoid();
    let mut bytes: Vec<u8> = Vec::new();
    let (mut views, mut accessors) = (Vec::new(), Vec::new());
    let mut add = |data: Vec<u8>, component: u32, count: usize, shape: &str| {
        views.push(json!({ "buffer": 0, "byteOffset": bytes.len(), "byteLength": data.len() }));
        bytes.extend(data);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        accessors
            .push(json!({ "bufferView": views.len() - 1, "componentType": component, "count": count, "type": shape }));
        accessors.len() - 1
    };
    let floats = |values: &[f32]| -> Vec<u8> { values.iter().flat_map(|value| value.to_le_bytes()).collect() };
    let vectors =
        |vectors: &[glam::Vec3]| -> Vec<u8> { floats(&vectors.iter().flat_map(|v| v.to_array()).collect::<Vec<_>>()) };
    let count = mesh.positions.len();
    let position = add(vectors(&mesh.positions), 5126, count, "VEC3");
    let normal = add(vectors(&mesh.normals), 5126, count, "VEC3");
    let indices = mesh.triangles.iter().flatten().flat_map(|index| index.to_le_bytes()).collect();
    let triangles = add(indices, 5125, 3 * mesh.triangles.len(), "SCALAR");
    let height = |at: usize| mesh.positions[at].y / 1.6;
    // The first set has one part of the shares, the second the rest; they sum to 2.
    let first_joints = add([0, 1, 0, 0].repeat(count), 5121, count, "VEC4");
    let shares = |part: fn(f32) -> [f32; 4]| floats(&(0..count).flat_map(|at| part(height(at))).collect::<Vec<_>>());
    let first_weights = add(shares(|y| [1.0 - y, 0.5 * y, 0.0, 0.0]), 5126, count, "VEC4");
    let second_joints = add([1, 0, 0, 0].repeat(count), 5121, count, "VEC4");
    let second_weights = add(shares(|y| [1.0 + 0.5 * y, 0.0, 0.0, 0.0]), 5126, count, "VEC4");
    let wider: Vec<glam::Vec3> = mesh.positions.iter().map(|p| glam::vec3(0.3 * p.x, 0.0, 0.0)).collect();
    let bow: Vec<glam::Vec3> = mesh.positions.iter().map(|p| glam::vec3(0.0, 0.0, 0.2 * p.y * p.y)).collect();
    let bent: Vec<glam::Vec3> = mesh.normals.iter().map(|n| glam::vec3(0.0, -0.4 * n.z, 0.0)).collect();
    let (wider, bow, bent) = (
        add(vectors(&wider), 5126, count, "VEC3"),
        add(vectors(&bow), 5126, count, "VEC3"),
        add(vectors(&bent), 5126, count, "VEC3"),
    );
    let lower = |y: f32| [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -y, 0.0, 1.0];
    let bind = add(floats(&[lower(0.0), lower(0.8)].concat()), 5126, 2, "MAT4");
    let times = add(floats(&[0.0, 2.0]), 5126, 2, "SCALAR");
    let half = 0.5f32.sqrt();
    let turns = add(floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, half, half]), 5126, 2, "VEC4");
    let scales = add(floats(&[1.0, 1.0, 1.0, 1.0, 1.5, 0.5]), 5126, 2, "VEC3");
    let weights = add(floats(&[0.5, 0.25, 1.0, -1.0]), 5126, 4, "SCALAR");
    let root = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0, 3] }],
        "nodes": [
            { "children": [1, 4] },
            { "name": "hips", "children": [2] },
            { "name": "chest", "translation": [0.0, 0.8, 0.0] },
            { "mesh": 0, "skin": 0, "translation": [9.0, 9.0, 9.0], "weights": [0.75, 0.5] },
            { "mesh": 1, "translation": [0.8, 0.0, 0.0], "scale": [0.5, 0.5, 0.5] }],
        "skins": [{ "joints": [1, 2], "inverseBindMatrices": bind }],
        "meshes": [
            { "primitives": [{
                "attributes": { "POSITION": position, "NORMAL": normal, "JOINTS_0": first_joints, "WEIGHTS_0": first_weights,
                                "JOINTS_1": second_joints, "WEIGHTS_1": second_weights },
                "targets": [{ "POSITION": wider }, { "POSITION": bow, "NORMAL": bent }],
                "indices": triangles }],
              "weights": [0.1, 0.1] },
            { "primitives": [{ "attributes": { "POSITION": position }, "indices": triangles }] }],
        "animations": [
            { "name": "act", "channels": [
                { "sampler": 0, "target": { "node": 2, "path": "rotation" } },
                { "sampler": 1, "target": { "node": 1, "path": "scale" } },
                { "sampler": 0, "target": { "node": 4, "path": "rotation" } },
                { "sampler": 2, "target": { "node": 3, "path": "weights" } }],
              "samplers": [{ "input": times, "output": turns }, { "input": times, "output": scales },
                           { "input": times, "output": weights }] },
            { "name": "rest", "channels": [{ "sampler": 0, "target": { "node": 4, "path": "rotation" } }],
              "samplers": [{ "input": times, "output": turns }] }],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{ "byteLength": bytes.len() }],
    });
    let mut root = root;
    root["accessors"][0]["min"] = json!([-0.25, 0.0, -0.2]);
    root["accessors"][0]["max"] = json!([0.25, 1.6, 0.2]);
    (root, bytes)
}

#[test]
fn morphs_joint_sets_and_rigid_nodes_move_as_the_file_says() {
    let (root, bytes) = puppet();
    let file = embedded(root, &bytes);
    for (clip, metres_per_unit) in [("act", 1.0), ("act", 0.5), ("rest", 1.0)] {
        let options = |time| with(options(clip, time), |options| options.metres_per_unit = metres_per_unit);
        let moving = parse_moving_body(&file, "a.gltf", &options(0.0)).expect("a readable body").body;
        assert!(most_turned(&moving.at(0.0), &moving.mesh) < 1e-5, "{}", most_turned(&moving.at(0.0), &moving.mesh));
        for time in [0.0, 0.3, 1.0, 1.9, 5.0] {
            let expected = parse_body(&file, "a.gltf", &options(time)).expect("a readable body").mesh;
            let got = moving.at(time);
            assert!(farthest(&got, &expected) < 1e-6, "{clip} {time}: {}", farthest(&got, &expected));
        }
    }
}

#[test]
fn a_morphed_vertex_on_two_joints_stands_where_arithmetic_puts_it() {
    let (root, bytes) = puppet();
    let moving =
        parse_moving_body(&embedded(root, &bytes), "a.gltf", &options("act", 0.0)).expect("a readable body").body;
    let mesh = ellipsoid();
    // At the end the hips are scaled by (1, 1.5, 0.5), the chest is turned by a quarter about z, and the weights are 1 and −1.
    let vertex = 30;
    let p = mesh.positions[vertex];
    let y = p.y / 1.6;
    let morphed = glam::vec3(1.3 * p.x, p.y, p.z - 0.2 * p.y * p.y);
    let hips = morphed * glam::vec3(1.0, 1.5, 0.5);
    let chest = glam::vec3(-(morphed.y - 0.8), morphed.x + 0.8, morphed.z) * glam::vec3(1.0, 1.5, 0.5);
    let share = 0.5 * (1.0 - y);
    let expected = hips * share + chest * (1.0 - share);
    let got = moving.at(2.0).positions[vertex];
    assert!(got.distance(expected) < 1e-6, "{got} {expected}");
    // The second mesh is half as large, 0.8 beside, and turned by a quarter.
    let got = moving.at(2.0).positions[mesh.positions.len() + vertex];
    let expected = glam::vec3(0.8 - 0.5 * p.y, 0.5 * p.x, 0.5 * p.z);
    assert!(got.distance(expected) < 1e-6, "{got} {expected}");
    let Motion::Skinned { rig, .. } = &moving.motion else { panic!("a skin") };
    let mut names: Vec<_> = rig.joint_names().collect();
    names.sort_unstable();
    assert_eq!(names, ["chest", "hips", "node 4"]);
}

#[test]
fn resting_morph_weights_are_the_nodes_then_the_meshs() {
    let (mut root, bytes) = puppet();
    let width = |root: &Value| {
        let body = parse_body(&embedded(root.clone(), &bytes), "a.gltf", &BodyOptions::default()).expect("a body");
        // The second mesh brings no normals.
        assert_eq!(body.warnings, ["normals replaced (missing, not finite or against the winding): 110"]);
        2.0 * body.mesh.bounds().expect("vertices")[0].x.abs()
    };
    assert!((width(&root) - 0.5 * (1.0 + 0.3 * 0.75)).abs() < 1e-5, "{}", width(&root));
    root["nodes"][3].as_object_mut().expect("a node").remove("weights");
    assert!((width(&root) - 0.5 * (1.0 + 0.3 * 0.1)).abs() < 1e-5, "{}", width(&root));
}

#[test]
fn a_sparse_morph_target_changes_only_what_it_names() {
    let (mut root, mut bytes) = puppet();
    let start = bytes.len();
    bytes.extend([30u16, 50].iter().flat_map(|index| index.to_le_bytes()));
    bytes.extend([0.0f32, 0.0, 0.5, 0.0, 0.0, -0.5].iter().flat_map(|value| value.to_le_bytes()));
    let views = root["bufferViews"].as_array_mut().expect("views");
    views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": 4 }));
    views.push(json!({ "buffer": 0, "byteOffset": start + 4, "byteLength": 24 }));
    let (indices, values) = (views.len() - 2, views.len() - 1);
    let accessors = root["accessors"].as_array_mut().expect("accessors");
    accessors.push(json!({ "componentType": 5126, "count": 110, "type": "VEC3", "sparse": { "count": 2,
        "indices": { "bufferView": indices, "componentType": 5123 }, "values": { "bufferView": values } } }));
    let sparse = accessors.len() - 1;
    root["buffers"][0]["byteLength"] = bytes.len().into();
    root["nodes"][3]["weights"] = json!([0.0, 0.0]);
    let read = |root: &Value| parse_body(&embedded(root.clone(), &bytes), "a.gltf", &BodyOptions::default());
    let plain = read(&root).expect("a body").mesh;
    root["meshes"][0]["primitives"][0]["targets"] = json!([{ "POSITION": sparse }]);
    root["nodes"][3]["weights"] = json!([0.5]);
    let changed = read(&root).expect("a body").mesh;
    for (vertex, (a, b)) in plain.positions.iter().zip(&changed.positions).enumerate() {
        let expected = match vertex {
            30 => 0.25,
            50 => -0.25,
            _ => 0.0,
        };
        assert!((b.z - a.z - expected).abs() < 1e-6, "{vertex}");
    }
    let faults = [("count", json!(3)), ("count", json!(4_000_000_000u64))];
    for (key, value) in faults {
        let mut root = root.clone();
        root["accessors"][sparse]["sparse"][key] = value;
        let error = read(&root).expect_err("a refusal").to_string();
        assert!(error.contains("is truncated or damaged"), "{error}");
    }
    root["accessors"][sparse]["count"] = 20.into();
    let error = read(&root).expect_err("a refusal").to_string();
    insta::assert_snapshot!(error, @"a.gltf, accessor 15: it has 20 elements for 110 vertices");
}

#[test]
fn vertices_of_one_place_that_hang_differently_are_told() {
    // Two nodes carry one mesh at one place; only the second one moves.
    let (mut root, bytes) = animated("LINEAR");
    root["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0 }]);
    root["scenes"][0]["nodes"] = json!([0, 1]);
    let file = parse_moving_body(&embedded(root, &bytes), "a.gltf", &options("move", 0.0)).expect("a body");
    assert_eq!(
        file.warnings,
        [
            "duplicated triangles removed: 216",
            "vertices that follow another one of the same place, which hangs differently: 110"
        ]
    );
    // The second node comes first in the walk through the scene, so it is the one that is followed.
    let [start, end] = [0.0, 3.0].map(|time| file.body.at(time).positions[0]);
    assert!(end.distance(start + glam::vec3(0.4, 0.0, 0.0)) < 1e-6, "{start} {end}");
}

#[test]
fn what_cannot_move_is_refused() {
    let (root, bytes) = animated("LINEAR");
    let message = |root: &Value, clip: Option<&str>| {
        let mut options = BodyOptions::default();
        options.clip = clip.map(String::from);
        parse_moving_body(&embedded(root.clone(), &bytes), "a.gltf", &options).expect_err("a refusal").to_string()
    };
    let mut messages = vec![message(&root, Some("run"))];
    let mut change = |pointer: &str, value: Value, clip: Option<&str>| {
        let mut root = root.clone();
        *root.pointer_mut(pointer).expect(pointer) = value;
        messages.push(message(&root, clip));
    };
    change("/animations", json!([]), None);
    change("/nodes/1", json!({ "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }), None);
    change("/animations/0/samplers/0/input", 1.into(), None);
    change("/animations/0/samplers/0/output", 4.into(), None);
    change("/animations/0/channels/0/target/path", "colour".into(), None);
    change("/animations/0/channels/1/target/node", 7.into(), None);
    let index = |value: &Value| value.as_u64().expect("an index") as usize;
    let times = index(&root["animations"][0]["samplers"][0]["input"]);
    let view = index(&root["accessors"][times]["bufferView"]);
    let last = index(&root["bufferViews"][view]["byteOffset"]) + 4;
    let mut long = bytes.clone();
    long[last..last + 4].copy_from_slice(&1e9f32.to_le_bytes());
    let error = parse_moving_body(&embedded(root.clone(), &long), "a.gltf", &BodyOptions::default());
    messages.push(error.expect_err("a refusal").to_string());
    for name in ["a.obj", "a.stl"] {
        let error = parse_moving_body(obj_text(&ellipsoid()).as_bytes(), name, &BodyOptions::default());
        messages.push(error.expect_err("a refusal").to_string());
    }
    insta::assert_snapshot!(messages.join("\n"), @r#"
    a.gltf: there is no clip "run"; there is: move
    a.gltf: it has no clip, so the body cannot move
    a.gltf, node 1: the clip moves a node that has a matrix instead of a translation and rotation
    a.gltf, accessor 1: the times of the keys do not rise
    a.gltf, accessor 4: it must be Vec3 and is Vec4
    a.gltf, key "animations[0].channels[0].target.path": a clip moves "translation", "rotation", "scale" or "weights"
    a.gltf, key "animations[0].channels[1].target.node": node 7 does not exist: there are 2
    a.gltf: the clip "move" is 1000000000 s long, and clips are at most 3600 s: cut it
    a.obj: the motion of a .obj file, which has none (a .gltf or .glb file can have clips), cannot be read
    a.stl: by its first bytes it is an OBJ file: name it .obj
    "#);
}

/// A folder of OBJ files: an ellipsoid with a stray vertex and a seam that is welded, half as wide at the end.
fn sequence(change: impl Fn(usize, &mut Vec<String>)) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for frame in 0..3 {
        let mut mesh = ellipsoid();
        mesh.positions.iter_mut().for_each(|position| position.x *= 1.0 - 0.25 * frame as f32);
        mesh.positions.insert(0, glam::vec3(9.0, 9.0, 9.0));
        mesh.triangles.iter_mut().flatten().for_each(|index| *index += 1);
        mesh.positions.push(mesh.positions[1]);
        mesh.triangles[0] = mesh.triangles[0].map(|index| if index == 1 { 111 } else { index });
        let mut lines: Vec<String> = obj_text(&mesh).lines().map(String::from).collect();
        change(frame, &mut lines);
        std::fs::write(folder.path().join(format!("frame_{frame}.obj")), lines.join("\n")).expect("a file");
    }
    std::fs::write(folder.path().join("readme.txt"), "not a body").expect("a file");
    folder
}

#[test]
fn a_folder_of_files_moves_in_the_order_of_their_names() {
    let folder = sequence(|_, _| {});
    let file = read_mesh_sequence(folder.path(), 10.0, &BodyOptions::default()).expect("a sequence");
    assert_eq!(file.warnings, ["isolated vertices removed: 1"]);
    let body = file.body;
    assert_eq!((body.mesh.positions.len(), body.duration(), body.is_closed()), (110, 0.2, false));
    let first = parse_body(
        &std::fs::read(folder.path().join("frame_0.obj")).expect("a file"),
        "a.obj",
        &BodyOptions::default(),
    );
    assert_eq!(body.mesh, first.expect("a body").mesh);
    for (time, width) in [(0.0, 1.0), (0.05, 0.875), (0.2, 0.5), (1.0, 0.5)] {
        let mesh = body.at(time);
        for (got, expected) in mesh.positions.iter().zip(&ellipsoid().positions) {
            assert!((got.x - width * expected.x).abs() < 1e-6 && (got.y - expected.y).abs() < 1e-6, "{time}");
        }
    }
    let last = body.at(0.2);
    assert!(last.normals.iter().zip(&last.area_weighted_normals()).all(|(a, b)| a.distance(*b) < 1e-6));
    assert!(last.normals.iter().zip(&body.mesh.normals).any(|(a, b)| a.distance(*b) > 0.1));
}

#[test]
fn what_leaves_its_place_is_told_and_what_differs_is_refused() {
    let torn = sequence(|frame, lines| {
        if frame == 2 {
            lines[111] = "v 0 1.7 0".into();
        }
    });
    let file = read_mesh_sequence(torn.path(), 10.0, &BodyOptions::default()).expect("a sequence");
    let expected = "vertices that start at the place of another one and leave it, which is not followed: 1";
    assert_eq!(file.warnings, ["isolated vertices removed: 1", expected]);
    let other_faces = sequence(|frame, lines| {
        if frame == 1 {
            lines.swap(112, 113)
        }
    });
    let more_vertices = sequence(|frame, lines| {
        if frame == 2 {
            lines.push("v 0 0 0".into())
        }
    });
    let broken = sequence(|frame, lines| {
        if frame == 1 {
            lines[5] = "v 0 nan 0".into()
        }
    });
    let empty = tempfile::tempdir().expect("a folder");
    let message = |folder: &std::path::Path| {
        let error = read_mesh_sequence(folder, 10.0, &BodyOptions::default()).expect_err("a refusal").to_string();
        error.replace(&folder.display().to_string(), "folder")
    };
    let messages: Vec<_> =
        [other_faces, more_vertices, broken, empty].iter().map(|folder| message(folder.path())).collect();
    insta::assert_snapshot!(messages.join("\n"), @r#"
    folder/frame_1.obj: its faces are not those of frame_0.obj; a sequence moves one mesh
    folder/frame_2.obj: it has 113 vertices and frame_0.obj has 112; a sequence moves one mesh
    folder/frame_1.obj, line 6: the position (0.0, NaN, 0.0) is not a finite number
    folder: the folder has no .obj file
    "#);
    let missing = read_mesh_sequence(std::path::Path::new("nowhere"), 10.0, &BodyOptions::default());
    assert!(missing.expect_err("no folder").to_string().starts_with("nowhere: it cannot be read: "));
}

#[test]
fn a_body_goes_gently_from_the_pose_of_one_clip_to_that_of_another() {
    let [from, to] = ["apose_to_walk", "walk_loop"].map(woman);
    let way = MovingMesh::transition(&from, &to, 2.0).expect("one body");
    assert_eq!((way.duration(), way.is_closed()), (2.0, false));
    let far = |a: &[glam::Vec3], b: &[glam::Vec3]| a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    let at = |time: f64| way.at(time).positions;
    assert!(far(&at(0.0), &from.at(0.0).positions) < 1e-5 && far(&at(2.0), &to.at(0.0).positions) < 1e-5);
    assert!(far(&at(3.0), &at(2.0)) == 0.0, "it waits there");
    let [start, middle] = [far(&at(0.0), &at(0.1)), far(&at(0.95), &at(1.05))];
    assert!(start < 0.3 * middle, "{start} m and {middle} m in a tenth of a second");
    let (mesh, keys) = (from.mesh.clone(), Vec::new());
    assert!(MovingMesh::transition(&from, &MovingMesh::rigid(mesh, keys), 2.0).is_none());
}
