//! Scene and fabric files.

use crate::support::{ellipsoid, fixture, garment_text, obj_text, with};
use glam::DVec3;
use std::fs;
use std::path::Path;
use toile_files::{SceneFile, read_fabric, read_scene};
use toile_scene::{
    Body, Cloth, Fabric, Form, Friction, Polish, Rule, ShapeMotion, Sheet, Threshold, VelocityModification, Wind,
};

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
    assert_eq!(file.scene.settings.fabric.threshold, Threshold::even(0.05));
    assert!(file.scene.bodies.is_empty());

    for (name, moves) in [("ball", false), ("moving-ball", true)] {
        let file = read_scene(&fixture(&format!("scenes/{name}.toml")), &[]).expect("the fixture");
        let [Body::Shape(sphere)] = file.scene.bodies.as_slice() else { panic!("one sphere") };
        let Form::Sphere { radius } = sphere.form else { panic!("a sphere") };
        assert_eq!((file.scene.name.as_str(), radius), (name, 0.25));
        assert_eq!(sphere.motion != ShapeMotion::Still, moves);
        let sheet = crate::scenes::sheet(&file);
        assert!(sheet.pins.is_empty());
        // The outside faces up, and the middle of the sheet is above the sphere.
        assert_eq!(sheet.right.cross(sheet.down), DVec3::Y);
        let middle = sheet.corner + 0.5 * (sheet.right * sheet.size.x + sheet.down * sheet.size.y);
        assert_eq!((middle.x, middle.z), (0.0, 0.0));
        assert!(middle.y > radius);
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
    assert_eq!((settings.fabric.threshold, settings.fabric.structural_stiffness), (Threshold::even(0.01), 20.0));
    assert_eq!(settings.friction, Friction::Papers { velocity_kept: 0.8, force_removed: 0.3 });
}

#[test]
fn a_threshold_is_one_number_or_one_for_each_direction() {
    let threshold = |text| hang(&[("fabric.threshold", text)]).scene.settings.fabric.threshold;
    assert_eq!(threshold("0.15"), Threshold::even(0.15));
    let woven = "{ warp = 0.001, weft = 0.02, shear = 0.1 }";
    assert_eq!(threshold(woven), Threshold { warp: 0.001, weft: 0.02, shear: 0.1 });
    let fabric = hang(&[("fabric", "{ base = \"cotton\", threshold = { shear = 0.12 } }")]).scene.settings.fabric;
    assert_eq!(fabric.threshold, Threshold { shear: 0.12, ..Threshold::even(0.05) });
}

#[test]
fn a_scene_has_wind_only_when_it_says_so() {
    assert_eq!(hang(&[]).scene.settings.wind, None);
    let wind = |text| hang(&[("wind", text)]).scene.settings.wind.expect("wind");
    let plate = Wind::new(DVec3::new(0.5, 0.0, -2.0));
    assert_eq!(wind("{ velocity = [0.5, 0, -2] }"), plate);
    assert_eq!(
        wind("{ velocity = [0.5, 0, -2], drag = 1.0, lift = 0 }"),
        with(plate, |wind| {
            wind.drag = 1.0;
            wind.lift = 0.0;
        })
    );
    assert_eq!(hang(&[("wind.velocity", "[0.5, 0, -2]")]).scene.settings.wind, Some(plate));
}

#[test]
fn whoever_names_what_the_air_has_not_is_told_what_it_has() {
    let error =
        read_scene(&fixture("scenes/hang.toml"), &overrides(&[("wind", "{ velocity = [1, 0, 0], gusts = 3 }")]));
    let message = error.expect_err("air has no gusts").to_string();
    let (_, known) =
        message.split_once("key \"wind\": unknown field `gusts`, expected one of `velocity`").expect(&message);
    assert!(Wind::NUMBERS.iter().all(|number| known.contains(&format!(", `{}`", number.name))), "{message}");
}

