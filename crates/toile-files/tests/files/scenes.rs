//! Scene and fabric files.

use crate::support::{ellipsoid, fixture, garment_text, obj_text};
use glam::DVec3;
use std::fs;
use std::path::Path;
use toile_files::{SceneFile, read_fabric, read_scene};
use toile_scene::{Body, Cloth, Fabric, Friction, Rule, Sheet, SphereMotion, Wind};

fn overrides(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
    pairs.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect()
}

fn hang(pairs: &[(&str, &str)]) -> SceneFile {
    read_scene(&fixture("scenes/hang.toml"), &overrides(pairs)).expect("the fixture")
}

fn sheet(file: &SceneFile) -> &Sheet {
    match &file.scene.cloths[0] {
        Cloth::Sheet(sheet) => sheet,
        Cloth::Garment(_) => panic!("a sheet"),
    }
}

#[test]
fn the_fixtures_are_the_scenes_of_the_measurements() {
    let file = hang(&[]);
    let sheet = sheet(&file);
    assert_eq!((sheet.columns, sheet.rows, sheet.pins.len()), (64, 64, 2));
    assert_eq!((sheet.pins[1].column, sheet.pins[1].row), (63, 0));
    assert_eq!((file.frames, file.scene.settings.frame_rate), (120, 60.0));
    assert_eq!(file.scene.settings.fabric.threshold, 0.05);
    assert!(file.scene.bodies.is_empty());

    for (name, moves) in [("ball", false), ("moving-ball", true)] {
        let file = read_scene(&fixture(&format!("scenes/{name}.toml")), &[]).expect("the fixture");
        let [Body::Sphere(sphere)] = file.scene.bodies.as_slice() else { panic!("one sphere") };
        assert_eq!((file.scene.name.as_str(), sphere.radius), (name, 0.25));
        assert_eq!(sphere.motion != SphereMotion::Still, moves);
        let sheet = crate::scenes::sheet(&file);
        assert!(sheet.pins.is_empty());
        // The outside faces up, and the middle of the sheet is above the sphere.
        assert_eq!(sheet.right.cross(sheet.down), DVec3::Y);
        let middle = sheet.corner + 0.5 * (sheet.right * sheet.size.x + sheet.down * sheet.size.y);
        assert_eq!((middle.x, middle.z), (0.0, 0.0));
        assert!(middle.y > sphere.radius);
    }
}

#[test]
fn overrides_set_any_key() {
    let file = hang(&[
        ("n", "128"),
        ("rule", "directional"),
        ("fabric.threshold", "0.01"),
        ("sheet.0.rows", "32"),
        ("friction.papers", "{ velocity_kept = 0.8, force_removed = 0.3 }"),
    ]);
    let settings = &file.scene.settings;
    assert_eq!((sheet(&file).columns, sheet(&file).rows), (128, 32));
    assert_eq!(settings.velocity_modification.rule, Rule::Directional);
    assert_eq!((settings.fabric.threshold, settings.fabric.structural_stiffness), (0.01, 20.0));
    assert_eq!(settings.friction, Friction::Papers { velocity_kept: 0.8, force_removed: 0.3 });
}

#[test]
fn a_scene_has_wind_only_when_it_says_so() {
    assert_eq!(hang(&[]).scene.settings.wind, None);
    let wind = |text| hang(&[("wind", text)]).scene.settings.wind.expect("wind");
    let plate = Wind::new(DVec3::new(0.5, 0.0, -2.0));
    assert_eq!(wind("{ velocity = [0.5, 0, -2] }"), plate);
    assert_eq!(wind("{ velocity = [0.5, 0, -2], drag = 1.0, lift = 0 }"), Wind { drag: 1.0, lift: 0.0, ..plate });
    assert_eq!(hang(&[("wind.velocity", "[0.5, 0, -2]")]).scene.settings.wind, Some(plate));
}

#[test]
fn a_fabric_is_named_or_differs_from_a_named_one() {
    let named = hang(&[("fabric", "denim")]);
    assert_eq!(Some(&named.scene.settings.fabric), Fabric::preset("denim").as_ref());
    let changed = hang(&[("fabric", "denim"), ("fabric.friction", "0.1")]);
    let expected = Fabric { friction: 0.1, ..Fabric::preset("denim").expect("a preset") };
    assert_eq!(changed.scene.settings.fabric, expected);
}

