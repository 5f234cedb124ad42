//! Motion that is written reads back the same, and motion that cannot be written leaves no file.

use glam::Vec3;
use std::fs;
use std::path::Path;
use toile_files::{Fault, FileError, NamedMotion, Place, write_pc2, write_usda};

const FRAMES: usize = 5;
const SQUARE: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// Corners of a square that turns and sinks; coordinates with all digits that an f32 has, large and tiny ones among them.
fn square(frame: usize) -> Vec<Vec3> {
    let (sine, cosine) = (0.1 + frame as f32 * 0.37).sin_cos();
    let sunk = -(frame as f32) / 3.0;
    vec![
        Vec3::new(cosine, sunk, sine),
        Vec3::new(-sine, sunk, cosine * 1e-30),
        Vec3::new(-cosine, sunk - 1e20, -sine),
        Vec3::new(sine, sunk, -cosine / 7.0),
    ]
}

fn normals(frame: usize) -> Vec<Vec3> {
    square(frame).iter().map(|p| Vec3::new(p.z, 0.3, p.x).normalize()).collect()
}

fn triangle(frame: usize) -> Vec<Vec3> {
    square(frame).into_iter().take(3).map(|p| p * Vec3::new(1.0, 0.0, 2.0)).collect()
}

fn shapes(mesh: usize, frame: usize) -> Result<[Vec<Vec3>; 2], FileError> {
    let positions = if mesh == 1 { triangle(frame) } else { square(frame) };
    let normals = normals(frame)[..positions.len()].to_vec();
    Ok([positions, normals])
}

fn named<'a>(name: &'a str, triangles: &'a [[u32; 3]]) -> NamedMotion<'a> {
    NamedMotion { name, triangles, colour: [0.25, 0.5, 0.75] }
}

/// The text between the first `start` and the `end` after it.
fn between<'a>(text: &'a str, start: &str, end: &str) -> &'a str {
    let from = text.find(start).unwrap_or_else(|| panic!("{start} is not in {text}")) + start.len();
    let length = text[from..].find(end).unwrap_or_else(|| panic!("no {end} after {start}"));
    &text[from..from + length]
}

/// Time codes and vectors of an attribute.
fn samples(mesh: &str, attribute: &str) -> Vec<(usize, Vec<Vec3>)> {
    let block = between(mesh, &format!("{attribute}.timeSamples = {{\n"), "        }\n");
    let sample = |line: &str| {
        let (time, list) = line.trim().strip_suffix(',').expect("a comma").split_once(": ").expect("a sample");
        let list = list.strip_prefix("[(").and_then(|list| list.strip_suffix(")]")).expect("a list");
        let vector = |text: &str| {
            let numbers: Vec<f32> = text.split(", ").map(|number| number.parse().expect("a number")).collect();
            Vec3::from_slice(&numbers)
        };
        (time.parse().expect("a time"), list.split("), (").map(vector).collect())
    };
    block.lines().map(sample).collect()
}

