//! GarmentCode files: every form of edge and stitch, and the sentence of each fault.

use crate::support::garment_text;
use glam::{DVec2, DVec3, dvec2, dvec3};
use std::fs;
use toile_files::{parse_garment, read_garment};
use toile_scene::{Curve, EdgeRef, Garment};

fn read(text: &str) -> Garment {
    parse_garment(text, "garment.json").expect("a readable garment").garment
}

/// The garment with the top edge of its front panel curved.
fn curved(curvature: &str) -> String {
    garment_text().replace(
        r#"{"endpoints": [2, 3], "label": "lower_interface"}"#,
        &format!(r#"{{"endpoints": [2, 3], "curvature": {curvature}}}"#),
    )
}

fn curve(curvature: &str) -> Curve {
    read(&curved(curvature)).panels[0].edges[2].curve
}

#[test]
fn panels_are_in_metres_and_placed() {
    let garment = read(&garment_text());
    assert_eq!(garment.name, "garment");
    let front = &garment.panels[0];
    assert_eq!((front.name.as_str(), front.edges.len()), ("front", 4));
    assert_eq!(front.edges[2].start, dvec2(0.3, 0.4));
    assert_eq!(front.edges[2].label.as_deref(), Some("lower_interface"));
    assert_eq!(front.placement.world(dvec2(0.3, 0.4)), dvec3(0.15, 1.0, 0.2));
    let sides = [EdgeRef { panel: 0, edge: 1 }, EdgeRef { panel: 1, edge: 2 }];
    assert_eq!(garment.seams[0].sides, sides);
    assert!(!garment.seams[0].right_wrong && garment.seams[1].right_wrong);
}

#[test]
fn units_scale_vertices_and_translations() {
    let garment = read(&garment_text().replace("\"units_in_meter\": 100", "\"units_in_meter\": 300"));
    let world = garment.panels[0].placement.world(garment.panels[0].edges[2].start);
    assert!(world.distance(dvec3(0.05, 1.0 / 3.0, 0.2 / 3.0)) < 1e-15);
}

#[test]
fn rotations_are_x_then_y_then_z() {
    let turned = garment_text().replacen("\"rotation\": [0, 0, 0]", "\"rotation\": [90, 0, 90]", 1);
    let placement = read(&turned).panels[0].placement;
    // Rx turns y into z; Rz then leaves z and turns x into y.
    assert!((placement.rotation * DVec3::Y).distance(DVec3::Z) < 1e-15);
    assert!((placement.rotation * DVec3::X).distance(DVec3::Y) < 1e-15);
}

#[test]
fn every_form_of_curvature_is_understood() {
    // The edge runs from (0.3, 0.4) to (0, 0.4): along is −x, aside is −y.
    let near = |a: DVec2, b: DVec2| assert!(a.distance(b) < 1e-15, "{a} {b}");
    for old_and_new in ["[0.5, 0.2]", r#"{"type": "quadratic", "params": [[0.5, 0.2]]}"#] {
        let Curve::Quadratic { control } = curve(old_and_new) else { panic!("a quadratic") };
        near(control, dvec2(0.15, 0.34));
    }
    let cubic = r#"{"type": "cubic", "params": [[0.25, 0.1], [0.75, -0.1]]}"#;
    let Curve::Cubic { controls } = curve(cubic) else { panic!("a cubic") };
    near(controls[0], dvec2(0.225, 0.37));
    near(controls[1], dvec2(0.075, 0.43));
    let circle = r#"{"type": "circle", "params": [25, 0, 1]}"#;
    assert_eq!(curve(circle), Curve::Arc { radius: 0.25, large: false, right: true });
    assert_eq!(curve("null"), Curve::Straight);
}

#[test]
fn a_circle_that_is_right_bulges_to_the_right() {
    // Right of −x is +y: outward for this counter-clockwise panel.
    let garment = read(&curved(r#"{"type": "circle", "params": [15.0000001, 0, 1]}"#));
    let points = garment.panels[0].polyline(2, 1e-4);
    let top = points.iter().map(|point| point.y).fold(0.0, f64::max);
    assert!((top - 0.55).abs() < 1e-3, "{top}");
}

#[test]
fn a_radius_short_by_rounding_is_a_half_circle() {
    let half = curve(r#"{"type": "circle", "params": [14.99999, 0, 1]}"#);
    let Curve::Arc { radius, .. } = half else { panic!("an arc") };
    assert!((radius - 0.15).abs() < 1e-15);
}

#[test]
fn a_panel_of_two_edges_needs_a_curve() {
    let two = |curvature: &str| {
        format!(
            r#"{{"pattern": {{"panels": {{"lens": {{"translation": [0, 0, 0], "rotation": [0, 0, 0],
                "vertices": [[0, 0], [30, 0]],
                "edges": [{{"endpoints": [0, 1]}}, {{"endpoints": [1, 0]{curvature}}}]}}}}, "stitches": []}},
                "properties": {{"units_in_meter": 100}}}}"#
        )
    };
    assert_eq!(read(&two(r#", "curvature": [0.5, -0.4]"#)).panels[0].edges.len(), 2);
    let error = parse_garment(&two(""), "lens.json").expect_err("a line").to_string();
    assert_eq!(error, "lens.json, panel \"lens\": the outline has 2 edges, it needs 3");
}

#[test]
fn every_fault_names_panel_and_edge() {
    let text = garment_text();
    let with = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    let cases = [
        with("[30, 0]", "[30, NaN]"),
        with("[30, 0]", "[-Infinity, 0]"),
        with("[30, 0]", "[1e999, 0]"),
        with("[30, 0]", "[30, 0"),
        with("[-15, 60, 20]", "[-15, null, 20]"),
        with("[30, 0]", "[0.00001, 0]"),
        with("[0, 1]}, ", "[0, 2]}, "),
        with("[0, 1]}, ", "[0, 4]}, "),
        with("[0, 1]}, ", "[0, -1]}, "),
        with("[30, 40], [0, 40]]", "[0, 40], [30, 40]]"),
        with("\"units_in_meter\": 100", "\"units_in_meter\": 1"),
        with("\"units_in_meter\": 100", "\"units_in_meter\": 0"),
        with("\"back\": {", "\"front\": {"),
        with("\"edge\": 1}", "\"edge\": 4}"),
        with("\"edge\": 1}", "\"edge\": -1}"),
        with("\"edge\": 3}", "\"edge\": 1}"),
        with("{\"panel\": \"back\", \"edge\": 2}", "{\"panel\": \"front\", \"edge\": 1}"),
        with("{\"panel\": \"back\", \"edge\": 2}", "{\"panel\": \"bakc\", \"edge\": 2}"),
        with("right_wrong", "left_wrong"),
        with(", \"right_wrong\"", ", {\"panel\": \"back\", \"edge\": 1}"),
        curved(r#"{"type": "spline", "params": [[0, 0]]}"#),
        curved(r#"{"type": "cubic", "params": [[0.5, 0.5]]}"#),
        curved(r#"{"type": "circle", "params": [10, 0, 1]}"#),
        curved(r#"{"type": "circle", "params": [15, 0, 2]}"#),
        curved("[0.5]"),
        curved("[0.5, NaN]"),
        curved("[0.5, 3.0]"),
        with("\"units_in_meter\": 100", "\"units_in_meter\": null"),
        with("\"units_in_meter\": 100", "\"units_in_meter\": 100, \"curvature_coords\": \"polar\""),
        with("\"units_in_meter\": 100", "\"units_in_meter\": 100, \"normalize_panel_translation\": \"maybe\""),
        with("[30, 40], [0, 40]]", "[30, 40], [0, 40], [10, 10], [10, 20], [20, 20]]").replacen(
            "{\"endpoints\": [3, 0]}]",
            "{\"endpoints\": [3, 0]}, {\"endpoints\": [4, 5]}, {\"endpoints\": [5, 6]}, {\"endpoints\": [6, 4]}]",
            1,
        ),
        r#"{"design": {}, "parts": {}}"#.into(),
        "<svg></svg>".into(),
        String::new(),
        r#"{"pattern": {"panels": {}}, "properties": {"units_in_meter": 100}}"#.into(),
        "[]".into(),
    ];
    let messages: Vec<String> =
        cases.iter().map(|text| parse_garment(text, "g.json").expect_err(text).to_string()).collect();
    insta::assert_snapshot!(messages.join("\n"), @r#"
    g.json, panel "front": vertex 1 at (30, NaN) is not a finite number
    g.json, panel "front": vertex 1 at (NaN, 0) is not a finite number
    g.json, line 3, column 39: the JSON is not valid: number out of range
    g.json, line 3, column 42: the JSON is not valid: trailing characters
    g.json, panel "front": the translation or rotation is not a finite number
    g.json, panel "front", edge 0: its ends are the same point, (0, 0) m
    g.json, panel "front", edge 0: the outline is not closed: the edge ends at vertex 2 and edge 1 starts at vertex 1
    g.json, panel "front", edge 0: vertex 4 does not exist: there are 4
    g.json, panel "front", edge 0: vertex -1 does not exist: there are 4
    g.json, panel "front": the outline crosses itself: edge 1 meets edge 3 near (0.1500, 0.2000) m; draw it as one loop, or split the panel there into two that are stitched
    g.json, panel "front": the panel is 40.0 m large, and panels are at most 10 m: check units_in_meter, which is 1
    g.json, key "properties.units_in_meter": it is 0 and must be a positive number
    g.json, panel "front": there are two panels of this name
    g.json, stitch 0: panel "front" has no edge 4: its edges are 0 to 3
    g.json, stitch 0: panel "front" has no edge -1: its edges are 0 to 3
    g.json, stitch 1: edge 1 of panel "front" is already sewn by stitch 0
    g.json, stitch 0: edge 1 of panel "front" is stitched to itself
    g.json, stitch 0: there is no panel "bakc"; there is: front, back
    g.json, stitch 1: its third entry "left_wrong" is not "right_wrong"
    g.json, stitch 1: it must name two edges, and may add "right_wrong"
    g.json, panel "front", edge 2: the curvature type "spline" is not known; there is: quadratic, cubic, circle
    g.json, panel "front", edge 2: the params of the curvature type "cubic" are not complete
    g.json, panel "front", edge 2: the circle of radius 0.1 m cannot reach both ends, which are 0.3 m apart
    g.json, panel "front", edge 2: the params of the curvature type "circle" are not complete
    g.json, panel "front", edge 2: the curvature [0.5] is not a control point [x, y]
    g.json, panel "front", edge 2: the control point (0.5, NaN) is not a finite number
    g.json, panel "front": the outline crosses itself: edge 0 meets edge 2 near (0.1000, 0.0000) m; draw it as one loop, or split the panel there into two that are stitched
    g.json, key "properties.units_in_meter": it is NaN and must be a positive number
    g.json, key "properties.curvature_coords": "polar" is not known; there is: "relative", "absolute"
    g.json, key "properties.normalize_panel_translation": "maybe" is not known; there is: true, false
    g.json, panel "front", edge 3: a second outline begins after this edge, and a panel has one: draw a hole as a cut from the rim, an edge in to the hole and the same edge back, or split the panel through the hole
    g.json: it has no key "pattern": a garment is GarmentCode's JSON, a file like NAME_specification.json
    g.json: it is SVG, which is not read: a garment is GarmentCode's JSON, a file like NAME_specification.json
    g.json: it is not JSON: a garment is GarmentCode's JSON, a file like NAME_specification.json
    g.json: the garment has no panel
    g.json, line 1, column 2: the JSON is not valid: invalid length 0, expected a garment with "pattern" and "properties"
    "#);
}

/// The curvature of the top edge, from (30, 40) to (0, 40), by its chord, and as flat positions.
const CURVES: [[&str; 2]; 3] = [
    ["[0.5, 0.2]", "[15, 34]"],
    [r#"{"type": "quadratic", "params": [[0.5, 0.2]]}"#, r#"{"type": "quadratic", "params": [[15, 34]]}"#],
    [
        r#"{"type": "cubic", "params": [[0.25, 0.1], [0.75, -0.1]]}"#,
        r#"{"type": "cubic", "params": [[22.5, 37], [7.5, 43]]}"#,
    ],
];

#[test]
fn absolute_control_points_are_flat_positions() {
    let absolute =
        |text: String| text.replace("\"units_in_meter\"", "\"curvature_coords\": \"absolute\", \"units_in_meter\"");
    for [relative, flat] in CURVES {
        for units in ["100", "1000", "39.37"] {
            let scaled =
                |text: String| text.replace("\"units_in_meter\": 100", &format!("\"units_in_meter\": {units}"));
            let expected = read(&scaled(curved(relative))).panels[0].polyline(2, 1e-4);
            let got = read(&scaled(absolute(curved(flat)))).panels[0].polyline(2, 1e-4);
            assert_eq!(got.len(), expected.len());
            assert!(got.iter().zip(&expected).all(|(a, b)| a.distance(*b) < 1e-12), "{flat} {units}");
        }
    }
    let circle = r#"{"type": "circle", "params": [25, 0, 1]}"#;
    assert_eq!(read(&absolute(curved(circle))), read(&curved(circle)));
}

#[test]
fn what_a_file_leaves_out_is_the_default_of_the_format() {
    let whole = read(&garment_text());
    let without = |from: &str| {
        let text = garment_text();
        assert!(text.contains(from), "{from}");
        parse_garment(&text.replace(from, ""), "garment.json").expect("a readable garment")
    };
    let told = "it has no key \"properties.units_in_meter\": read as centimetres";
    for left_out in [r#""units_in_meter": 100"#, ",\n     \"properties\": {\"units_in_meter\": 100}"] {
        let file = without(left_out);
        assert_eq!((file.garment, file.warnings), (whole.clone(), vec![told.to_owned()]));
    }
    let file = without(r#" "rotation": [0, 0, 0],"#);
    assert_eq!((file.garment, file.warnings), (whole, Vec::new()));
    let unsewn = without(
        r#",
     "stitches": [[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 2}],
                  [{"panel": "front", "edge": 3}, {"panel": "back", "edge": 0}, "right_wrong"]]"#,
    );
    assert_eq!(unsewn.garment.seams, []);
}

#[test]
fn files_of_any_editor_are_the_same_garment() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("garment.json");
    let text = garment_text();
    let units = |bytes: fn(u16) -> [u8; 2]| format!("\u{feff}{text}").encode_utf16().flat_map(bytes).collect();
    let written: [Vec<u8>; 5] = [
        format!("\u{feff}{text}").into(),
        text.replace('\n', "\r\n").into(),
        text.replace('\n', "\r").into(),
        units(u16::to_le_bytes),
        units(u16::to_be_bytes),
    ];
    for bytes in written {
        fs::write(&path, bytes).expect("a file");
        let file = read_garment(&path).expect("a readable garment");
        assert_eq!((file.garment, file.warnings), (read(&text), Vec::new()));
    }
    assert_eq!(read(&format!("\u{feff}{text}")), read(&text));
}

#[test]
fn a_centred_panel_is_placed_by_the_mean_of_its_vertices() {
    let centred = |text: &str| {
        read(&text.replace("\"units_in_meter\"", "\"normalize_panel_translation\": true, \"units_in_meter\""))
    };
    // As it lies the panel stands where it stood; a turned one is moved by the mean (15, 20) as it lies flat.
    let text = garment_text();
    let panel = &centred(&text).panels[0];
    assert!(panel.placement.world(dvec2(0.3, 0.4)).distance(dvec3(0.15, 1.0, 0.2)) < 1e-12);
    let turned = text.replacen("\"rotation\": [0, 0, 0]", "\"rotation\": [0, 180, 0]", 1);
    let panel = &centred(&turned).panels[0];
    assert!(panel.placement.world(dvec2(0.15, 0.2)).distance(dvec3(0.0, 0.8, 0.2)) < 1e-12);
    assert!(panel.placement.world(dvec2(0.3, 0.4)).distance(dvec3(-0.15, 1.0, 0.2)) < 1e-12);
}

#[test]
fn keys_that_nothing_reads_are_told_once_by_name() {
    let known = garment_text()
        .replace(
            "\"units_in_meter\"",
            "\"normalized_edge_loops\": true, \"original_units_in_meter\": 1, \"units_in_meter\"",
        )
        .replace("\"stitches\"", "\"panel_order\": [\"front\", \"back\"], \"stitches\"")
        .replace("\"translation\"", "\"label\": \"body\", \"translation\"")
        .replacen('{', "{\"parameters\": {\"a\": {\"range\": [0, NaN]}}, \"parameter_order\": [], ", 1);
    let warnings = |text: &str| parse_garment(text, "g.json").expect("a readable garment").warnings;
    assert_eq!(warnings(&known), [] as [&str; 0]);
    let unknown = garment_text()
        .replace("\"units_in_meter\"", "\"gravity\": 9, \"units_in_meter\"")
        .replace("\"stitches\"", "\"buttons\": [], \"stitches\"")
        .replace("\"translation\"", "\"grain\": 45, \"translation\"")
        .replace("\"endpoints\": [2, 3]", "\"gather\": 2, \"curvature\": {\"type\": \"quadratic\", \"params\": [[0.5, 0.1]], \"knots\": [0]}, \"endpoints\": [2, 3]")
        .replace("\"edge\": 3", "\"ease\": 0.1, \"edge\": 3")
        .replacen('{', "{\"author\": \"A\", ", 1);
    insta::assert_snapshot!(warnings(&unknown).join("\n"), @r#"
    not read: the key "author" of the file
    not read: the key "grain" of a panel (panel "front")
    not read: the key "gather" of an edge (panel "front", edge 2)
    not read: the key "knots" of a curvature (panel "front", edge 2)
    not read: the key "buttons" of the file (key "pattern.buttons")
    not read: the key "ease" of a stitch (stitch 1)
    not read: the key "gravity" of the file (key "properties.gravity")
    "#);
}

/// The front panel with a cut from the middle of its lower edge to a hole of those corners.
fn with_hole(hole: &str, edges: &[[u32; 2]]) -> String {
    let edges: Vec<String> = edges.iter().map(|[a, b]| format!("{{\"endpoints\": [{a}, {b}]}}")).collect();
    garment_text()
        .replacen("[30, 40], [0, 40]]", &format!("[30, 40], [0, 40], [15, 0], {hole}]"), 1)
        .replacen(
            r#"{"endpoints": [0, 1]}, "#,
            &format!(r#"{{"endpoints": [0, 4]}}, {}, {{"endpoints": [4, 1]}}, "#, edges.join(", ")),
            1,
        )
        .replace("\"front\", \"edge\": 1", &format!("\"front\", \"edge\": {}", edges.len() + 2))
        .replace("\"front\", \"edge\": 3", &format!("\"front\", \"edge\": {}", edges.len() + 4))
}

#[test]
fn a_hole_that_is_cut_from_the_rim_is_read() {
    let shared = [[4, 5], [5, 6], [6, 7], [7, 8], [8, 5], [5, 4]];
    let diamond = with_hole("[15, 10], [12, 20], [15, 30], [18, 20]", &shared);
    assert_eq!(read(&diamond).panels[0].edges.len(), 11);
    let triangle = with_hole("[15, 10], [10, 20], [20, 20]", &[[4, 5], [5, 6], [6, 7], [7, 5], [5, 4]]);
    assert_eq!(read(&triangle).panels[0].edges.len(), 10);
    let slit = with_hole("[15, 25]", &[[4, 5], [5, 4]]);
    let garment = read(&slit);
    assert_eq!(garment.panels[0].edges[2].start, dvec2(0.15, 0.25));
    let [left, right] = [1, 3].map(|edge| garment.panels[0].edges[edge].start);
    assert!(left.distance(right) > 1e-4 && left.distance(right) < 1e-3, "{left} {right}");
    assert_eq!(garment.seams[0].sides[0], EdgeRef { panel: 0, edge: 4 });
    // A cut that leaves the cloth through the other side is none.
    let through = with_hole("[15, 50]", &[[4, 5], [5, 4]]);
    let error = parse_garment(&through, "g.json").expect_err("it crosses").to_string();
    assert!(error.contains("crosses itself") && error.contains("split the panel"), "{error}");
}

#[test]
fn a_file_that_is_no_pattern_is_not_looked_at_for_long() {
    let huge = " ".repeat(9 << 20);
    let error = parse_garment(&huge, "g.json").expect_err("too large").to_string();
    assert_eq!(error, "g.json: a garment of more than 8388608 bytes cannot be read");
}
