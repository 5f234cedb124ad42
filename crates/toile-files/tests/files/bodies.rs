//! OBJ and PLY bodies: formats, repairs, warnings and places of errors.

use crate::support::{ellipsoid, obj_text, ply_bytes};
use glam::Vec3;
use toile_files::{BodyFile, BodyOptions, Fault, Place, parse_body};
use toile_scene::Mesh;

fn read(bytes: impl AsRef<[u8]>, name: &str) -> BodyFile {
    parse_body(bytes.as_ref(), name, &BodyOptions::default()).expect("a readable body")
}

fn refusal(bytes: impl AsRef<[u8]>, name: &str) -> String {
    parse_body(bytes.as_ref(), name, &BodyOptions::default()).expect_err("a refusal").to_string()
}

fn assert_same(mesh: &Mesh, expected: &Mesh) {
    assert_eq!(mesh.positions, expected.positions);
    assert_eq!(mesh.triangles, expected.triangles);
    for (normal, expected) in mesh.normals.iter().zip(&expected.normals) {
        assert!(normal.distance(*expected) < 1e-6);
    }
}

#[test]
fn every_format_gives_the_same_mesh() {
    let mesh = ellipsoid();
    let obj = obj_text(&mesh);
    let ascii: String = obj
        .lines()
        .map(|line| match line.split_once(' ').expect("a keyword") {
            ("v", rest) => format!("{rest}\n"),
            (_, rest) => {
                let zero_based = rest.split(' ').map(|i| (i.parse::<u32>().expect("an index") - 1).to_string());
                format!("3 {}\n", zero_based.collect::<Vec<_>>().join(" "))
            }
        })
        .collect();
    let header = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_index\nend_header\n",
        mesh.positions.len(),
        mesh.triangles.len()
    );
    for body in [
        read(&obj, "a.obj"),
        read(obj.replace('\n', "\r\n"), "a.OBJ"),
        read(header + &ascii, "a.ply"),
        read(ply_bytes(&mesh, false), "a.ply"),
        read(ply_bytes(&mesh, true), "a.ply"),
    ] {
        assert_same(&body.mesh, &mesh);
        assert_eq!(body.warnings, [] as [&str; 0]);
    }
}

#[test]
fn polygons_become_fans_and_indices_may_count_backwards() {
    let cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf -6 -5 -1 -2 # backwards\nf 1 5 8 4\nf 2/1 3/2 7/3 6/4\n";
    let body = read(cube, "cube.obj");
    assert_eq!((body.mesh.positions.len(), body.mesh.triangles.len()), (8, 12));
    assert_eq!(body.warnings, [] as [&str; 0]);
    assert!((body.mesh.signed_volume() - 1.0).abs() < 1e-9);
}

#[test]
fn seams_are_welded_and_inward_faces_turned() {
    let mesh = ellipsoid();
    let mut split = Mesh::default();
    for triangle in &mesh.triangles {
        let first = split.positions.len() as u32;
        split.positions.extend(triangle.map(|i| mesh.positions[i as usize]));
        split.triangles.push([first, first + 2, first + 1]);
    }
    let body = read(obj_text(&split), "split.obj");
    assert_eq!(body.mesh.positions.len(), mesh.positions.len());
    assert!(body.mesh.signed_volume() > 0.0);
    assert_eq!(body.warnings, ["triangles that faced inward turned over: 216"]);
    for (position, normal) in body.mesh.positions.iter().zip(&body.mesh.normals) {
        let outward = *position - glam::vec3(0.0, 0.8, 0.0);
        assert!(normal.dot(outward) > 0.0);
    }
}