#[test]
fn a_fabric_is_named_or_differs_from_a_named_one() {
    let named = hang(&[("fabric", "denim")]);
    assert_eq!(Some(&named.scene.settings.fabric), Fabric::preset("denim").as_ref());
    let changed = hang(&[("fabric", "denim"), ("fabric.friction", "0.1")]);
    let mut expected = Fabric::preset("denim").expect("a preset");
    expected.friction = 0.1;
    assert_eq!(changed.scene.settings.fabric, expected);
}

#[test]
fn a_cloth_may_have_a_fabric_of_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    fs::write(at("coat.json"), garment_text()).expect("it is written");
    fs::write(at("felt.toml"), "base = \"wool\"\nthickness = 0.011\n").expect("it is written");
    let sheet = "[[sheet]]\nsize = [1, 1]\ncorner = [0, 0, 0]\nright = [1, 0, 0]\ndown = [0, 0, 1]\n";
    let coat = "[[garment]]\nfile = \"coat.json\"\n";
    let text = format!(
        "n = 4\nfabric = \"denim\"\n{sheet}{sheet}fabric = {{ base = \"silk\", friction = 0.1 }}\n{coat}{coat}fabric = \"felt.toml\"\n"
    );
    fs::write(at("scene.toml"), text).expect("it is written");
    let scene = read_scene(&at("scene.toml"), &[]).unwrap_or_else(|error| panic!("{error}")).scene;
    let preset = |name: &str| Fabric::preset(name).expect("a preset");
    let fabrics: Vec<Fabric> = scene.fabrics().cloned().collect();
    assert_eq!(fabrics[0], preset("denim"));
    assert_eq!(fabrics[1], with(preset("silk"), |fabric| fabric.friction = 0.1));
    assert_eq!((&fabrics[2], fabrics[3].thickness), (&preset("denim"), 0.011));
    let own: Vec<bool> = scene.cloths.iter().map(|cloth| cloth.fabric().is_some()).collect();
    assert_eq!(own, [false, true, false, true]);
    for (key, value, told) in [
        ("sheet.1.fabric", "tweed", "key \"sheet.1.fabric\": there is no fabric \"tweed\""),
        ("sheet.0.fabric.damping", "-1", "key \"sheet.0.fabric.areal_density\": it is missing"),
        ("sheet.1.fabric.friction", "-1", "key \"sheet.1.fabric.friction\": it is -1 and must be"),
        ("garment.0.fabric.weave", "twill", "key \"garment.0.fabric\": unknown field `weave`"),
        ("garment.1.fabric", "none.toml", "none.toml"),
    ] {
        let error = read_scene(&at("scene.toml"), &overrides(&[(key, value)])).expect_err(key).to_string();
        assert!(error.contains(told), "{error}");
    }
}

#[test]
fn a_scene_names_any_rule_and_its_sweeps_if_it_cares() {
    for (name, rule) in Rule::ALL {
        for (sweeps, pairs) in [(None, vec![("rule", name)]), (Some(5), vec![("rule", name), ("sweeps", "5")])] {
            let mut expected = VelocityModification::new(rule);
            expected.sweeps = sweeps;
            assert_eq!(hang(&pairs).scene.settings.velocity_modification, expected, "{name}");
        }
    }
}

#[test]
fn a_polish_has_a_target_and_a_bound_under_a_predictive_rule() {
    let polish = |file: SceneFile| file.scene.settings.velocity_modification.polish;
    assert_eq!(polish(hang(&[])), None);
    let expected = Some(Polish { target: 0.02, sweeps: 8 });
    assert_eq!(polish(hang(&[("polish", "{ target = 0.02, sweeps = 8 }"), ("rule", "predictive")])), expected);
    let path = fixture("scenes/hang.toml");
    let average = overrides(&[("rule", "average"), ("polish", "{ target = 0.02, sweeps = 8 }")]);
    let error = read_scene(&path, &average).expect_err("the rule is not predictive").to_string();
    assert!(error.ends_with("key \"polish\": it needs rule = \"hierarchical\" or \"predictive\""), "{error}");
}

