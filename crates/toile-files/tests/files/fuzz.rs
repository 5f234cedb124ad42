//! Every reader on damaged files of its own kind: none panics, hangs, or takes memory that the file does not warrant.

use crate::compressed::{draco_gltf, meshopt_gltfs};
use crate::gltf_bodies::{animated, embedded, glb};
use crate::moving::puppet;
use crate::support::{ellipsoid, fixture, garment_text, obj_text, ply_bytes};
use fastrand::Rng;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};
use toile_files::{BodyOptions, parse_body, parse_garment, parse_moving_body, read_fabric, read_scene};

/// No file may take longer. What is read here takes milliseconds.
const LONGEST: Duration = Duration::from_secs(10);

/// Memory that every read may take [bytes], and times its size beyond.
const MEMORY: usize = 64 << 20;
const MEMORY_PER_BYTE: usize = 10;

/// A reader, with valid files to damage.
struct Reader {
    name: &'static str,
    seeds: Vec<Vec<u8>>,
    read: fn(&[u8], &Path),
}

fn body(bytes: &[u8], name: &str) {
    for clip in [None, Some("act".to_owned()), Some("move".to_owned())] {
        if clip.is_some() && !name.ends_with('b') && !name.ends_with('f') {
            continue;
        }
        let mut options = BodyOptions::default();
        options.clip = clip;
        options.time = 0.0;
        if let Ok(file) = parse_body(bytes, name, &options) {
            assert!(!file.mesh.triangles.is_empty());
            assert!(file.mesh.positions.iter().chain(&file.mesh.normals).all(|vector| vector.is_finite()));
            assert!(file.mesh.triangles.iter().flatten().all(|at| (*at as usize) < file.mesh.positions.len()));
        }
    }
}

fn moving(bytes: &[u8], name: &str) {
    if let Ok(file) = parse_moving_body(bytes, name, &BodyOptions::default()) {
        let mesh = file.body.at(0.5 * file.body.duration());
        assert_eq!(mesh.positions.len(), file.body.mesh.positions.len());
    }
}

fn readers() -> Vec<Reader> {
    let mesh = ellipsoid();
    let small = obj_text(&mesh);
    let more = format!("mtllib a.mtl\ng a\n{}\nvn 0 1 0\nf 1//1 2//-1 \\\n3//1\nl 1 2\n", small.replace('\n', "\r\n"));
    let ascii =
        b"ply\nformat ascii 1.0\ncomment a\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        property uchar red\nelement face 2\nproperty list uchar int vertex_indices\nelement tristrips 1\n\
        property list int int vertex_indices\nelement other 1\nproperty list uchar float a\nend_header\n\
        0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n3 0 1 2\n4 0 1 2 3\n5 0 1 2 -1 3\n2 0.5 0.5\n"
            .to_vec();
    let (puppet_root, puppet_bytes) = puppet();
    let (animated_root, animated_bytes) = animated("CUBICSPLINE");
    let text = |name: &str| fs::read(fixture(name)).expect("the fixture");
    vec![
        Reader {
            name: "obj",
            seeds: vec![small.into_bytes(), more.into_bytes()],
            read: |bytes, _| body(bytes, "a.obj"),
        },
        Reader {
            name: "ply",
            seeds: vec![ply_bytes(&mesh, false), ply_bytes(&mesh, true), ascii],
            read: |bytes, _| body(bytes, "a.ply"),
        },
        Reader {
            name: "gltf",
            seeds: vec![embedded(puppet_root.clone(), &puppet_bytes), embedded(animated_root.clone(), &animated_bytes)],
            read: |bytes, _| {
                body(bytes, "a.gltf");
                moving(bytes, "a.gltf");
            },
        },
        Reader {
            name: "glb",
            seeds: vec![
                glb(&puppet_root, &puppet_bytes, b' ', &[]),
                glb(&animated_root, &animated_bytes, 0, &[(b"MORE", b"1234")]),
            ],
            read: |bytes, _| {
                body(bytes, "a.glb");
                moving(bytes, "a.glb");
            },
        },
        Reader {
            name: "draco",
            seeds: [(0, 0), (1, 3), (1, 7), (1, 10)]
                .map(|(method, level)| draco_gltf(method, level))
                .map(|(root, bytes)| glb(&root, &bytes, b' ', &[]))
                .to_vec(),
            read: |bytes, _| body(bytes, "a.glb"),
        },
        Reader {
            name: "meshopt",
            seeds: meshopt_gltfs().iter().map(|(root, bytes, _)| glb(root, bytes, b' ', &[])).collect(),
            read: |bytes, _| body(bytes, "a.glb"),
        },
        Reader {
            name: "garment",
            seeds: vec![garment_text().into_bytes(), text("garments/circle_skirt.json"), text("garments/skirt.json")],
            read: |bytes, _| {
                if let Ok(file) = parse_garment(&String::from_utf8_lossy(bytes), "a.json") {
                    for panel in &file.garment.panels {
                        let points = (0..panel.edges.len()).flat_map(|edge| panel.polyline(edge, 1e-3));
                        points.for_each(|point| assert!(point.is_finite()));
                    }
                }
            },
        },
        Reader {
            name: "scene",
            seeds: ["hang", "ball", "moving-ball"].map(|name| text(&format!("scenes/{name}.toml"))).to_vec(),
            read: |bytes, folder| {
                let path = folder.join("scene.toml");
                fs::write(&path, bytes).expect("a file");
                if let Ok(file) = read_scene(&path, &[]) {
                    assert!(file.frames > 0);
                }
            },
        },
        Reader {
            name: "fabric",
            seeds: vec![
                b"base = \"cotton\"\nareal_density = 0.22\nstructural_stiffness = 30\nbending_rigidity = 2e-5\n\
                  thickness = 0.004\nthreshold = { warp = 0.02, weft = 0.03, shear = 0.1 }\n"
                    .to_vec(),
            ],
            read: |bytes, folder| {
                let path = folder.join("fabric.toml");
                fs::write(&path, bytes).expect("a file");
                let _ = read_fabric(&path);
            },
        },
    ]
}

