//! GarmentCode files: every form of edge and stitch, and the sentence of each fault.

use crate::support::garment_text;
use glam::{DVec2, DVec3, dvec2, dvec3};
use toile_files::parse_garment;
use toile_scene::{Curve, EdgeRef, Garment};

fn read(text: &str) -> Garment {
    parse_garment(text, "garment.json").expect("a readable garment")
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
    g.json, panel "front": the outline crosses itself: edge 1 meets edge 3 near (0.1500, 0.2000) m
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
    g.json, panel "front": the outline crosses itself: edge 0 meets edge 2 near (0.1000, 0.0000) m
    g.json: the garment has no panel
    g.json, line 1, column 2: the JSON is not valid: invalid length 0, expected a garment with "pattern" and "properties"
    "#);
}