#[test]
fn wrong_overrides_name_the_key_and_what_there_is() {
    let cases = [
        ("speed", "1"),
        ("fabric.colour", "red"),
        ("n", "1"),
        ("n", "8192"),
        ("n", "4000000000"),
        ("n", "many"),
        ("rule", "strict"),
        ("fabric", "tweed"),
        ("fabric.areal_density", "-1"),
        ("fabric.areal_density", "150"),
        ("fabric.base", "tweed"),
        ("fabric.damping", "nan"),
        ("fabric.threshold", "0.2"),
        ("fabric.threshold", "high"),
        ("fabric.threshold", "{ warp = 0.01, weft = 0, shear = 0.1 }"),
        ("fabric.threshold", "{ warp = 0.01, bias = 0.1 }"),
        ("fabric.threshold", "{ warp = 0.01 }"),
        ("sheet.3.rows", "2"),
        ("sheet.0.columns", "4000000"),
        ("sheet.0.size", "[1e-30, 1]"),
        ("sheet.0.down", "[1, 0, 0]"),
        ("sheet.0.pins", "[[64, 0]]"),
        ("sheet.0.pins", "[\"middle\"]"),
        ("frames", "0"),
        ("sweeps", "0"),
        ("sweeps", "4000000000"),
        ("spacing", "1e-9"),
        ("texel", "1e-60"),
        ("frame_rate", "0.001"),
        ("polish", "{ target = 0.05 }"),
        ("polish", "{ target = 0.0005, sweeps = 4 }"),
        ("polish", "{ target = nan, sweeps = 4 }"),
        ("polish", "{ target = 0.05, sweeps = 0 }"),
        ("polish", "{ target = 0.05, sweeps = 65 }"),
        ("polish", "{ target = 0.05, sweeps = -1 }"),
        ("safety", "1.5"),
        ("safety", "1e-9"),
        ("gravity", "[0, inf, 0]"),
        ("wind", "{ velocity = [1, 0] }"),
        ("wind", "{ drag = 1 }"),
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
    hang.toml, key "speed": unknown field `speed`, expected one of `name`, `n`, `frames`, `frame_rate`, `gravity`, `wind`, `spacing`, `maps`, `texel`, `safety`, `swept`, `reflection`, `rule`, `sweeps`, `polish`, `friction`, `fabric`, `sheet`, `garment`, `body`, `sphere`, `capsule`, `plane`, `box`
    hang.toml, key "fabric": unknown field `colour`, expected one of `base`, `name`, `areal_density`, `structural_stiffness`, `shear_stiffness`, `bend_stiffness`, `bending_rigidity`, `damping`, `thickness`, `friction`, `threshold`
    hang.toml, key "n": it is 1 and must be 2 to 2097152
    hang.toml, key "n": 8192 × 8192 particles are more than 4194304
    hang.toml, key "n": it is 4000000000 and must be 2 to 2097152
    hang.toml, key "n": invalid type: string "many", expected u32
    hang.toml, key "rule": unknown variant `strict`, expected one of `none`, `zero`, `average`, `directional`, `position`, `predictive`, `hierarchical`
    hang.toml, key "fabric": there is no fabric "tweed"; there is: silk, jersey, cotton, wool, denim
    hang.toml, key "fabric.areal_density": it is -1 and must be 0.001 to 10 kg/m²
    hang.toml, key "fabric.areal_density": it is 150 and must be 0.001 to 10 kg/m²
    hang.toml, key "fabric.base": there is no fabric "tweed"; there is: silk, jersey, cotton, wool, denim
    hang.toml, key "fabric.damping": it is NaN and must be 0 to 1000 1/s
    hang.toml, key "fabric.threshold": that of the warp is 0.2 and must be from 0.001 to 0.15: 0.1 % to 15 %
    hang.toml, key "fabric": threshold is a number, or a table of warp, weft and shear
    hang.toml, key "fabric.threshold": that of the weft is 0 and must be from 0.001 to 0.15: 0.1 % to 15 %
    hang.toml, key "fabric": threshold is a number, or a table of warp, weft and shear
    hang.toml, key "fabric.threshold": that of the weft is missing; give it, or a base such as "cotton"
    hang.toml, key "sheet.3.rows": "3" is not the number of an entry: there are 1
    hang.toml, key "sheet.0.columns": it is 4000000 and must be 2 to 2097152
    hang.toml, key "sheet.0.size": it is 0.000000000000000000000000000001 and must be 0.001 to 1000 m
    hang.toml, key "sheet.0.down": it must be perpendicular to right
    hang.toml, key "sheet.0.pins.0": [64, 0] is outside of the sheet of 64 × 64
    hang.toml, key "sheet.0.pins": a pin is [column, row], "top_left", "top_right", "bottom_left" or "bottom_right"
    hang.toml, key "frames": it must be at least 1
    hang.toml, key "sweeps": it is 0 and must be 1 to 64
    hang.toml, key "sweeps": it is 4000000000 and must be 1 to 64
    hang.toml, key "spacing": it is 0.000000001 and must be 0.001 to 0.1 m
    hang.toml, key "texel": it is 0.000000000000000000000000000000000000000000000000000000000001 and must be 0.0005 to 0.05 m
    hang.toml, key "frame_rate": it is 0.001 and must be 1 to 1000 frames per second
    hang.toml, key "polish": missing field `sweeps`
    hang.toml, key "polish.target": it is 0.0005 and must be 0.001 to 0.5
    hang.toml, key "polish.target": it is NaN and must be 0.001 to 0.5
    hang.toml, key "polish.sweeps": it is 0 and must be 1 to 64
    hang.toml, key "polish.sweeps": it is 65 and must be 1 to 64
    hang.toml, key "polish": invalid value: integer `-1`, expected u32
    hang.toml, key "safety": it is 1.5 and must be 0.01 to 1
    hang.toml, key "safety": it is 0.000000001 and must be 0.01 to 1
    hang.toml, key "gravity": it must be three numbers of at most 1000000
    hang.toml, key "wind": invalid length 2, expected an array of length 3
    hang.toml, key "wind": missing field `velocity`
    hang.toml, key "wind.velocity": it must be three numbers of at most 1000000
    hang.toml, key "wind.drag": it is -1 and must be 0 to 100
    hang.toml, key "wind.lift": it is inf and must be 0 to 100
    hang.toml, key "name.first": invalid type: map, expected a string
    hang.toml, key "": unknown field ``, expected one of `name`, `n`, `frames`, `frame_rate`, `gravity`, `wind`, `spacing`, `maps`, `texel`, `safety`, `swept`, `reflection`, `rule`, `sweeps`, `polish`, `friction`, `fabric`, `sheet`, `garment`, `body`, `sphere`, `capsule`, `plane`, `box`
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
    scene.toml, line 3, column 1: unknown field `size`, expected `file` or `fabric`
    scene.toml, key "sheet.0.columns": it is missing; give it, or n for all sheets
    circle.toml, key "base": the base "circle.toml" leads in a circle
    bare.toml, key "structural_stiffness": it is missing; give it, or a base such as "cotton"
    scene.toml, key "sphere.0.radius": it is -1 and must be 0.001 to 1000 m
    "#);
    let error = read_fabric(&at.join("bare.toml")).expect_err("no base").to_string();
    assert!(error.ends_with(", key \"structural_stiffness\": it is missing; give it, or a base such as \"cotton\""));
}

const SHEET: &str = "n = 9\n[[sheet]]\nsize = [1, 1]\ncorner = [0, 2, 0]\nright = [1, 0, 0]\ndown = [0, 0, 1]\n";

#[test]
fn bodies_of_a_scene_move_by_clip_keys_or_sequence() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let mut body = ellipsoid();
    write(at, "body.obj", &obj_text(&body));
    fs::create_dir(at.join("frames")).expect("a folder");
    write(&at.join("frames"), "0.obj", &obj_text(&body));
    body.positions.iter_mut().for_each(|position| position.x += 0.5);
    write(&at.join("frames"), "1.obj", &obj_text(&body));
    let woman = fixture("bodies/walking_woman.glb").display().to_string();
    let text = format!(
        "{SHEET}[[body]]\nfile = '{woman}'\nmoving = true\nclip = \"walk_forward_4cycles\"\n\
         [[body]]\nfile = \"body.obj\"\nkeys = [{{ time = 0, translation = [1, 0, 0] }}, {{ time = 2, rotation = [0, 0, 2, 90] }}]\n\
         [[body]]\nsequence = \"frames\"\nframe_rate = 4\n\
         [[body]]\nfile = \"body.obj\"\nmoving = false\n\
         [[sphere]]\ncentre = [0, 1, 0]\nradius = 0.2\nkeys = [{{ time = 1 }}, {{ time = 3, rotation = [0, 1, 0, -90], translation = [0, 0, 4] }}]\n"
    );
    write(at, "scene.toml", &text);
    let file = read_scene(&at.join("scene.toml"), &[]).expect("the scene");
    let [Body::Moving(walk), Body::Moving(keys), Body::Moving(frames), Body::Mesh(still), Body::Shape(sphere)] =
        &file.scene.bodies[..]
    else {
        panic!("five bodies")
    };
    assert!((walk.duration() - 4.4).abs() < 1e-6);
    let top = |time| keys.at(time).positions[0];
    assert!(top(0.0).distance(glam::vec3(1.0, 1.6, 0.0)) < 1e-6 && keys.mesh.positions[0] == top(0.0));
    assert!(top(2.0).distance(glam::vec3(-1.6, 0.0, 0.0)) < 1e-6);
    assert_eq!((frames.duration(), frames.at(0.125).positions[0].x), (0.25, 0.25));
    assert_eq!(still.positions[0], keys.at(0.0).positions[0] - glam::Vec3::X);
    assert_eq!(sphere.at(2.0), (DVec3::new(0.0, 1.0, 2.0), DVec3::new(0.0, 0.0, 2.0)));
    assert!(sphere.spin(2.0).distance(DVec3::new(0.0, -std::f64::consts::FRAC_PI_4, 0.0)) < 1e-12);
    assert_eq!(sphere.spin(0.5), DVec3::ZERO);
}