#[test]
fn usd_text_holds_every_frame_of_every_mesh() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("motion.usda");
    let meshes = [named("skirt", &SQUARE), named("2. \"hem\"", &SQUARE[..1])];
    let mut asked = Vec::new();
    write_usda(&path, &meshes, FRAMES, 23.976, |mesh, frame| {
        asked.push((mesh, frame));
        shapes(mesh, frame)
    })
    .expect("a file");
    let once: Vec<_> = (0..2).flat_map(|mesh| (0..FRAMES).map(move |frame| (mesh, frame))).collect();
    assert_eq!(asked, once);

    let text = fs::read_to_string(&path).expect("the file");
    assert!(text.starts_with("#usda 1.0\n(\n"));
    let stage: Vec<&str> = between(&text, "(\n", ")\n").lines().map(str::trim).collect();
    let expected = [
        "defaultPrim = \"World\"",
        "endTimeCode = 4",
        "framesPerSecond = 23.976",
        "metersPerUnit = 1",
        "startTimeCode = 0",
        "timeCodesPerSecond = 23.976",
        "upAxis = \"Y\"",
    ];
    assert_eq!(stage, expected);
    for bracket in ["()", "[]", "{}"] {
        let [open, close] = [&bracket[..1], &bracket[1..]].map(|one| text.matches(one).count());
        assert_eq!(open, close, "{bracket}");
    }
    let parts: Vec<&str> = text.split("def Mesh ").skip(1).collect();
    assert_eq!(parts.len(), 2);
    for (index, (part, name)) in parts.iter().zip(["\"skirt\"\n", "\"_2___hem_\"\n"]).enumerate() {
        assert!(part.starts_with(name), "{part}");
        let triangles = meshes[index].triangles;
        assert_eq!(between(part, "faceVertexCounts = [", "]").matches('3').count(), triangles.len());
        let indices = between(part, "faceVertexIndices = [", "]").split(", ").map(|index| index.parse().expect("one"));
        assert_eq!(indices.collect::<Vec<u32>>(), triangles.concat());
        assert_eq!(between(part, "displayColor = [(", ")]"), "0.25, 0.5, 0.75");
        for line in ["uniform token subdivisionScheme = \"none\"", "uniform bool doubleSided = 1"] {
            assert!(part.contains(line), "{line}");
        }
        assert_eq!(between(part, "normal3f[] normals (", ")").trim(), "interpolation = \"vertex\"");
        let [points, normals, extents] =
            ["point3f[] points", "normal3f[] normals", "float3[] extent"].map(|attribute| samples(part, attribute));
        assert_eq!([points.len(), normals.len(), extents.len()], [FRAMES; 3]);
        for frame in 0..FRAMES {
            let [positions, expected_normals] = shapes(index, frame).expect("a frame");
            assert_eq!(normals[frame], (frame, expected_normals));
            let (time, extent) = &extents[frame];
            assert_eq!(*time, frame);
            assert_eq!(extent.len(), 2);
            for axis in 0..3 {
                let along = || positions.iter().map(|p| p[axis]);
                assert_eq!(extent[0][axis], along().fold(f32::MAX, f32::min));
                assert_eq!(extent[1][axis], along().fold(f32::MIN, f32::max));
            }
            assert_eq!(points[frame], (frame, positions));
        }
    }
}

#[test]
fn usd_names_are_allowed_and_unique() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("motion.usda");
    let given = ["hem", "hem", "hem_2", "", "7", "jupe évasée", "hem"];
    let meshes = given.map(|name| named(name, &SQUARE));
    write_usda(&path, &meshes, 1, 60.0, |_, frame| shapes(0, frame)).expect("a file");
    let text = fs::read_to_string(&path).expect("the file");
    let names: Vec<&str> = text.split("def Mesh \"").skip(1).map(|part| between(part, "", "\"")).collect();
    assert_eq!(names, ["hem", "hem_2", "hem_2_2", "_", "_7", "jupe__vas_e", "hem_3"]);
}

#[test]
fn a_point_cache_holds_every_frame() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("skirt.pc2");
    write_pc2(&path, FRAMES, |frame| Ok(square(frame))).expect("a file");
    let bytes = fs::read(&path).expect("the file");
    assert_eq!(bytes.len(), 32 + FRAMES * 4 * 12);
    assert_eq!(&bytes[..12], b"POINTCACHE2\0");
    let word = |at: usize| [bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]];
    assert_eq!([12, 16, 28].map(|at| i32::from_le_bytes(word(at))), [1, 4, FRAMES as i32]);
    assert_eq!([20, 24].map(|at| f32::from_le_bytes(word(at))), [0.0, 1.0]);
    let read: Vec<f32> = (32..bytes.len()).step_by(4).map(|at| f32::from_le_bytes(word(at))).collect();
    let written: Vec<f32> = (0..FRAMES).flat_map(square).flat_map(|p| p.to_array()).collect();
    assert_eq!(read, written);
}

/// The error of a write, without the folder.
fn refusal(write: impl FnOnce(&Path) -> Result<(), FileError>) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("motion");
    fs::write(&path, "before").expect("a file");
    let error = write(&path).expect_err("a refusal").to_string();
    assert_eq!(fs::read(&path).expect("the file"), b"before");
    assert_eq!(fs::read_dir(folder.path()).expect("the folder").count(), 1, "{error}");
    error.replace(&format!("{}/", folder.path().display()), "")
}

