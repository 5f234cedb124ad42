//! glTF bodies whose numbers are compressed: they are the same bodies.

use crate::gltf_bodies::{animated, embedded, glb};
use crate::support::ellipsoid;
use draco_core::{
    DataType, EncoderBuffer, EncoderOptions, FaceIndex, GeometryAttributeType, MeshEncoder, PointAttribute, PointIndex,
};
use meshoptimizer_rs::Workspace;
use meshoptimizer_rs::codec::{
    ExpMode, IndexEncoding, VertexEncoding, encode_filter_exp, encode_index_buffer, encode_index_sequence,
    encode_vertex_buffer,
};
use serde_json::{Value, json};
use toile_files::{BodyOptions, parse_body};
use toile_scene::Mesh;

/// The body of a JSON and its bytes, which must be read without a word.
fn read(root: Value, bytes: &[u8]) -> Mesh {
    let body = parse_body(&embedded(root, bytes), "a.gltf", &BodyOptions::default()).expect("a readable body");
    assert_eq!(body.warnings, [] as [&str; 0]);
    body.mesh
}

/// A mesh without a clip, whose numbers are yet to come.
fn empty() -> Value {
    let (mut root, _) = animated("LINEAR");
    root["nodes"] = json!([{ "mesh": 0 }]);
    root.as_object_mut().expect("an object").remove("animations");
    root["accessors"].as_array_mut().expect("accessors").truncate(2);
    root["bufferViews"] = json!([]);
    root
}

/// Whether each triangle of one mesh is one of the other, to a distance [m].
fn assert_same(got: &Mesh, expected: &Mesh, distance: f32) {
    assert_eq!((got.positions.len(), got.triangles.len()), (expected.positions.len(), expected.triangles.len()));
    let middle = |mesh: &Mesh, t: &[u32; 3]| t.iter().map(|at| mesh.positions[*at as usize]).sum::<glam::Vec3>() / 3.0;
    for triangle in &got.triangles {
        let at = middle(got, triangle);
        let nearest = expected.triangles.iter().map(|t| middle(expected, t).distance(at)).fold(f32::MAX, f32::min);
        assert!(nearest <= distance, "{nearest}");
    }
    assert!((got.signed_volume() - expected.signed_volume()).abs() <= 1e-9 + 20.0 * f64::from(distance));
}

/// An ellipsoid as Draco compresses it; the second attribute says from which joint a vertex hangs.
fn draco(method: i32, level: i32) -> Vec<u8> {
    let mesh = ellipsoid();
    let mut packed = draco_core::Mesh::new();
    let count = mesh.positions.len();
    let mut position = PointAttribute::new();
    position.init(GeometryAttributeType::Position, 3, DataType::Float32, false, count);
    let mut weight = PointAttribute::new();
    weight.init(GeometryAttributeType::Generic, 4, DataType::Uint8, true, count);
    for (at, p) in mesh.positions.iter().enumerate() {
        let bytes: Vec<u8> = p.to_array().iter().flat_map(|value| value.to_le_bytes()).collect();
        position.buffer_mut().write(at * 12, &bytes);
        weight.buffer_mut().write(at * 4, &[255, 0, 0, 0]);
    }
    packed.set_num_points(count);
    packed.add_attribute(position);
    packed.add_attribute(weight);
    packed.set_num_faces(mesh.triangles.len());
    for (face, corners) in mesh.triangles.iter().enumerate() {
        packed.set_face(FaceIndex(face as u32), corners.map(PointIndex));
    }
    let mut encoder = MeshEncoder::new();
    encoder.set_mesh(packed);
    let mut options = EncoderOptions::new();
    options.set_compression_level(level);
    options.set_encoding_method(method);
    let mut out = EncoderBuffer::new();
    encoder.encode(&options, &mut out).expect("a mesh");
    out.data().to_vec()
}