#[test]
fn wrong_overrides_name_the_key_and_what_there_is() {
    let cases = [
        ("speed", "1"),
        ("fabric.colour", "red"),
        ("n", "1"),
        ("n", "100000"),
        ("n", "many"),
        ("rule", "strict"),
        ("fabric", "tweed"),
        ("fabric.areal_density", "-1"),
        ("fabric.damping", "nan"),
        ("sheet.3.rows", "2"),
        ("sheet.0.down", "[1, 0, 0]"),
        ("sheet.0.pins", "[[64, 0]]"),
        ("sheet.0.pins", "[\"middle\"]"),
        ("frames", "0"),
        ("sweeps", "0"),
        ("safety", "1.5"),
        ("gravity", "[0, inf, 0]"),
        ("wind", "{ velocity = [1, 0] }"),
        ("wind", "{ drag = 1 }"),
        ("wind", "{ velocity = [1, 0, 0], gusts = 3 }"),
        ("wind", "{ velocity = [nan, 0, 0] }"),
        ("wind", "{ velocity = [1, 0, 0], drag = -1 }"),
        ("wind", "{ velocity = [1, 0, 0], lift = inf }"),
        ("name.first", "x"),
        ("", "1"),
    ];
    let messages: Vec<String> = cases
        .iter()
        .map(|pair| {
            let error = read_scene(&fixture("scenes/hang.toml"), &overrides(&[*pair])).expect_err(pair.0);
            let prefix = fixture("scenes/").display().to_string();
            error.to_string().strip_prefix(&prefix).expect("the path").to_string()
        })
        .collect();
    insta::assert_snapshot!(messages.join("\n"), @r#"
    hang.toml, key "speed": unknown field `speed`, expected one of `name`, `n`, `frames`, `frame_rate`, `gravity`, `wind`, `spacing`, `texel`, `safety`, `reflection`, `rule`, `sweeps`, `friction`, `fabric`, `sheet`, `garment`, `body`, `sphere`
    hang.toml, key "fabric": unknown field `colour`, expected one of `base`, `name`, `areal_density`, `structural_stiffness`, `shear_stiffness`, `bend_stiffness`, `damping`, `thickness`, `friction`, `threshold`
    hang.toml, key "n": it is 1 and must be 2 to 8192
    hang.toml, key "n": it is 100000 and must be 2 to 8192
    hang.toml, key "n": invalid type: string "many", expected u32
    hang.toml, key "rule": unknown variant `strict`, expected one of `none`, `zero`, `average`, `directional`, `position`, `predictive`
    hang.toml, key "fabric": there is no fabric "tweed"; there is: silk, jersey, cotton, wool, denim
    hang.toml, key "fabric.areal_density": it is -1 and must be above 0
    hang.toml, key "fabric.damping": it is NaN and must be 0 or more
    hang.toml, key "sheet.3.rows": "3" is not the number of an entry: there are 1
    hang.toml, key "sheet.0.down": it must be perpendicular to right
    hang.toml, key "sheet.0.pins.0": [64, 0] is outside of the sheet of 64 × 64
    hang.toml, key "sheet.0.pins": a pin is [column, row], "top_left", "top_right", "bottom_left" or "bottom_right"
    hang.toml, key "frames": it must be at least 1
    hang.toml, key "sweeps": it must be at least 1; rule = "none" turns it off
    hang.toml, key "safety": it is 1.5 and must be 0 to 1
    hang.toml, key "gravity": it must be three finite numbers
    hang.toml, key "wind": invalid length 2, expected an array of length 3
    hang.toml, key "wind": missing field `velocity`
    hang.toml, key "wind": unknown field `gusts`, expected one of `velocity`, `drag`, `lift`
    hang.toml, key "wind.velocity": it must be three finite numbers
    hang.toml, key "wind.drag": it is -1 and must be 0 or more
    hang.toml, key "wind.lift": it is inf and must be 0 or more
    hang.toml, key "name.first": invalid type: map, expected a string
    hang.toml, key "": unknown field ``, expected one of `name`, `n`, `frames`, `frame_rate`, `gravity`, `wind`, `spacing`, `texel`, `safety`, `reflection`, `rule`, `sweeps`, `friction`, `fabric`, `sheet`, `garment`, `body`, `sphere`
    "#);
}

fn write(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(name), text).expect("a file");
}

