//! Generated garbage and damaged valid files: no panic, no hang, no huge allocation.

use crate::gltf_bodies::embedded;
use crate::moving::puppet;
use crate::support::{ellipsoid, fixture, garment_text, obj_text, ply_bytes, with};
use proptest::prelude::*;
use std::fs;
use std::sync::LazyLock;
use toile_files::{
    BodyOptions, GarmentFile, NamedMesh, parse_body, parse_garment, parse_moving_body, read_scene, write_glb,
};

/// Valid bodies, one of each format, and the name that tells the format.
static BODIES: LazyLock<Vec<(&str, Vec<u8>)>> = LazyLock::new(|| {
    let mesh = ellipsoid();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.glb");
    write_glb(&path, &[NamedMesh::new("a", &mesh, [1.0; 3])]).expect("a file");
    let ascii = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 1 0\n0 1 1\n3 0 1 2\n";
    vec![
        ("a.obj", obj_text(&mesh).into_bytes()),
        ("a.ply", ply_bytes(&mesh, false)),
        ("a.ply", ply_bytes(&mesh, true)),
        ("a.ply", ascii.to_vec()),
        ("a.glb", fs::read(&path).expect("the file")),
    ]
});

/// A few kilobytes of the skinned fixture would not parse, so damage goes into the JSON and the whole is kept.
static WALKER: LazyLock<Vec<u8>> =
    LazyLock::new(|| fs::read(fixture("bodies/walking_woman.glb")).expect("the fixture"));

/// Bytes that are overwritten, cut out, or doubled.
#[derive(Clone, Debug)]
enum Damage {
    Overwrite(prop::sample::Index, u8),
    Word(prop::sample::Index, u32),
    Cut(prop::sample::Index, usize),
    Truncate(prop::sample::Index),
    Insert(prop::sample::Index, String),
}

fn damage() -> impl Strategy<Value = Vec<Damage>> {
    let index = any::<prop::sample::Index>;
    let words = prop::sample::select(vec![
        "-1",
        "99999999999",
        "nan",
        "1e400",
        "\"",
        "{",
        "]",
        "null",
        " ",
        "\n",
        "0",
        "element vertex 4000000000\n",
    ]);
    let one = prop_oneof![
        (index(), any::<u8>()).prop_map(|(at, byte)| Damage::Overwrite(at, byte)),
        (index(), any::<u32>()).prop_map(|(at, word)| Damage::Word(at, word)),
        (index(), 1usize..40).prop_map(|(at, length)| Damage::Cut(at, length)),
        index().prop_map(Damage::Truncate),
        (index(), words).prop_map(|(at, word)| Damage::Insert(at, word.into())),
    ];
    prop::collection::vec(one, 1..6)
}

fn damaged(bytes: &[u8], within: usize, damages: &[Damage]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for damage in damages {
        if bytes.is_empty() {
            break;
        }
        let end = within.min(bytes.len());
        match damage {
            Damage::Overwrite(at, byte) => bytes[at.index(end)] = *byte,
            Damage::Word(at, word) => {
                let at = at.index(end);
                let length = 4.min(bytes.len() - at);
                bytes[at..at + length].copy_from_slice(&word.to_le_bytes()[..length]);
            }
            Damage::Cut(at, length) => {
                let at = at.index(end);
                bytes.drain(at..(at + length).min(bytes.len()));
            }
            Damage::Truncate(at) => bytes.truncate(at.index(end)),
            Damage::Insert(at, word) => {
                let at = at.index(end);
                bytes.splice(at..at, word.bytes());
            }
        }
    }
    bytes
}

/// Whatever is accepted is a mesh that the rest of the program can trust.
fn check(bytes: &[u8], name: &str, options: &BodyOptions) -> Result<(), TestCaseError> {
    if let Ok(body) = parse_body(bytes, name, options) {
        let mesh = &body.mesh;
        prop_assert!(!mesh.triangles.is_empty());
        prop_assert!(mesh.positions.iter().all(|position| position.is_finite()));
        prop_assert_eq!(mesh.normals.len(), mesh.positions.len());
        prop_assert!(mesh.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-3));
        prop_assert!(mesh.triangles.iter().flatten().all(|index| (*index as usize) < mesh.positions.len()));
    }
    Ok(())
}

/// A small body with joints, morph targets and clips, as text.
static PUPPET: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let (root, bytes) = puppet();
    embedded(root, &bytes)
});