/// A file whose mesh Draco compressed.
pub fn draco_gltf(method: i32, level: i32) -> (Value, Vec<u8>) {
    let bytes = draco(method, level);
    let mut root = empty();
    root["accessors"][0].as_object_mut().expect("an object").remove("bufferView");
    root["accessors"][1].as_object_mut().expect("an object").remove("bufferView");
    root["accessors"].as_array_mut().expect("accessors").push(
        json!({ "componentType": 5121, "normalized": true, "count": ellipsoid().positions.len(), "type": "VEC4" }),
    );
    root["bufferViews"] = json!([{ "buffer": 0, "byteLength": bytes.len() }]);
    root["buffers"] = json!([{ "byteLength": bytes.len() }]);
    root["meshes"][0]["primitives"][0] = json!({ "attributes": { "POSITION": 0, "COLOR_0": 2 }, "indices": 1,
        "extensions": { "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0, "COLOR_0": 1 } } } });
    root["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    root["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    (root, bytes)
}

#[test]
fn what_draco_compresses_is_the_same_body() {
    for (method, level) in [(0, 0), (1, 3), (1, 7), (1, 10)] {
        let (root, bytes) = draco_gltf(method, level);
        assert_same(&read(root, &bytes), &ellipsoid(), 2e-3);
    }
}

#[test]
fn damaged_draco_is_refused_by_its_cause() {
    let whole = draco(1, 7);
    let refusal = |bytes: &[u8], change: fn(&mut Value)| {
        let mut root = empty();
        root["accessors"][0].as_object_mut().expect("an object").remove("bufferView");
        root["accessors"][1].as_object_mut().expect("an object").remove("bufferView");
        root["bufferViews"] = json!([{ "buffer": 0, "byteLength": bytes.len() }]);
        root["buffers"] = json!([{ "byteLength": bytes.len() }]);
        root["meshes"][0]["primitives"][0]["extensions"] =
            json!({ "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": { "POSITION": 0 } } });
        change(&mut root);
        let refused = parse_body(&embedded(root, bytes), "a.gltf", &BodyOptions::default());
        refused.expect_err("a refusal").to_string()
    };
    let told = [
        refusal(&whole[..whole.len() / 2], |_| {}),
        refusal(&whole, |root| {
            root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"] =
                9.into();
        }),
        refusal(&whole, |root| {
            root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = 9.into();
        }),
    ];
    for sentence in told {
        let start =
            "a.gltf, key \"meshes[0].primitives[0]\": what KHR_draco_mesh_compression compressed cannot be decoded (";
        assert!(sentence.starts_with(start) && sentence.ends_with("): export it without compression"), "{sentence}");
    }
}

/// Files whose numbers meshopt compressed, in each of its ways, and how exact they are [m].
pub fn meshopt_gltfs() -> Vec<(Value, Vec<u8>, f32)> {
    let mesh = ellipsoid();
    let mut workspace = Workspace::default();
    let floats: Vec<f32> = mesh.positions.iter().flat_map(|p| p.to_array()).collect();
    let plain: Vec<u8> = floats.iter().flat_map(|value| value.to_le_bytes()).collect();
    let corners: Vec<u32> = mesh.triangles.iter().flatten().copied().collect();
    let count = mesh.positions.len();
    let rounded = encode_filter_exp(count, 12, 18, &floats, ExpMode::Separate, &mut workspace).expect("floats");
    let vertices = |data: &[u8], workspace: &mut Workspace| {
        encode_vertex_buffer(data, count, 12, VertexEncoding::default(), workspace).expect("vertices")
    };
    let triangles = encode_index_buffer(&corners, IndexEncoding::default(), &mut workspace).expect("triangles");
    let sequence = encode_index_sequence(&corners, IndexEncoding::default(), &mut workspace).expect("indices");
    let cases = [
        ("EXT_meshopt_compression", vertices(&plain, &mut workspace), "NONE", triangles.clone(), "TRIANGLES", 0.0),
        ("KHR_meshopt_compression", vertices(&plain, &mut workspace), "NONE", sequence, "INDICES", 0.0),
        ("MESHOPT_compression", vertices(&rounded, &mut workspace), "EXPONENTIAL", triangles, "TRIANGLES", 1e-4),
    ];
    let gltf = |(name, vertices, filter, indices, mode, distance): (&str, Vec<u8>, &str, Vec<u8>, &str, f32)| {
        let bytes = [vertices.as_slice(), &indices].concat();
        let mut root = empty();
        root["buffers"] = json!([{ "byteLength": bytes.len() },
            { "byteLength": plain.len() + 4 * corners.len(), "uri": "lost.bin", "extensions": { name: { "fallback": true } } }]);
        root["bufferViews"] = json!([
            { "buffer": 1, "byteLength": plain.len(), "byteStride": 12, "extensions": { name: { "buffer": 0,
                "byteLength": vertices.len(), "byteStride": 12, "count": count, "mode": "ATTRIBUTES", "filter": filter } } },
            { "buffer": 1, "byteOffset": plain.len(), "byteLength": 4 * corners.len(), "extensions": { name: { "buffer": 0,
                "byteOffset": vertices.len(), "byteLength": indices.len(), "byteStride": 4, "count": corners.len(), "mode": mode } } }]);
        root["accessors"][1]["bufferView"] = 1.into();
        root["extensionsUsed"] = json!([name]);
        root["extensionsRequired"] = json!([name]);
        (root, bytes, distance)
    };
    cases.into_iter().map(gltf).collect()
}

#[test]
fn what_meshopt_compresses_is_the_same_body() {
    for (root, bytes, distance) in meshopt_gltfs() {
        assert_same(&read(root, &bytes), &ellipsoid(), distance);
    }
}

#[test]
fn the_place_of_what_is_compressed_need_not_exist_nor_say_so() {
    for (mut root, bytes, distance) in meshopt_gltfs() {
        root["buffers"][1].as_object_mut().expect("a buffer").retain(|key, _| key == "byteLength");
        let body = parse_body(&glb(&root, &bytes, b' ', &[]), "a.glb", &BodyOptions::default());
        assert_same(&body.expect("a readable body").mesh, &ellipsoid(), distance);
        // A view that needs it as it stands is told what is missing.
        root["bufferViews"].as_array_mut().expect("views").push(json!({ "buffer": 1, "byteLength": 12 }));
        let refused = parse_body(&glb(&root, &bytes, b' ', &[]), "a.glb", &BodyOptions::default());
        assert_eq!(refused.expect_err("a refusal").to_string(), "a.glb: buffer 1 is not in the file");
    }
}

#[test]
fn a_few_bytes_do_not_decode_to_any_number() {
    let count = 300_000;
    let zeros = vec![0; 256 * count];
    let packed = encode_vertex_buffer(&zeros, count, 256, VertexEncoding::default(), &mut Workspace::default());
    let packed = packed.expect("zeros");
    let mut root = empty();
    root["bufferViews"] = json!([{ "buffer": 0, "byteLength": 4, "extensions": { "EXT_meshopt_compression":
        { "buffer": 0, "byteLength": packed.len(), "byteStride": 256, "count": count, "mode": "ATTRIBUTES" } } }]);
    root["buffers"] = json!([{ "byteLength": packed.len() }]);
    let refused = parse_body(&embedded(root, &packed), "a.gltf", &BodyOptions::default());
    let sentence = refused.expect_err("a refusal").to_string();
    insta::assert_snapshot!(sentence, @r#"a.gltf, key "bufferViews[0]": what EXT_meshopt_compression compressed cannot be decoded (resource limit exceeded): export it without compression"#);
}