fn usda_refusal(triangles: &[[u32; 3]], change: impl Fn(usize, &mut [Vec<Vec3>; 2])) -> String {
    refusal(|path| {
        write_usda(path, &[named("skirt", triangles)], FRAMES, 60.0, |mesh, frame| {
            let mut shape = shapes(mesh, frame)?;
            change(frame, &mut shape);
            Ok(shape)
        })
    })
}

#[test]
fn usd_text_is_refused_with_mesh_frame_and_vertex() {
    let unchanged = |_: usize, _: &mut [Vec<Vec3>; 2]| ();
    let no_frame = refusal(|path| write_usda(path, &[], 0, 60.0, shapes));
    assert_eq!(no_frame, "motion: there is no frame to write");
    let no_rate = refusal(|path| write_usda(path, &[], 1, f64::NAN, shapes));
    assert_eq!(no_rate, "motion: the frame rate is NaN and must be above 0");
    assert_eq!(usda_refusal(&[], unchanged), "motion: mesh \"skirt\" has no triangle to write");
    assert_eq!(usda_refusal(&[[0, 1, 4]], unchanged), "motion: vertex 4 does not exist: there are 4");
    let position = usda_refusal(&SQUARE, |frame, [positions, _]| {
        if frame == 3 {
            positions[2].z = f32::NAN;
        }
    });
    assert_eq!(position, "motion: position 2 of mesh \"skirt\" in frame 3 is not a finite number");
    let normal = usda_refusal(&SQUARE, |frame, [_, normals]| {
        if frame == 4 {
            normals[1].x = f32::INFINITY;
        }
    });
    assert_eq!(normal, "motion: normal 1 of mesh \"skirt\" in frame 4 is not a finite number");
    let same = "and its frame 0 has 4 positions: they must be the same";
    let shorter = usda_refusal(&SQUARE, |frame, [positions, _]| positions.truncate(if frame == 2 { 3 } else { 4 }));
    assert_eq!(shorter, format!("motion: frame 2 of mesh \"skirt\" has 3 positions, {same}"));
    let fewer = usda_refusal(&SQUARE, |_, [_, normals]| normals.truncate(1));
    assert_eq!(fewer, format!("motion: frame 0 of mesh \"skirt\" has 1 normals, {same}"));
    let colour = NamedMotion { colour: [0.0, f32::NAN, 0.0], ..named("skirt", &SQUARE) };
    let colour = refusal(|path| write_usda(path, &[colour], 1, 60.0, shapes));
    assert_eq!(colour, "motion: the colour of mesh \"skirt\" is not a finite number");
}

#[test]
fn a_point_cache_is_refused_with_frame_and_vertex() {
    assert_eq!(refusal(|path| write_pc2(path, 0, |_| Ok(vec![]))), "motion: there is no frame to write");
    assert_eq!(refusal(|path| write_pc2(path, 2, |_| Ok(vec![]))), "motion: the mesh has no vertex to write");
    let longer = refusal(|path| write_pc2(path, 3, |frame| Ok(vec![Vec3::ONE; 2 + frame])));
    assert_eq!(longer, "motion: frame 1 has 3 vertices, and frame 0 has 2: they must be the same");
    let broken = refusal(|path| {
        write_pc2(path, FRAMES, |frame| {
            let mut positions = square(frame);
            positions[3].x /= if frame == 4 { 0.0 } else { 1.0 };
            Ok(positions)
        })
    });
    assert_eq!(broken, "motion: position 3 of frame 4 is not a finite number");
}

#[test]
fn an_error_of_the_source_is_handed_on() {
    let lost = || {
        let fault = Box::new(Fault::Malformed("it is gone".into()));
        FileError { path: "frames.bin".into(), place: Place::Byte(7), fault }
    };
    let expected = "frames.bin, byte 7: it is gone";
    assert_eq!(refusal(|path| write_pc2(path, 1, |_| Err(lost()))), expected);
    let skirt = named("skirt", &SQUARE);
    assert_eq!(refusal(|path| write_usda(path, &[skirt], 1, 60.0, |_, _| Err(lost()))), expected);
}