/// Whatever moves keeps its shape, and stands at time 0 as it was read.
fn check_moving(bytes: &[u8], name: &str, options: &BodyOptions) -> Result<(), TestCaseError> {
    if let Ok(file) = parse_moving_body(bytes, name, options) {
        let body = &file.body;
        let start = body.at(0.0);
        let size = start.positions.iter().map(|position| position.length()).fold(0.0, f32::max);
        for (a, b) in start.positions.iter().zip(&body.mesh.positions) {
            prop_assert!(a.distance(*b) <= 1e-5 * (1.0 + size), "{a} {b}");
        }
        for time in [0.3, body.duration(), 1e9] {
            let mesh = body.at(time);
            prop_assert_eq!(mesh.positions.len(), body.mesh.positions.len());
            prop_assert_eq!(mesh.normals.len(), body.mesh.positions.len());
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn garbage_is_no_body(bytes in prop::collection::vec(any::<u8>(), 0..300), format in 0usize..4) {
        let (name, head): (&str, &[u8]) = [
            ("a.obj", b"v ".as_slice()),
            ("a.ply", b"ply\nformat binary_little_endian 1.0\nelement vertex "),
            ("a.glb", b"glTF\x02\0\0\0"),
            ("a.gltf", b"{\"asset\":"),
        ][format];
        check(&bytes, name, &BodyOptions::default())?;
        check(&[head, bytes.as_slice()].concat(), name, &BodyOptions::default())?;
    }

    #[test]
    fn damaged_bodies_end(which in 0usize..5, damages in damage()) {
        let (name, bytes) = &BODIES[which];
        // Damage in the first part hits header and JSON, which decide sizes.
        for within in [usize::MAX, 1200] {
            check(&damaged(bytes, within, &damages), name, &BodyOptions::default())?;
        }
    }

    #[test]
    fn damaged_clips_end(damages in damage()) {
        for within in [PUPPET.len(), 6000] {
            let bytes = damaged(&PUPPET, within, &damages);
            check(&bytes, "a.gltf", &with(BodyOptions::default(), |options| { options.clip = Some("act".into()); options.time = 0.7; }))?;
            check_moving(&bytes, "a.gltf", &BodyOptions::default())?;
        }
    }

    #[test]
    fn damaged_garments_end(damages in damage()) {
        let text = garment_text();
        let text = String::from_utf8_lossy(&damaged(text.as_bytes(), usize::MAX, &damages)).into_owned();
        if let Ok(GarmentFile { garment, .. }) = parse_garment(&text, "a.json") {
            for panel in &garment.panels {
                for edge in 0..panel.edges.len() {
                    prop_assert!(panel.polyline(edge, 1e-3).iter().all(|point| point.is_finite()));
                }
            }
        }
    }

    #[test]
    fn garments_of_any_numbers_end(numbers in prop::collection::vec(prop_oneof![any::<f64>(), -60.0..60.0f64], 6), kind in 0usize..4) {
        let [a, b, c, d, e, f] = numbers[..] else { unreachable!("six numbers") };
        let text = garment_text().replacen("[30, 40]", &format!("[{a:?}, {b:?}]"), 1);
        let curvature = match kind {
            0 => format!("[{c:?}, {d:?}]"),
            1 => format!("{{\"type\": \"cubic\", \"params\": [[{c:?}, {d:?}], [{e:?}, {f:?}]]}}"),
            2 => format!("{{\"type\": \"circle\", \"params\": [{c:?}, 1, 0]}}"),
            _ => format!("{{\"type\": \"circle\", \"params\": [{c:?}, 0, 1]}}"),
        };
        let text = text.replacen("[0, 1]}", &format!("[0, 1], \"curvature\": {curvature}}}"), 1);
        let text = text.replace("inf", "Infinity");
        if let Ok(GarmentFile { garment, .. }) = parse_garment(&text, "a.json") {
            let points = garment.panels[0].polyline(0, 1e-3);
            prop_assert!(points.iter().all(|point| point.is_finite() && point.length() < 20.0));
        }
    }
}

proptest! {
    // Each case reads 860 kB.
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_damaged_skin_ends(damages in damage()) {
        let mut options = BodyOptions::default(); options.clip = Some("walk_loop".into()); options.time = 0.3;
        check(&damaged(&WALKER, 40_000, &damages), "a.glb", &options)?;
        check(&damaged(&WALKER, usize::MAX, &damages), "a.glb", &options)?;
        check_moving(&damaged(&WALKER, usize::MAX, &damages), "a.glb", &options)?;
    }

    #[test]
    fn damaged_scenes_end(damages in damage()) {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("scene.toml");
        for name in ["hang", "moving-ball"] {
            let text = fs::read(fixture(&format!("scenes/{name}.toml"))).expect("the fixture");
            fs::write(&path, damaged(&text, usize::MAX, &damages)).expect("a file");
            if let Ok(file) = read_scene(&path, &[]) {
                prop_assert!(file.frames > 0);
            }
        }
    }
}

#[test]
fn files_that_ask_for_endless_work_end() {
    let nodes: Vec<String> = (0..50_000).map(|node| format!("{{\"children\": [{}]}}", node + 1)).collect();
    let chain = format!(
        "{{\"asset\": {{\"version\": \"2.0\"}}, \"scenes\": [{{\"nodes\": [0]}}], \"nodes\": [{}, {{}}]}}",
        nodes.join(", ")
    );
    let error = parse_body(chain.as_bytes(), "a.gltf", &BodyOptions::default()).expect_err("no triangle");
    assert_eq!(
        error.to_string(),
        "a.gltf: the body is empty: it has 0 vertices and no triangle; export the mesh with its faces"
    );

    let count = 100_000;
    let corners: Vec<String> = (0..count).map(|i| format!("[{}, {}]", i % 2, i as f64 * 1e-4)).collect();
    let edges: Vec<String> = (0..count).map(|i| format!("{{\"endpoints\": [{i}, {}]}}", (i + 1) % count)).collect();
    let zigzag = format!(
        "{{\"pattern\": {{\"panels\": {{\"saw\": {{\"translation\": [0, 0, 0], \"rotation\": [0, 0, 0], \"vertices\": [{}], \
         \"edges\": [{}]}}}}, \"stitches\": []}}, \"properties\": {{\"units_in_meter\": 100}}}}",
        corners.join(", "),
        edges.join(", ")
    );
    let error = parse_garment(&zigzag, "a.json").expect_err("too many edges");
    assert_eq!(error.to_string(), "a.json, panel \"saw\": an outline of more than 2048 edges cannot be read");
}