#[test]
fn a_scan_with_every_defect_works_and_says_what_it_has() {
    let mut mesh = ellipsoid();
    let last = mesh.positions.len() as u32;
    mesh.triangles.remove(40);
    let [a, b, c] = mesh.triangles[10];
    mesh.triangles.push([a, b, c]);
    mesh.triangles.push([a, a, b]);
    // A fin on the edge a-b, and a stray point.
    mesh.positions.push(glam::vec3(0.0, 1.7, 0.3));
    mesh.positions.push(glam::vec3(5.0, 50.0, 5.0));
    mesh.triangles.push([a, b, last]);
    let body = read(obj_text(&mesh), "scan.obj");
    assert_eq!(body.mesh.triangles.len(), 216);
    insta::assert_snapshot!(body.warnings.join("\n"), @r#"
    degenerate triangles removed: 1
    duplicated triangles removed: 1
    isolated vertices removed: 1
    boundary edges (the body has holes): 5
    non-manifold edges (shared by more than two triangles): 1
    "#);
}

#[test]
fn noise_alone_is_no_fault() {
    let mut mesh = ellipsoid();
    for (i, position) in mesh.positions.iter_mut().enumerate() {
        *position += 0.003 * glam::vec3((i as f32).sin(), (i as f32 * 1.7).cos(), (i as f32 * 2.3).sin());
    }
    let body = read(obj_text(&mesh), "noise.obj");
    assert_eq!(body.warnings, [] as [&str; 0]);
}

#[test]
fn given_normals_are_kept_where_they_are_usable() {
    let mesh = ellipsoid();
    let tilted = glam::vec3(0.1, 1.0, 0.0).normalize();
    let mut text = obj_text(&mesh).replace("f 1 ", "f 1//1 ").replace("f 110 ", "f 110//2 ");
    text.insert_str(0, "vn 0.2 2 0\nvn nan 0 0\n");
    let body = read(&text, "normals.obj");
    assert!(body.mesh.normals[0].distance(tilted) < 1e-6);
    assert!(body.mesh.normals[1].distance(mesh.normals[1]) < 1e-6);
    assert!(body.mesh.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-6));
    assert_eq!(body.warnings, ["normals replaced (missing, not finite or against the winding): 109"]);
}