/// Words that decide sizes and kinds.
const WORDS: [&str; 28] = [
    "-1",
    "0",
    "1",
    "99999999999",
    "4294967295",
    "1e400",
    "-1e38",
    "1e-45",
    "nan",
    "null",
    "true",
    "\"",
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\\\n",
    "\r",
    "\u{feff}",
    "{}",
    "[]",
    "[[0]]",
    "element vertex 4000000000\n",
    "f 1 2 3\n",
    "\"extensions\": {},",
    "\"count\": 16777216,",
];

/// A file with some bytes, numbers, words and stretches changed, by another file of its kind or by itself.
fn damaged(seeds: &[Vec<u8>], rng: &mut Rng) -> Vec<u8> {
    let mut bytes = rng.choice(seeds).expect("a seed").clone();
    for _ in 0..1 << rng.u32(0..5) {
        if bytes.is_empty() {
            break;
        }
        // The first part has the header or the JSON, which decide sizes.
        let end = if rng.bool() { bytes.len() } else { bytes.len().min(2000) };
        let at = rng.usize(0..end);
        let length = rng.usize(1..40).min(bytes.len() - at);
        match rng.u32(0..10) {
            0 => bytes[at] = rng.u8(..),
            1 => bytes[at] ^= 1 << rng.u32(0..8),
            2 => {
                let word = [0, 1, u32::MAX, 1 << 31, 0x7f80_0000, 0x7f7f_ffff, rng.u32(..)][rng.usize(0..7)];
                let length = length.min(4);
                bytes[at..at + length].copy_from_slice(&word.to_le_bytes()[..length]);
            }
            3 => drop(bytes.drain(at..at + length)),
            4 => bytes.truncate(at),
            5 => drop(bytes.splice(at..at, WORDS[rng.usize(0..WORDS.len())].bytes())),
            6 => {
                let other = rng.choice(seeds).expect("a seed");
                let from = rng.usize(0..other.len());
                let part = other[from..(from + length * 8).min(other.len())].to_vec();
                drop(bytes.splice(at..at + length, part));
            }
            7 => {
                let part = bytes[at..at + length].to_vec();
                drop(bytes.splice(at..at, part));
            }
            8 => {
                // The number at the place, or the next one, becomes another.
                let is_digit = |byte: &u8| byte.is_ascii_digit();
                if let Some(start) = bytes[at..].iter().position(is_digit).map(|start| at + start) {
                    let width = bytes[start..].iter().take_while(|byte| is_digit(byte)).count();
                    drop(bytes.splice(start..start + width, WORDS[rng.usize(0..8)].bytes()));
                }
            }
            _ => bytes[at..at + length].fill(rng.u8(..)),
        }
    }
    bytes
}

/// The largest memory that the process has had [bytes], where the system tells it.
fn peak() -> Option<usize> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix(" kB")?.trim().parse::<usize>().ok()? << 10)
}

/// Memory is that of the whole process, so it is held only where nothing else runs.
fn fuzz(count: u64, seed: u64, is_alone: bool) {
    let folder = tempfile::tempdir().expect("a folder");
    let mut readers = readers();
    let only = std::env::var("FUZZ_READER").ok();
    readers.retain(|reader| only.as_ref().is_none_or(|only| only == reader.name));
    for Reader { name, seeds, read } in &readers {
        let mut longest = Duration::ZERO;
        let before = peak();
        for number in 0..count {
            let bytes = damaged(seeds, &mut Rng::with_seed(seed ^ (number << 8)));
            let start = Instant::now();
            read(&bytes, folder.path());
            let time = start.elapsed();
            assert!(time < LONGEST, "{name} {number} takes {time:?}");
            longest = longest.max(time);
        }
        let size = seeds.iter().map(Vec::len).max().unwrap_or_default();
        if let (true, Some(before), Some(after)) = (is_alone, before, peak()) {
            println!("{name}: {count} inputs, the longest {longest:?}, {} MB more", (after - before) >> 20);
            assert!(after - before <= MEMORY + 2 * MEMORY_PER_BYTE * size, "{name} takes {} bytes", after - before);
        }
    }
}

#[test]
fn damaged_files_of_every_reader_end() {
    fuzz(400, 1, false);
}

#[test]
#[ignore = "a million damaged files of each of nine readers take an hour; FUZZ_READER names one"]
fn a_million_damaged_files_of_every_reader_end() {
    fuzz(1_000_000, 3, true);
}