#[test]
fn a_scene_has_any_number_of_shapes() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let sphere = |x: f64| format!("[[sphere]]\ncentre = [{x}, 0, 0]\nradius = 0.1\n");
    let capsule =
        "[[capsule]]\nends = [[0, 0, 0], [0, 2, 0]]\nradius = 0.2\nswing = { amplitude = [1, 0, 0], period = 2 }\n";
    write(at, "scene.toml", &format!("{SHEET}{}{}{capsule}", sphere(0.0), sphere(1.0)));
    let bodies = read_scene(&at.join("scene.toml"), &[]).expect("the scene").scene.bodies;
    let [Body::Shape(first), Body::Shape(second), Body::Shape(capsule)] = &bodies[..] else { panic!("three shapes") };
    assert_eq!([first.centre.x, second.centre.x], [0.0, 1.0]);
    assert_eq!((capsule.name(), capsule.centre), ("capsule", DVec3::Y));
    assert_eq!(capsule.form, Form::Capsule { half_axis: DVec3::Y, radius: 0.2 });
    // Half of its period: the far end of its swing.
    assert!((capsule.depth(DVec3::new(1.0, 2.1, 0.0), 1.0) - 0.1).abs() < 1e-12);
    write(at, "scene.toml", &format!("{SHEET}[[plane]]\npoint = [0, 1, 0]\nnormal = [0, 2, 0]\n"));
    let bodies = read_scene(&at.join("scene.toml"), &[]).expect("the scene").scene.bodies;
    let [Body::Shape(plane)] = &bodies[..] else { panic!("one plane") };
    assert_eq!((plane.name(), plane.depth(DVec3::new(3.0, 0.75, 2.0), 0.0)), ("plane", 0.25));
    write(at, "scene.toml", &format!("{SHEET}[[plane]]\npoint = [0, 1, 0]\nnormal = [0, 0, 0]\n"));
    let error = read_scene(&at.join("scene.toml"), &[]).expect_err("no direction").to_string();
    assert!(error.ends_with("key \"plane.0.normal\": it must be a direction out of the plane, not zero"), "{error}");
    let table = "[[box]]\ncentre = [0, 1, 0]\nsize = [0.2, 0.4, 2]\n";
    write(at, "scene.toml", &format!("{SHEET}{table}radius = 0.1\nrotation = [0, 0, 1, 90]\n{table}"));
    let bodies = read_scene(&at.join("scene.toml"), &[]).expect("the scene").scene.bodies;
    let [Body::Shape(rounded), Body::Shape(sharp)] = &bodies[..] else { panic!("two boxes") };
    assert_eq!((rounded.name(), sharp.name(), sharp.centre), ("box", "box", DVec3::Y));
    // It lies on its side: half of its height along x, and rounded as far as it is thick.
    let depth = |x: f64, y: f64| rounded.depth(DVec3::new(x, 1.0 + y, 0.0), 0.0);
    assert!((depth(0.25, 0.0) + 0.05).abs() < 1e-12 && (depth(0.2, 0.1) - 0.1 + 0.02f64.sqrt()).abs() < 1e-12);
    assert!((sharp.depth(DVec3::new(0.1, 1.2, 1.0), 0.0)).abs() < 1e-12, "a sharp corner");
    for (line, said) in [
        ("radius = 0.11\n", "key \"box.0.radius\": it is 0.11 and must be 0 to 0.1 m"),
        ("rotation = [0, 0, 0, 1]\n", "key \"box.0.rotation\": it must be an axis x, y, z and an angle in degrees"),
    ] {
        write(at, "scene.toml", &format!("{SHEET}{table}{line}"));
        let error = read_scene(&at.join("scene.toml"), &[]).expect_err("no box has it").to_string();
        assert!(error.ends_with(said), "{error}");
    }
    write(at, "scene.toml", &format!("{SHEET}[[capsule]]\nends = [[0, 1, 0], [0, 1, 0]]\nradius = 0.2\n"));
    let error = read_scene(&at.join("scene.toml"), &[]).expect_err("its ends are one").to_string();
    assert!(
        error.ends_with("key \"capsule.0.ends\": they must be 0.001 to 1000 m apart; a sphere has one centre"),
        "{error}"
    );
}