#[test]
fn obj_errors_name_the_line() {
    let mesh = obj_text(&ellipsoid());
    let cases = [
        "v 0 0".to_string(),
        "v 0 zero 0".into(),
        "v 0 1e60 0".into(),
        format!("{mesh}f 1 2 999\nf 1 2 1000\n"),
        format!("{mesh}f 1 2 0\n"),
        format!("{mesh}f 1 -900 2\n"),
        format!("{mesh}f 1 2\n"),
        format!("{mesh}f 1 2 x\n"),
        format!("{mesh}f 1//7 2 3\n"),
        mesh.replacen('.', ",", 1),
        format!("v -nan(ind) 0 0\n{mesh}"),
        mesh.replace('\n', "\r").replacen("v 0 1.6 0", "v 0 \\\r1.6 zero", 1),
    ];
    let messages: Vec<String> = cases.iter().map(|text| refusal(text, "a.obj")).collect();
    insta::assert_snapshot!(messages.join("\n"), @r#"
    a.obj, line 1: a vertex needs three numbers
    a.obj, line 1: "zero" is not a number
    a.obj, line 1: the position (0.0, 1e60, 0.0) is not a finite number
    a.obj, line 328: vertex 1000 does not exist: there are 110
    a.obj, line 327: vertex 0 does not exist: there are 110
    a.obj, line 327: vertex -900 does not exist: there are 110
    a.obj, line 327: a face has 2 corners, it needs 3
    a.obj, line 327: "x" is not an index
    a.obj, line 327: normal 7 does not exist: there are 0
    a.obj, line 1: "1,6" has a decimal comma: export it with decimal points
    a.obj, line 1: the position (NaN, 0.0, 0.0) is not a finite number
    a.obj, line 1: "zero" is not a number
    "#);
}

#[test]
fn ply_errors_name_line_byte_or_row() {
    let head = |format: &str, rest: &str| format!("ply\nformat {format} 1.0\n{rest}");
    let vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    let face = "element face 1\nproperty list char int vertex_indices\nend_header\n";
    let cases = [
        "plz\n".to_string(),
        "ply\nelement vertex many\n".into(),
        "ply\nformat ascii 1.0\nproperty float x\n".into(),
        head("middle_endian", ""),
        head("ascii", "element vertex 1\nproperty quad x\n"),
        head("ascii", vertex),
        head("ascii", &format!("element vertex 1\nproperty float x\n{face}1 2 3")),
        head("ascii", &format!("{vertex}{face}0 0 nan\n3 0 0 0\n")),
        head("ascii", &format!("{vertex}{face}0 0 up\n3 0 0 0\n")),
        head("ascii", &format!("{vertex}{face}0 0 0\n3 0 0 7\n")),
        head("ascii", &format!("{vertex}{face}0 0 0\n3 0 0 -1\n")),
        head("ascii", &format!("{vertex}{face}0 0 0\n99 0 0 0\n")),
        head("ascii", &format!("{vertex}{face}0 0 0\n-2 0 0 0\n")),
        head("ascii", &format!("{vertex}{face}0 0 0\n2 0 0\n")),
        head("binary_little_endian", &format!("{vertex}{face}\0\0\0\0\0\0\0\0\0\0\0\0\u{7}\0")),
    ];
    let messages: Vec<String> = cases.iter().map(|text| refusal(text, "a.ply")).collect();
    insta::assert_snapshot!(messages.join("\n"), @r#"
    a.ply, line 1: a PLY file starts with the line "ply"
    a.ply, line 2: "many" is not a number of rows
    a.ply, line 3: a property before any element
    a.ply, line 2: the format "middle_endian" is not known
    a.ply, line 4: the type "quad" is not known
    a.ply, byte 89: the header has no line "end_header"
    a.ply: the element vertex has no number "y"
    a.ply, vertex 0: the position (0.0, 0.0, NaN) is not a finite number
    a.ply, line 10: "up" is not a number
    a.ply, face 0: vertex 7 does not exist: there are 1
    a.ply, face 0: -1 is not a vertex index
    a.ply, line 11: a list of 99 numbers needs 197 bytes, but the file has only 7 left: it is truncated or damaged
    a.ply, line 11: -2 is not a length of the list "vertex_indices"
    a.ply, face 0: it has 2 corners, it needs 3
    a.ply, byte 181: a list of 7 numbers needs 27 bytes, but the file has only 1 left: it is truncated or damaged
    "#);
}

#[test]
fn the_units_message_names_the_unit_that_helps() {
    let scaled = |factor: f32| {
        let mut mesh = ellipsoid();
        mesh.positions.iter_mut().for_each(|position| *position *= factor);
        obj_text(&mesh)
    };
    let cases = [scaled(1000.0), scaled(100.0), scaled(0.01), scaled(1e6)];
    let messages: Vec<String> = cases.iter().map(|text| refusal(text, "a.obj")).collect();
    insta::assert_snapshot!(messages.join("\n"), @"
    a.obj: the body is 1600 m tall, and bodies are 0.2 m to 4 m tall: give mm as its unit if it should be 1.60 m
    a.obj: the body is 160 m tall, and bodies are 0.2 m to 4 m tall: give cm as its unit if it should be 1.60 m
    a.obj: the body is 0.0160 m tall, and bodies are 0.2 m to 4 m tall: no unit from mm to m makes it a body's size
    a.obj: the body is 1.60e6 m tall, and bodies are 0.2 m to 4 m tall: no unit from mm to m makes it a body's size
    ");
    let mut options = BodyOptions::default();
    options.metres_per_unit = 0.001;
    let error = parse_body(scaled(1.0).as_bytes(), "a.obj", &options).expect_err("1.6 mm");
    assert!(error.to_string().contains("give m as its unit"), "{error}");
}

#[test]
fn what_lies_far_from_a_body_is_refused() {
    let mut mesh = ellipsoid();
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([[1e30, 1.0, 0.0], [1e30, 1.1, 0.0], [1e30, 1.0, 0.1]].map(Vec3::from));
    mesh.normals.extend([Vec3::X; 3]);
    mesh.triangles.push([first, first + 1, first + 2]);
    let message = refusal(obj_text(&mesh), "a.obj");
    insta::assert_snapshot!(message, @"a.obj: the body is 1.00e30 m wide, and bodies are at most 10 m to the sides: remove what lies far from it");
}

#[test]
fn a_clip_or_a_time_that_there_is_none_of_is_refused() {
    let told = |clip: Option<&str>, time| {
        let mut options = BodyOptions::default();
        options.clip = clip.map(String::from);
        options.time = time;
        parse_body(obj_text(&ellipsoid()).as_bytes(), "a.obj", &options).expect_err("no clip").to_string()
    };
    insta::assert_snapshot!([told(Some("walk"), 0.0), told(None, 0.5)].join("\n"), @"
    a.obj: files of its kind have no clips: leave the clip out
    a.obj: a time is one in a clip: name the clip, or leave the time out
    ");
}

#[test]
fn faults_are_typed() {
    let error = parse_body(b"v 0 0 0\n", "a.obj", &BodyOptions::default()).expect_err("no triangle");
    assert!(matches!(*error.fault, Fault::Empty(1)));
    assert_eq!(error.place, Place::File);
    let error = parse_body(b"", "a.mesh", &BodyOptions::default()).expect_err("no such format");
    assert!(matches!(*error.fault, Fault::UnknownFormat(_)));
}

/// Bytes of a text in UTF-16, with its mark.
fn utf16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    format!("\u{feff}{text}").encode_utf16().flat_map(bytes).collect()
}

#[test]
fn obj_files_of_any_editor_and_exporter_are_the_same_mesh() {
    let mesh = ellipsoid();
    let text = obj_text(&mesh);
    let first = text.lines().next().expect("a vertex");
    let long = text.replace("f 1 ", "f\\\n 1 \\\n ").replace("v 0", "v \\\n0");
    let written: [Vec<u8>; 10] = [
        format!("\u{feff}{text}").into(),
        utf16(&text, u16::to_le_bytes),
        utf16(&text, u16::to_be_bytes),
        text.replace('\n', "\r").into(),
        format!("\u{feff}{}", text.replace('\n', "\r\n")).into(),
        long.clone().into(),
        long.replace('\n', "\r\n").into(),
        format!("# made in C:\\\n{text}").into(),
        text.replace("f ", "fo ").into(),
        text.replace(first, &format!("{first} 1.0 0.5 0.25 # top")).into(),
    ];
    for bytes in written {
        let body = read(&bytes, "a.obj");
        assert_same(&body.mesh, &mesh);
        assert_eq!(body.warnings, [] as [&str; 0], "{}", String::from_utf8_lossy(&bytes[..80]));
    }
}

#[test]
fn obj_statements_that_nothing_reads_are_told_once_by_name() {
    let text = obj_text(&ellipsoid());
    let known =
        "# by hand\nmtllib a.mtl\no body\ng skin\ns off\nusemtl skin\nvt 0 0\nvp 0 0\nl 1 2\np 1\nlod 1\nbevel on\n";
    assert_eq!(read(format!("{known}{text}"), "a.obj").warnings, [] as [&str; 0]);
    let unknown =
        format!("{text}cstype bezier\ncurv 0 1 1 2\nsurf 0 1 0 1 1 2\nend\nweight 1 0.5\nweight 2 0.5\ncall b.obj\n");
    insta::assert_snapshot!(read(unknown, "a.obj").warnings.join("\n"), @r#"
    not read: free-form curves and surfaces: export them as polygons (line 327)
    not read: the statement "weight" (line 331)
    not read: the statement "call" (line 333)
    "#);
}

/// An ASCII PLY with more lines in its header, and more behind its numbers.
fn ascii_ply(mesh: &Mesh, faces: &str) -> String {
    let positions: String = mesh.positions.iter().map(|p| format!("{} {} {}\n", p.x, p.y, p.z)).collect();
    format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n{faces}",
        mesh.positions.len()
    )
    .replace("end_header\n", &format!("end_header\n{positions}"))
}

fn ply_faces(mesh: &Mesh) -> String {
    let rows: String = mesh.triangles.iter().map(|[a, b, c]| format!("3 {a} {b} {c}\n")).collect();
    format!("element face {}\nproperty list uchar int vertex_indices\nend_header\n{rows}", mesh.triangles.len())
}

#[test]
fn ply_files_of_any_editor_and_exporter_are_the_same_mesh() {
    let mesh = ellipsoid();
    let text = ascii_ply(&mesh, &ply_faces(&mesh));
    let header_end = |bytes: &[u8]| bytes.windows(11).position(|end| end == b"end_header\n").expect("an end") + 11;
    let with_line_ends = |bytes: &[u8], end: &str| {
        let (header, numbers) = bytes.split_at(header_end(bytes));
        let header = String::from_utf8_lossy(header).replace('\n', end);
        [header.as_bytes(), numbers].concat()
    };
    let little = ply_bytes(&mesh, false);
    let big = ply_bytes(&mesh, true);
    let strips: Vec<String> = mesh.triangles.iter().map(|[a, b, c]| format!("{a} {b} {c} -1")).collect();
    let strips = format!(
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n{} {}\n",
        4 * mesh.triangles.len(),
        strips.join(" ")
    );
    let written: [Vec<u8>; 9] = [
        format!("\u{feff}{text}").into(),
        utf16(&text, u16::to_le_bytes),
        text.replace('\n', "\r").into(),
        text.replace('\n', "\r\n").into(),
        with_line_ends(&little, "\r\n"),
        with_line_ends(&little, "\r"),
        with_line_ends(&big, "\r"),
        ascii_ply(&mesh, &strips).into(),
        ascii_ply(
            &mesh,
            &strips.replace(" -1\n", "\n").replacen(
                &(4 * mesh.triangles.len()).to_string(),
                &(4 * mesh.triangles.len() - 1).to_string(),
                1,
            ),
        )
        .into(),
    ];
    for (number, bytes) in written.iter().enumerate() {
        let body = read(bytes, "a.ply");
        assert_same(&body.mesh, &mesh);
        assert_eq!(body.warnings, [] as [&str; 0], "{number}");
    }
}

#[test]
fn strips_turn_every_second_triangle() {
    let cube = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
        0 0 0\n1 0 0\n0 1 0\n0 0 1\n6 0 1 2 3 0 1\n";
    let body = read(cube, "a.ply");
    assert_eq!(body.mesh.triangles.len(), 4);
    // As they are wound they fit together; that they are inside out would be told of all four.
    assert_eq!(body.warnings, ["triangles that faced inward turned over: 4"]);
    assert!((body.mesh.signed_volume() - 1.0 / 6.0).abs() < 1e-9);
}

#[test]
fn ply_elements_and_properties_that_nothing_reads_are_told_once_by_name() {
    let mesh = ellipsoid();
    let faces = ply_faces(&mesh);
    let known = ascii_ply(&mesh, &faces)
        .replace(
            "property float z\n",
            "property float z\nproperty uchar red\nproperty float quality\nproperty float s\n",
        )
        .replace("end_header\n", "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n");
    let rows = |text: &str| -> String {
        let (header, numbers) = text.split_once("end_header\n").expect("an end");
        let numbers = numbers.lines().enumerate().map(|(row, line)| match row < mesh.positions.len() {
            true => format!("{line} 9 0.5 1\n"),
            false => format!("{line}\n"),
        });
        format!("{header}end_header\n{}", numbers.collect::<String>())
    };
    assert_eq!(read(rows(&known) + "0 1\n", "a.ply").warnings, [] as [&str; 0]);
    let unknown = known.replace("float quality", "float opacity").replace("float s\n", "float weight\n");
    let unknown = unknown.replace("element edge 1", "element cells 1");
    insta::assert_snapshot!(read(rows(&unknown) + "0 1\nmore\n", "a.ply").warnings.join("\n"), @r#"
    not read: the properties "opacity", "weight" of vertex
    not read: the element "cells"
    not read: what follows the last element (line 343)
    "#);
    let groups: String = (0..12).map(|group| format!("property float group{group}\n")).collect();
    let header = ascii_ply(&mesh, &faces).replace("property float z\n", &format!("property float z\n{groups}"));
    let (header, numbers) = header.split_once("end_header\n").expect("an end");
    let numbers = numbers.lines().enumerate().map(|(row, line)| match row < mesh.positions.len() {
        true => format!("{line} 0 0 0 0 0 0 0 0 0 0 0 1\n"),
        false => format!("{line}\n"),
    });
    let weights = format!("{header}end_header\n{}", numbers.collect::<String>());
    let told = read(weights, "a.ply").warnings;
    assert_eq!(
        told,
        [
            "not read: the properties \"group0\", \"group1\", \"group2\", \"group3\", \"group4\", \"group5\", \"group6\", \"group7\" and 4 more of vertex"
        ]
    );
    let message = refusal(ascii_ply(&mesh, &faces.replace("vertex_indices", "corners")), "a.ply");
    assert_eq!(message, "a.ply: the element face has no list \"vertex_indices\"; it has: corners");
}

#[test]
fn a_body_that_lies_or_has_z_up_has_its_length_for_a_height() {
    let lying = |turn: fn(Vec3) -> Vec3, size: f32| {
        let mut mesh = ellipsoid();
        mesh.positions.iter_mut().for_each(|position| *position = turn(*position * size));
        obj_text(&mesh)
    };
    let turns: [fn(Vec3) -> Vec3; 3] =
        [|p| glam::vec3(p.x, -p.z, p.y), |p| glam::vec3(p.y, p.x, p.z), |p| glam::vec3(p.x, 0.45 * p.z, p.y)];
    for turn in turns {
        let body = read(lying(turn, 1.0), "a.obj");
        let [low, high] = body.mesh.bounds().expect("vertices");
        assert!(((high - low).max_element() - 1.6).abs() < 1e-5);
        let told = refusal(lying(turn, 100.0), "a.obj");
        assert!(
            told.contains("is 160 m tall") && told.ends_with("give cm as its unit if it should be 1.60 m"),
            "{told}"
        );
    }
}

#[test]
fn the_floor_that_a_scan_stands_on_is_told_and_does_not_turn_it() {
    let alone = read(obj_text(&ellipsoid()), "a.obj").mesh;
    let with_sheet = |corners: [[f32; 3]; 4], turned: bool| {
        let mut mesh = ellipsoid();
        if turned {
            mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        }
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners.map(Vec3::from));
        mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        read(obj_text(&mesh), "a.obj")
    };
    let floor = [[-2.0, 0.0, -2.0], [2.0, 0.0, -2.0], [2.0, 0.0, 2.0], [-2.0, 0.0, 2.0]];
    let ceiling = floor.map(|[x, _, z]| [z, 2.5, x]);
    let wall = floor.map(|[x, _, z]| [x, z + 1.0, -1.0]);
    for sheet in [floor, ceiling, wall] {
        let body = with_sheet(sheet, false);
        assert_eq!(body.mesh, alone);
        assert_eq!(body.warnings, ["floor or backdrop left out: 1 piece of 2 triangles, the largest 4.00 m by 4.00 m"]);
        let turned = with_sheet(sheet, true);
        assert!((turned.mesh.signed_volume() - alone.signed_volume()).abs() < 1e-9);
        assert_eq!(turned.warnings[1], "triangles that faced inward turned over: 216");
    }
}

#[test]
fn what_a_glance_tells_is_told_before_what_takes_long() {
    let mesh = ellipsoid();
    // Each has a fault in its first number, too, or none of its numbers at all.
    let ply = String::from_utf8_lossy(&ply_bytes(&mesh, false)[..200]).replace("vertex 110", "vertex 110000000");
    let glb = |json: &str| {
        let json = format!("{json}{}", " ".repeat(json.len().next_multiple_of(4) - json.len()));
        let sizes = [2, 20 + json.len() as u32, json.len() as u32].map(u32::to_le_bytes);
        [b"glTF".as_slice(), &sizes.concat(), b"JSON", json.as_bytes()].concat()
    };
    let nothing =
        r#""buffers": [{ "byteLength": 400000000 }], "bufferViews": [{ "buffer": 0, "byteLength": 400000000 }]"#;
    let told = [
        refusal(ply, "a.ply"),
        refusal(&glb("{}")[..18], "a.glb"),
        refusal(glb(&format!(r#"{{ "asset": {{ "version": "1.0" }}, {nothing} }}"#)), "a.glb"),
        refusal(glb(&format!(r#"{{ "extensionsRequired": ["EXT_mesh_polygon"], {nothing} }}"#)), "a.glb"),
        refusal([b"PXR-USDC".as_slice(), obj_text(&mesh).as_bytes()].concat(), "a.obj"),
    ];
    insta::assert_snapshot!(told.join("\n"), @r#"
    a.ply, byte 198: element vertex with 110000000 rows needs 1430000000 bytes, but the file has only 14 left: it is truncated or damaged
    a.glb, byte 0: the GLB file by its header needs 24 bytes, but the file has only 18 left: it is truncated or damaged
    a.glb, key "asset.version": it is glTF 1.0: export it as glTF 2.0
    a.glb: the file needs the extension EXT_mesh_polygon, which is not read: export triangles
    a.obj: it is USD, which is not read: export the body as GLB from the program that wrote it, or import it into Blender and export glTF 2.0
    "#);
}