#[test]
fn files_of_a_scene_lie_beside_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let mut body = ellipsoid();
    body.triangles.remove(0);
    body.positions.iter_mut().for_each(|position| *position *= 100.0);
    write(at, "body.obj", &obj_text(&body));
    write(at, "coat.json", &garment_text());
    write(at, "felt.toml", "base = \"wool\"\nthickness = 0.006\n");
    write(
        at,
        "scene.toml",
        "fabric = \"felt.toml\"\n[[garment]]\nfile = \"coat.json\"\n[[body]]\nfile = \"body.obj\"\nunits = \"cm\"\n",
    );
    let file = read_scene(&at.join("scene.toml"), &[]).expect("the scene");
    assert_eq!(file.scene.name, "scene");
    let fabric = &file.scene.settings.fabric;
    assert_eq!((fabric.name.as_str(), fabric.thickness, fabric.friction), ("wool", 0.006, 0.45));
    assert!(matches!(&file.scene.cloths[..], [Cloth::Garment(coat)] if coat.name == "coat"));
    assert!(matches!(&file.scene.bodies[..], [Body::Mesh(_)]));
    assert_eq!(file.warnings, ["body.obj: boundary edges (the body has holes): 3"]);
}

#[test]
fn faults_in_a_scene_name_the_file_that_has_them() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    write(at, "coat.json", "{");
    write(at, "circle.toml", "base = \"circle.toml\"\n");
    write(at, "bare.toml", "areal_density = 0.1\n");
    let sheet = "[[sheet]]\nsize = [1, 1]\ncorner = [0, 0, 0]\nright = [1, 0, 0]\ndown = [0, 0, 1]\n";
    let cases = [
        "[[garment]]\nfile = \"coat.json\"\n".to_string(),
        "[[garment]]\nfile = \"none.json\"\n".into(),
        "name = \"empty\"\n".into(),
        "name = \n".into(),
        "gravity = [0, 1]\n".into(),
        "[[garment]]\nfile = \"coat.json\"\nsize = 3\n".into(),
        sheet.to_string(),
        format!("n = 9\nfabric = \"circle.toml\"\n{sheet}"),
        format!("n = 9\nfabric = \"bare.toml\"\n{sheet}"),
        format!("n = 9\n{sheet}[[sphere]]\ncentre = [0, 0, 0]\nradius = -1\n"),
    ];
    let messages: Vec<String> = cases
        .iter()
        .map(|text| {
            write(at, "scene.toml", text);
            let error = read_scene(&at.join("scene.toml"), &[]).expect_err(text).to_string();
            error.strip_prefix(&format!("{}/", at.display())).expect("the path").to_string()
        })
        .collect();
    insta::assert_snapshot!(messages.join("\n"), @r#"
    coat.json, line 1, column 1: the JSON is not valid: EOF while parsing an object
    none.json: it cannot be read: No such file or directory (os error 2)
    scene.toml: the scene has no cloth: give a [[sheet]] or a [[garment]]
    scene.toml, line 1, column 8: string values must be quoted, expected literal string
    scene.toml, line 1, column 11: invalid length 2, expected an array of length 3
    scene.toml, line 3, column 1: unknown field `size`, expected `file`
    scene.toml, key "sheet.0.columns": it is missing; give it, or n for all sheets
    circle.toml, key "base": the base "circle.toml" leads in a circle
    bare.toml, key "structural_stiffness": it is missing; give it, or a base such as "cotton"
    scene.toml, key "sphere.0.radius": it is -1 and must be above 0
    "#);
    let error = read_fabric(&at.join("bare.toml")).expect_err("no base").to_string();
    assert!(error.ends_with(", key \"structural_stiffness\": it is missing; give it, or a base such as \"cotton\""));
}