#[test]
fn motions_that_contradict_themselves_name_the_key() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    write(at, "body.obj", &obj_text(&ellipsoid()));
    let file = "[[body]]\nfile = \"body.obj\"\n";
    let sequence = "[[body]]\nsequence = \"frames\"\n";
    let ball = "[[sphere]]\ncentre = [0, 0, 0]\nradius = 1\n";
    let cases = [
        "[[body]]\nclip = \"walk\"\n".to_string(),
        format!("{file}sequence = \"frames\"\n"),
        format!("{file}frame_rate = 30\n"),
        format!("{file}moving = true\ntime = 1\n"),
        format!("{file}time = nan\n"),
        format!("{file}moving = true\nkeys = []\n"),
        format!("{file}moving = true\n"),
        format!("{file}keys = []\n"),
        format!("{file}keys = [{{ time = 0 }}, {{ time = 0 }}]\n"),
        format!("{file}keys = [{{ time = nan }}]\n"),
        format!("{file}keys = [{{ time = 0, rotation = [0, 0, 0, 90] }}]\n"),
        format!("{file}keys = [{{ time = 0, rotation = [0, 2, 0, -90] }}, {{ time = 1, rotation = [0, 1, 0, 90] }}]\n"),
        format!("{file}keys = [{{ time = 0 }}, {{ time = 1, rotation = [0, 1, 0, 360] }}]\n"),
        format!("{file}keys = [{{ time = 0, translation = [0, inf, 0] }}]\n"),
        format!("{file}keys = [{{ time = 0, speed = 1 }}]\n"),
        sequence.to_string(),
        format!("{sequence}frame_rate = 0\n"),
        format!("{sequence}frame_rate = 30\nclip = \"walk\"\n"),
        format!("{sequence}frame_rate = 30\ntime = 1\n"),
        format!("{sequence}frame_rate = 30\nmoving = true\n"),
        format!("{sequence}frame_rate = 30\nkeys = []\n"),
        format!("{sequence}frame_rate = 30\n"),
        format!("{ball}keys = []\n"),
        format!("{ball}keys = [{{ time = 0 }}]\nswing = {{ amplitude = [1, 0, 0], period = 1 }}\n"),
        format!("{ball}keys = [{{ time = 1 }}, {{ time = 0 }}]\n"),
    ];
    let messages: Vec<String> = cases
        .iter()
        .map(|text| {
            write(at, "scene.toml", &format!("{SHEET}{text}"));
            let error = read_scene(&at.join("scene.toml"), &[]).expect_err(text).to_string();
            error.strip_prefix(&format!("{}/", at.display())).expect("the path").to_string()
        })
        .collect();
    insta::assert_snapshot!(messages.join("\n"), @r#"
    scene.toml, key "body.0.file": it is missing; give file, or sequence with a folder
    scene.toml, key "body.0.sequence": give either file or sequence, not both
    scene.toml, key "body.0.frame_rate": only a sequence has it; a clip has times of its own
    scene.toml, key "body.0.time": a moving body starts its clip at 0; leave it out
    scene.toml, key "body.0.time": it is NaN and must be -3600 to 3600 s
    scene.toml, key "body.0.keys": give either moving = true or keys, not both
    body.obj: the motion of a .obj file, which has none (a .gltf or .glb file can have clips), cannot be read
    scene.toml, key "body.0.keys": it has no key; leave it out for a body at rest
    scene.toml, key "body.0.keys.1.time": it is 0 and must be a time after the key before
    scene.toml, key "body.0.keys.0.time": it is NaN and must be -3600 to 3600 s
    scene.toml, key "body.0.keys.0.rotation": it must be an axis x, y, z and an angle in degrees
    scene.toml, key "body.0.keys.1.rotation": it turns by 180 degrees from the key before, at most 179 are possible: give keys in between
    scene.toml, key "body.0.keys.1.rotation": it turns by 360 degrees from the key before, at most 179 are possible: give keys in between
    scene.toml, key "body.0.keys.0.translation": it must be three numbers of at most 1000000
    scene.toml, line 9, column 21: unknown field `speed`, expected one of `time`, `translation`, `rotation`
    scene.toml, key "body.0.frame_rate": it is missing; a sequence needs it
    scene.toml, key "body.0.frame_rate": it is 0 and must be 1 to 1000 frames per second
    scene.toml, key "body.0.clip": a sequence has no clip; its files are its motion
    scene.toml, key "body.0.time": a sequence has no clip; its files are its motion
    scene.toml, key "body.0.moving": a sequence always moves
    scene.toml, key "body.0.keys": a sequence moves by its files, not by keys
    frames: it cannot be read: No such file or directory (os error 2)
    scene.toml, key "sphere.0.keys": it has no key; leave it out for a body at rest
    scene.toml, key "sphere.0.keys": give either swing or keys, not both
    scene.toml, key "sphere.0.keys.1.time": it is 0 and must be a time after the key before
    "#);
}
