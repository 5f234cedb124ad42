//! The program from outside, as a person or a script meets it.

use crate::support::{Journey, fixture, good, json, list, refused};
use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// The files of every run.
const FILES: [&str; 8] = [
    "all_views.png",
    "back.png",
    "dressed.glb",
    "front.png",
    "garment.obj",
    "metrics.json",
    "side.png",
    "three_quarter.png",
];

#[test]
fn adapters_are_listed_for_people_and_for_programs() {
    let journey = Journey::new();
    let lines = good(journey.run(&["adapters"]));
    let adapters = json(&good(journey.run(&["adapters", "--json"])));
    assert_eq!(lines.lines().count(), list(&adapters).len());
    for (line, adapter) in lines.lines().zip(list(&adapters)) {
        assert!(line.starts_with(adapter["name"].as_str().expect("a name")), "{line}");
    }
    assert!(list(&adapters).iter().any(|adapter| adapter["usable"] == true));
}

#[test]
fn a_plan_needs_no_adapter() {
    let journey = Journey::new();
    let plan = |arguments: &[&str]| {
        let mut command = journey.command(&["plan"]);
        command.args(arguments).env("VK_DRIVER_FILES", "none.json").env("VK_ICD_FILENAMES", "none.json");
        good(command.output().expect("the program starts"))
    };
    insta::assert_snapshot!("plan_hang", plan(&[&fixture("scenes/hang.toml"), "--set", "n=16"]));
    let skirt = fixture("garments/skirt.json");
    insta::assert_snapshot!("plan_skirt", plan(&["--garment", &skirt, "--spacing", "4cm"]));
    // A garment is dressed without wind and polish, so its plan has none of their passes.
    let windy = format!(
        "spacing = 0.04\nwind = {{ velocity = [1, 0, 0] }}\npolish = {{ target = 0.05, sweeps = 2 }}\n[[garment]]\nfile = {skirt:?}\n"
    );
    fs::write(journey.folder.path().join("windy.toml"), windy).expect("written");
    let told = plan(&["windy.toml"]);
    assert!(!told.contains("wind"), "{told}");
    let [open, sewn] = told.split_once("skirt, sewn").map(|(open, sewn)| [open, sewn]).expect("two plans");
    assert!(!open.contains("grant_sweep") && sewn.contains("grant_sweep"), "{told}");
    let plans = json(&plan(&["--garment", &skirt, "--spacing", "4cm", "--json"]));
    let states: Vec<_> = list(&plans).iter().map(|plan| &plan["state"]).collect();
    assert_eq!(states, ["open", "sewn"]);
}

#[test]
fn a_plan_is_also_a_picture_of_the_limits() {
    let journey = Journey::new();
    let skirt = fixture("garments/skirt.json");
    let said = good(journey.run(&["plan", "--garment", &skirt, "--spacing", "4cm", "--picture", "limits.svg"]));
    assert!(said.ends_with("wrote limits.svg\n"), "{said}");
    let svg = fs::read_to_string(journey.folder.path().join("limits.svg")).expect("a picture");
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    assert!(svg.matches("<path class=\"level1").count() > 50);
    let sentence = refused(journey.run(&["plan", "--garment", &skirt, "--picture", "none/limits.svg"]));
    assert!(sentence.starts_with("none/limits.svg"), "{sentence}");
}

#[test]
fn the_plan_is_what_the_run_does() {
    let journey = Journey::new();
    let with = |command: &str| {
        let options = ["--set", "n=16", "--set", "frames=1", "--json"];
        json(&good(journey.run(&[&[command, &fixture("scenes/ball.toml")], &options[..]].concat())))
    };
    let (plan, run) = (&with("plan")[0], with("run"));
    assert_eq!(plan["bytes"], run["gpu_bytes"]);
    assert_eq!(plan["map_bytes"], 0);
    // Timestamps are there on the adapter of the tests, so every kernel of a step has its time.
    assert_eq!(dispatches(&run["passes"], "name"), dispatches(&plan["step"], "kernel"));
}

/// Dispatches of each kernel; the key is that of its name.
fn dispatches(kernels: &Value, key: &str) -> Vec<(String, u64)> {
    let pair = |kernel: &Value| {
        (kernel[key].as_str().expect("a name").to_owned(), kernel["dispatches"].as_u64().expect("a number"))
    };
    let mut pairs: Vec<_> = list(kernels).iter().map(pair).collect();
    pairs.sort();
    pairs
}

/// Limits of single springs, which a swing stretches beyond their threshold, and a polish that is too short for it.
#[test]
fn every_frame_of_a_run_has_its_strain() {
    let journey = Journey::new();
    let polish = "polish={ target = 0.05, sweeps = 1 }";
    let options = ["--set", "n=16", "--set", "frames=30", "--set", "rule=predictive", "--set", polish, "--json"];
    let metrics = json(&good(journey.run(&[&["run", &fixture("scenes/hang.toml")], &options[..]].concat())));
    let cloth = &metrics["cloths"][0];
    let frames = list(&cloth["frames"]);
    let number = |row: &Value, name: &str| row[name].as_f64().unwrap_or_else(|| panic!("{name} of {row}"));
    assert_eq!(frames.len(), 30);
    for (index, row) in (1..).zip(frames) {
        assert_eq!(row["frame"], index);
        assert!((number(row, "time_s") - f64::from(index) / 60.0).abs() < 1e-6, "{row}");
        assert_eq!(row["longest_spring"].is_array(), number(row, "elongation_max") > 0.0, "{row}");
        assert_eq!(number(row, "over_long_count") > 0.0, number(row, "elongation_max") > 0.05, "{row}");
    }
    let most = frames.iter().map(|row| number(row, "elongation_max")).fold(0.0, f64::max);
    assert_eq!(most, number(cloth, "elongation_max_over_run"));
    assert!(frames.iter().any(|row| number(row, "over_long_count") > 0.0));
    for name in ["further_sweeps", "missed_steps"] {
        let counts: Vec<f64> = frames.iter().map(|row| number(row, name)).collect();
        assert_eq!(counts[0], 0.0, "{name}: it only begins to fall");
        assert!(counts.iter().filter(|count| **count > 0.0).count() > 1, "{name}: {counts:?}");
        assert_eq!(counts.iter().sum::<f64>(), number(cloth, name), "{name}");
    }
}

#[test]
fn the_gpu_and_the_reference_measure_the_same() {
    for scene in ["hang", "ball"] {
        let journey = Journey::new();
        let path = fixture(&format!("scenes/{scene}.toml"));
        let run = |backend: &str| {
            let options = ["--set", "n=16", "--set", "frames=20", "--json", "--out", backend, "--backend", backend];
            let metrics = json(&good(journey.run(&[&["run", &path], &options[..]].concat())));
            assert_eq!(journey.names(backend), FILES);
            assert_eq!(journey.metrics(backend), metrics);
            metrics
        };
        let (gpu, reference) = (run("gpu"), run("reference"));
        assert_eq!(journey.names(""), ["gpu", "reference"]);
        let counts =
            ["particle_count", "spring_count", "colour_count", "quad_count", "steps_draping", "non_finite_count"];
        for name in counts {
            assert!(gpu[name].is_u64(), "{scene}: {name}");
            assert_eq!(gpu[name], reference[name], "{scene}: {name}");
        }
        // A driver may round otherwise, and a falling sheet spreads that: a thousandth of the number, or 1e-6 of its unit.
        for name in ["elongation_max", "elongation_p99", "kinetic_energy_per_particle_j", "penetration_max_mm"] {
            let [a, b] = [&gpu[name], &reference[name]].map(Value::as_f64);
            assert_eq!(a.is_some(), b.is_some(), "{scene}: {name}");
            let (a, b) = (a.unwrap_or(0.0), b.unwrap_or(0.0));
            assert!((a - b).abs() <= 1e-3 * b.abs() + 1e-6, "{scene}: {name} is {a} and {b}");
        }
        assert_eq!(gpu["penetration_max_mm"].is_f64(), scene == "ball", "only a body can be penetrated");
    }
}

#[test]
fn quiet_is_silent_and_loud_says_what_it_made() {
    let journey = Journey::new();
    let run = |more: &[&str]| {
        let options = ["--set", "n=8", "--set", "frames=2", "--backend", "reference"];
        good(journey.run(&[&["run", &fixture("scenes/ball.toml")], &options[..], more].concat()))
    };
    assert_eq!(run(&["--quiet"]), "");
    let said = run(&["--out", "a/b/c"]);
    assert!(said.starts_with("sheet: 64 particles"), "{said}");
    assert!(said.ends_with("wrote a/b/c\n"), "{said}");
    assert_eq!(journey.names(""), ["a", "out"]);
    assert_eq!(journey.names("a/b"), ["c"]);
    assert_eq!(journey.names("a/b/c"), FILES);
}

#[test]
fn results_replace_older_ones_and_nothing_else() {
    let journey = Journey::new();
    let out = journey.folder.path().join("out");
    fs::create_dir(&out).expect("a folder");
    fs::write(out.join("metrics.json"), r#"{ "adapter": "an older one" }"#).expect("a file");
    fs::write(out.join("notes.txt"), "mine").expect("a file");
    let options = ["--set", "n=8", "--set", "frames=1", "--backend", "reference", "--quiet"];
    let run = || journey.run(&[&["run", &fixture("scenes/hang.toml")], &options[..]].concat());
    good(run());
    assert_eq!(fs::read_to_string(out.join("notes.txt")).expect("a file"), "mine");
    assert_eq!(journey.metrics("out")["scene"], "hang");
    assert_eq!(journey.names(""), ["out"]);
    let theirs = r#"{ "accuracy": 0.9 }"#;
    fs::write(out.join("metrics.json"), theirs).expect("a file");
    assert!(refused(run()).starts_with("--out out: its metrics.json is not of toile"));
    assert_eq!(fs::read_to_string(out.join("metrics.json")).expect("a file"), theirs);
}

#[test]
fn a_sphere_is_in_the_result_where_it_is_at_the_end() {
    let journey = Journey::new();
    let options = ["--set", "n=8", "--set", "frames=120", "--backend", "reference", "--quiet"];
    good(journey.run(&[&["run", &fixture("scenes/moving-ball.toml")], &options[..]].concat()));
    let glb = fs::read(journey.folder.path().join("out/dressed.glb")).expect("a file");
    let length = u32::from_le_bytes(glb[12..16].try_into().expect("four bytes")) as usize;
    let root = json(std::str::from_utf8(&glb[20..20 + length]).expect("UTF-8 text"));
    let names: Vec<_> = list(&root["meshes"]).iter().map(|mesh| &mesh["name"]).collect();
    assert_eq!(names, ["sphere", "sheet"]);
    let positions = root["meshes"][0]["primitives"][0]["attributes"]["POSITION"].as_u64().expect("an accessor");
    let bounds = &root["accessors"][positions as usize];
    let [low, high] = [&bounds["min"][0], &bounds["max"][0]].map(|v| v.as_f64().expect("a number"));
    // Half of its period of 4 s: the far end of its swing of 0.4 m.
    assert!((low - 0.15).abs() < 1e-3 && (high - 0.65).abs() < 1e-3, "{low} to {high}");
}

#[test]
fn every_broken_file_ends_in_one_sentence_and_no_folder() {
    let journey = Journey::new();
    let mut paths: Vec<PathBuf> =
        fs::read_dir(fixture("broken")).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    assert!(paths.len() >= 8, "{paths:?}");
    for path in paths {
        let option = if path.extension().is_some_and(|ending| ending == "json") { "--garment" } else { "--body" };
        let path = path.display().to_string();
        let sentence = refused(journey.run(&["dress", option, &path]));
        assert!(sentence.starts_with(&path), "{sentence}");
        assert_eq!(journey.names(""), [] as [&str; 0]);
    }
}

#[test]
fn wrong_options_end_in_one_sentence_and_no_folder() {
    let journey = Journey::new();
    fs::write(journey.folder.path().join("file"), "").expect("a file");
    let hang = fixture("scenes/hang.toml");
    let refuse = |arguments: &[&str]| refused(journey.run(arguments)).replace(&hang, "hang.toml");
    let sentences = [
        refuse(&["dress", "--spacing", "10m"]),
        refuse(&["dress", "--body", "none.obj"]),
        refuse(&["dress", "--clip", "jump"]),
        refuse(&["run", "none.toml"]),
        refuse(&["run", &hang, "--set", "fabric.colour=3"]),
        refuse(&["run", &hang, "--set", "n=1"]),
        refuse(&["run", &hang, "--out", "file"]),
        refuse(&["run", &hang, "--out", "file/below"]),
    ];
    insta::assert_snapshot!("wrong_options", sentences.join("\n"));
    assert!(refuse(&["run", &hang, "--set", "colour=3"]).contains("key \"colour\": unknown field"));
    assert!(refuse(&["dress", "--fabric", "tweed"]).contains("there is no fabric \"tweed\""));
    assert!(refuse(&["dress", "--fabric", "wol"]).contains("did you mean \"wool\"?"));
    fs::write(journey.folder.path().join("heavy.toml"), "base = \"wool\"\nareal_density = 99\n").expect("a file");
    let sentence = refuse(&["dress", "--fabric", "heavy.toml"]);
    assert!(sentence.starts_with("heavy.toml, key \"areal_density\": it is 99"), "{sentence}");
    assert!(refuse(&["run", &hang, "--adapter", "abacus"]).starts_with("--adapter abacus: no adapter"));
    assert_eq!(journey.names(""), ["file", "heavy.toml"]);
}

#[test]
fn a_scene_that_a_run_does_not_know_is_refused() {
    let journey = Journey::new();
    let text = fs::read_to_string(fixture("scenes/ball.toml")).expect("a scene");
    let moving = "\n[[body]]\nfile = \"body.obj\"\nkeys = [{ time = 0 }, { time = 1, translation = [1, 0, 0] }]\n";
    fs::write(journey.folder.path().join("moving.toml"), text + moving).expect("a file");
    fs::write(journey.folder.path().join("body.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a file");
    let sentence = refused(journey.run(&["run", "moving.toml", "--backend", "reference"]));
    assert!(sentence.starts_with("scene ball has a mesh that moves"), "{sentence}");
    let dressed = format!("[[garment]]\nfile = {:?}\n{moving}", fixture("garments/skirt.json"));
    fs::write(journey.folder.path().join("dressed.toml"), dressed).expect("a file");
    let sentence = refused(journey.run(&["run", "dressed.toml"]));
    assert!(sentence.starts_with("scene dressed has garments on a mesh that moves: toile walk"), "{sentence}");
    for command in ["run", "plan"] {
        let stiff = ["--set", "rule=none", "--set", "fabric.structural_stiffness=1e6", "--set", "n=256"];
        let sentence = refused(journey.run(&[&[command, &fixture("scenes/hang.toml")], &stiff[..]].concat()));
        assert!(sentence.contains("a frame would take"), "{sentence}");
    }
}

/// Bodies of every kind in one scene: they carry the cloth, and the result has them where they are at the end.
#[test]
fn a_sheet_runs_over_bodies_of_every_kind() {
    let journey = Journey::new();
    let sphere = "[[sphere]]\ncentre = [-0.3, 0, 0]\nradius = 0.2\n[[sphere]]\ncentre = [0.3, 0, 0]\nradius = 0.2\n";
    let capsule = "[[capsule]]\nends = [[-0.2, 0, 0.3], [0.2, 0, 0.3]]\nradius = 0.1\n";
    let plane = "[[plane]]\npoint = [0, -0.4, 0]\nnormal = [0, 1, 0]\n";
    let mesh = "[[body]]\nfile = \"body.obj\"\nkeys = [{ time = 0 }, { time = 0.5, translation = [0, 0.1, 0] }]\n";
    let sheet = "[[sheet]]\nsize = [1, 1]\ncorner = [-0.5, 0.22, 0.5]\nright = [1, 0, 0]\ndown = [0, 0, -1]\n";
    let text = format!("n = 16\nframes = 20\ntexel = 0.01\n{sheet}{sphere}{capsule}{plane}{mesh}");
    fs::write(journey.folder.path().join("all.toml"), text).expect("a file");
    let octahedron = "v 0.1 0 -0.3\nv -0.1 0 -0.3\nv 0 0.1 -0.3\nv 0 -0.1 -0.3\nv 0 0 -0.2\nv 0 0 -0.4\n\
        f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
    fs::write(journey.folder.path().join("body.obj"), octahedron).expect("a file");
    let metrics = json(&good(journey.run(&["run", "all.toml", "--json"])));
    let depth = metrics["penetration_max_mm"].as_f64().expect("a number");
    assert!(depth < 10.0, "{metrics}");
    assert_eq!(metrics["non_finite_count"], 0);
    let glb = fs::read(journey.folder.path().join("out/dressed.glb")).expect("a file");
    let length = u32::from_le_bytes(glb[12..16].try_into().expect("four bytes")) as usize;
    let root = json(std::str::from_utf8(&glb[20..20 + length]).expect("UTF-8 text"));
    let names: Vec<_> = list(&root["meshes"]).iter().map(|mesh| &mesh["name"]).collect();
    assert_eq!(names, ["body", "sphere", "sphere", "capsule", "plane", "sheet"]);
    let plan = good(journey.run(&["plan", "all.toml"]));
    assert!(plan.contains("sample_moving_layers") && plan.contains("sample_shapes"), "{plan}");
}

/// The signal is sent once the program listens, which the kernel tells.
#[cfg(target_os = "linux")]
#[test]
fn ctrl_c_ends_the_run_and_leaves_nothing() {
    use std::process::Stdio;
    use std::time::{Duration, Instant};

    let journey = Journey::new();
    let options = ["--set", "n=16", "--set", "frames=100000000", "--backend", "reference"];
    let mut command = journey.command(&[&["run", &fixture("scenes/hang.toml")], &options[..]].concat());
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    let listens = || {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).expect("a running program");
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).expect("a mask of signals");
        u64::from_str_radix(caught.trim(), 16).expect("a mask in hexadecimal") & (1 << 1) != 0
    };
    let start = Instant::now();
    while !listens() {
        assert!(start.elapsed() < Duration::from_secs(30), "the program does not listen for ctrl-c");
        std::thread::sleep(Duration::from_millis(20));
    }
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(sent.success());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "interrupted: nothing was written\n");
    assert!(output.stdout.is_empty());
    assert_eq!(journey.names(""), [] as [&str; 0]);
}

/// Numbers of a dressed body that must hold for any garment of ours.
fn check_dressed(metrics: &Value) {
    let number = |name: &str| metrics[name].as_f64().unwrap_or_else(|| panic!("{name} is a number"));
    assert_eq!(number("non_finite_count"), 0.0);
    assert!(number("seam_gap_max_mm") <= 2.0, "{metrics}");
    assert!(number("penetration_p99_mm") <= 1.0 && number("penetration_max_mm") <= 5.0, "{metrics}");
    assert!(number("false_contact_fraction") < 0.01, "{metrics}");
    // Two garments of half a second each; what is stuck takes longer.
    assert!(number("steps_sewing") < 800.0, "{metrics}");
}

#[test]
fn the_built_in_dress_is_sewn_and_comes_to_rest() {
    let journey = Journey::new();
    let output = journey.run(&["dress", "--spacing", "3cm", "--quiet"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(journey.names("out"), FILES);
    let metrics = journey.metrics("out");
    check_dressed(&metrics);
    // Worn, not fallen: the dress hangs from the shoulders, its hem is at the knee.
    let text = fs::read_to_string(journey.folder.path().join("out/garment.obj")).expect("the garment");
    let heights: Vec<f64> =
        text.lines().filter_map(|line| line.strip_prefix("v ")?.split(' ').nth(1)?.parse().ok()).collect();
    let [low, high] = heights.iter().fold([f64::MAX, f64::MIN], |[low, high], y| [low.min(*y), high.max(*y)]);
    assert!(high > 1.3 && high < 1.45, "the shoulders are at {high} m");
    assert!(low > 0.35 && low < 0.65, "the hem is at {low} m");
}

/// The skirt of the fixtures, cut narrower by `part` [1].
fn narrower_skirt(part: f64) -> String {
    let mut skirt = json(&fs::read_to_string(fixture("garments/skirt.json")).expect("the skirt"));
    for panel in skirt["pattern"]["panels"].as_object_mut().expect("panels").values_mut() {
        for vertex in panel["vertices"].as_array_mut().expect("vertices") {
            vertex[0] = ((1.0 - part) * vertex[0].as_f64().expect("a number")).into();
        }
    }
    skirt.to_string()
}

#[test]
fn a_garment_that_is_too_tight_stretches_rather_than_cut_into_the_body() {
    let journey = Journey::new();
    fs::write(journey.folder.path().join("tight.json"), narrower_skirt(0.06)).expect("written");
    let output = journey.run(&["dress", "--garment", "tight.json", "--spacing", "3cm", "--json"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.starts_with("warning: garment tight: too tight: panel "), "{said}");
    let metrics = json(&String::from_utf8_lossy(&output.stdout));
    assert_eq!(metrics["cloths"][0]["verdict"]["word"], "too tight but at rest", "{metrics}");
    let number = |name: &str| metrics[name].as_f64().expect("a number");
    assert!((0.06..0.12).contains(&number("elongation_max")), "it is too tight for its limits: {metrics}");
    assert!(number("penetration_max_mm") < 1.0, "{metrics}");
    // The plan of a garment is what it is draped with.
    let plans = json(&good(journey.run(&["plan", "--garment", "tight.json", "--spacing", "3cm", "--json"])));
    let sewn = &list(&plans)[1];
    assert_eq!(dispatches(&metrics["passes"], "name"), dispatches(&sewn["step"], "kernel"));
    let bytes = ["bytes", "map_bytes"].map(|key| sewn[key].as_u64().expect("a number"));
    assert_eq!(metrics["gpu_bytes"], bytes[0] + bytes[1]);
}

#[test]
fn a_garment_that_is_too_wide_falls_off_and_is_written_all_the_same() {
    let journey = Journey::new();
    fs::write(journey.folder.path().join("wide.json"), narrower_skirt(-0.7)).expect("written");
    let options = ["--garment", "wide.json", "--spacing", "6cm", "--texel", "1cm", "--json"];
    let output = journey.run(&[&["dress"], &options[..]].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.starts_with("warning: garment wide: fallen off: "), "{said}");
    assert_eq!(journey.names("out"), FILES);
    let metrics = journey.metrics("out");
    let verdict = &metrics["cloths"][0]["verdict"];
    assert_eq!((&verdict["word"], &verdict["is_worn"]), (&Value::from("fallen off"), &Value::from(false)));
    assert!(verdict["findings"][0]["drop"].as_f64().is_some_and(|drop| drop > 0.25), "{verdict}");
}

/// A panel in no stitch falls, and the skirt stays on.
#[test]
fn a_loose_panel_is_told_by_its_name() {
    let journey = Journey::new();
    let mut skirt = json(&fs::read_to_string(fixture("garments/skirt.json")).expect("the skirt"));
    let square = [[0.0, 0.0], [18.0, 0.0], [18.0, 18.0], [0.0, 18.0]];
    let edges: Vec<Value> = (0..4).map(|k| serde_json::json!({ "endpoints": [k, (k + 1) % 4] })).collect();
    skirt["pattern"]["panels"]["pocket"] = serde_json::json!({ "vertices": square, "edges": edges, "translation": [0.0, 80.0, 40.0], "rotation": [0.0, 0.0, 0.0] });
    fs::write(journey.folder.path().join("pocket.json"), skirt.to_string()).expect("written");
    let options = ["--garment", "pocket.json", "--spacing", "6cm", "--texel", "1cm", "--json"];
    let output = journey.run(&[&["dress"], &options[..]].concat());
    assert_eq!(output.status.code(), Some(3), "{}", String::from_utf8_lossy(&output.stderr));
    let verdict = &journey.metrics("out")["cloths"][0]["verdict"];
    let findings = list(&verdict["findings"]);
    assert_eq!(findings.len(), 1, "the skirt is on: {verdict}");
    assert_eq!(findings[0]["panels"], serde_json::json!(["pocket"]), "{verdict}");
    let openings: Vec<&Value> = list(&verdict["openings"]).iter().map(|opening| &opening["limb_count"]).collect();
    assert_eq!(openings.len(), 2, "waist and hem: {verdict}");
    assert!(openings.iter().all(|count| count.as_u64().is_some_and(|count| count > 0)), "{verdict}");
}

#[test]
fn an_outer_garment_lies_over_an_inner_one_by_the_reference_too() {
    let journey = Journey::new();
    let [skirt, shirt] = ["garments/skirt.json", "garments/shirt_sleeveless.json"].map(fixture);
    let garments = ["--garment", skirt.as_str(), "--garment", shirt.as_str()];
    let base = ["dress", "--spacing", "6cm", "--quiet", "--backend", "reference"];
    let output = journey.run(&[&base[..], &garments[..]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metrics = journey.metrics("out");
    check_dressed(&metrics);
    assert_eq!(metrics["cloths"].as_array().map(Vec::len), Some(2));
}

/// A walk of two garments that ctrl-c ended goes on and ends in the same bytes as one that was never interrupted.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_walk_goes_on_bit_for_bit() {
    use std::process::Stdio;
    use std::time::{Duration, Instant};

    let journey = Journey::new();
    let skirt = journey.folder.path().join("skirt.json");
    fs::copy(fixture("garments/skirt.json"), &skirt).expect("copied");
    let shirt = fixture("garments/shirt_sleeveless.json");
    let walk = |out: &'static str, more: &[&'static str]| {
        let options = [
            "walk",
            "--garment",
            "skirt.json",
            "--garment",
            &shirt,
            "--spacing",
            "6cm",
            "--texel",
            "2cm",
            "--seconds",
            "0.2",
            "--quiet",
        ];
        journey.command(&[&options[..], &["--out", out], more].concat())
    };
    good(walk("whole", &[]).output().expect("the program runs"));

    let child = walk("halves", &[]).stderr(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the program starts");
    let second = journey.folder.path().join("halves/.unfinished-walk/000002.state");
    let start = Instant::now();
    while !second.exists() {
        assert!(start.elapsed() < Duration::from_secs(300), "the walk does not get to its second frame");
        std::thread::sleep(Duration::from_millis(2));
    }
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(sent.success());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(output.status.code(), Some(130), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!journey.folder.path().join("halves/walk.usda").exists(), "it was interrupted before its end");
    assert!(refused(walk("halves", &[]).output().expect("it runs")).contains("--resume"));
    assert!(refused(walk("whole", &["--resume"]).output().expect("it runs")).contains("no unfinished walk"));

    fs::write(&skirt, narrower_skirt(0.01)).expect("written");
    assert!(refused(walk("halves", &["--resume"]).output().expect("it runs")).contains("another one"));
    fs::copy(fixture("garments/skirt.json"), &skirt).expect("copied");

    good(walk("halves", &["--resume"]).output().expect("the program runs"));
    for file in ["walk.usda", "0_skirt.pc2", "1_shirt_sleeveless.pc2", "walk.gif", "walk.png", "frame_0006.png"] {
        let [whole, halves] = ["whole", "halves"].map(|folder| fs::read(journey.folder.path().join(folder).join(file)));
        assert!(whole.expect("it was written") == halves.expect("it was written"), "{file} differs");
    }
    let metrics = journey.metrics("whole");
    let [collision, simulation] =
        ["collision_ms_median", "simulation_ms_median"].map(|key| metrics[key].as_f64().expect("a number"));
    assert!(0.0 < collision && collision < simulation, "{collision} of {simulation} ms");
    let frames = list(&metrics["frames"]);
    assert_eq!(frames.len(), 6);
    for row in frames {
        assert_eq!(row["non_finite_count"], 0);
        assert!(row["penetration_max_mm"].as_f64().is_some_and(|depth| depth < 10.0), "{row}");
        assert!(row["penetration_p99_mm"].as_f64().is_some_and(|depth| depth < 2.0), "{row}");
    }
    assert_eq!(journey.names("whole").len(), 12, "six frames, a strip, a GIF, USD, two PC2 and metrics");
}

#[test]
fn every_rule_is_shown_and_the_default_holds_where_others_run_away() {
    let journey = Journey::new();
    let scene = fixture("scenes/moving-ball.toml");
    let options = ["--set", "n=24", "--set", "frames=40", "--backend", "reference", "--json"];
    let told = json(&good(journey.run(&[&["rules", &scene], &options[..]].concat())));
    let rows = list(&told);
    let names: Vec<&str> = rows.iter().filter_map(|row| row["rule"].as_str()).collect();
    assert_eq!(names, ["none", "zero", "average", "directional", "position", "predictive", "hierarchical"]);
    assert_eq!(rows[6]["diverged"], false);
    let elongation = |row: usize| rows[row]["elongation_max_over_run"].as_f64().expect("a number");
    assert!(elongation(6) < 0.07 && elongation(5) < elongation(0), "{} and {}", elongation(6), elongation(5));
    assert_eq!(journey.names("out"), ["rules.json", "rules.png"]);
    // The sphere goes 100 mm in these 40 frames.
    let [end, mean, max] = ["lag_m", "lag_mean_m", "lag_max_over_run_m"].map(|key| rows[6][key].as_f64().expect(key));
    assert!(0.0 < mean && mean < max && end <= max && max < 0.02, "{mean}, {max} and {end} m behind");
    let hang = fixture("scenes/hang.toml");
    let options = ["--set", "n=8", "--set", "frames=1", "--backend", "reference", "--json"];
    let told = json(&good(journey.run(&[&["rules", &hang], &options[..]].concat())));
    assert!(list(&told).iter().all(|row| row["lag_mean_m"].is_null()), "there is nothing to be behind of");
    let garment = fixture("garments/skirt.json");
    fs::write(journey.folder.path().join("g.toml"), format!("[[garment]]\nfile = {garment:?}\n")).expect("written");
    assert!(refused(journey.run(&["rules", "g.toml"])).contains("not one sheet"));
    let polish = ["--set", "polish={ target = 0.05, sweeps = 2 }", "--backend", "reference"];
    assert!(refused(journey.run(&[&["rules", &hang], &polish[..]].concat())).contains("leave it out"));
    // Sweeps that the scene asks for are those of every rule.
    let swept = ["--set", "n=8", "--set", "frames=10", "--set", "sweeps=6", "--backend", "reference", "--json"];
    let more = json(&good(journey.run(&[&["rules", &hang], &swept[..]].concat())));
    let once = ["--set", "n=8", "--set", "frames=10", "--backend", "reference", "--json"];
    let less = json(&good(journey.run(&[&["rules", &hang], &once[..]].concat())));
    let predictive = |told: &Value| list(told)[5]["elongation_max_over_run"].as_f64().expect("a number");
    assert!(predictive(&more) < predictive(&less), "{} and {}", predictive(&more), predictive(&less));
}

#[test]
fn an_outfit_walks_together() {
    let journey = Journey::new();
    let [skirt, shirt] = ["skirt", "shirt_sleeveless"].map(|name| fixture(&format!("garments/{name}.json")));
    let garments = ["--garment", &skirt, "--garment", &shirt, "--spacing", "5cm", "--texel", "1cm"];
    let walk = ["walk", "--clip", "apose_to_walk", "--seconds", "0.2", "--fps", "30", "--wind", "0,0,-2", "--json"];
    let metrics = json(&good(journey.run(&[&walk[..], &garments[..]].concat())));
    assert_eq!(metrics["garments"], serde_json::json!(["skirt", "shirt_sleeveless"]));
    for row in list(&metrics["frames"]) {
        assert_eq!(row["non_finite_count"], 0);
        assert!(row["elongation_p99"].as_f64().is_some_and(|p99| p99 < 0.055), "{row}");
        assert!(row["elongation_max"].as_f64().is_some_and(|max| max < 0.1), "{row}");
        assert!(row["penetration_max_mm"].as_f64().is_some_and(|depth| depth < 10.0), "{row}");
        assert!(row["penetration_p99_mm"].as_f64().is_some_and(|depth| depth < 2.0), "{row}");
    }
    let points = |file: &str| fs::metadata(journey.folder.path().join("out").join(file)).expect("it was written").len();
    let count = metrics["particle_count"].as_u64().expect("a number");
    // A header of 32 bytes, and seven frames of three floats for each particle.
    assert_eq!(points("0_skirt.pc2") + points("1_shirt_sleeveless.pc2"), 2 * 32 + 7 * 12 * count);
}

/// A body that lies is turned, which is told before sewing, and the skirt hangs where it belongs.
/// Its side seams close where the hands are, so it is sewn with level arms; what is written and judged is the body as it was given.
#[test]
fn arms_that_were_raised_are_down_again_in_the_result() {
    let journey = Journey::new();
    let skirt = fixture("garments/circle_skirt.json");
    let dress = ["dress", "--garment", &skirt, "--spacing", "6cm", "--texel", "2cm"];
    let output = journey.run(&[&dress[..], &["--json"]].concat());
    assert!(output.status.success(), "{output:?}");
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(told.contains("note: dressed with level arms"), "{told}");
    let metrics: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(metrics["cloths"][0]["verdict"]["word"], "on", "{metrics}");
    assert_eq!(metrics["crossed_count"], 0);
    let openings = metrics["cloths"][0]["verdict"]["openings"].as_array().expect("openings");
    assert_eq!(openings.iter().filter_map(|opening| opening["limb_count"].as_u64()).max(), Some(2), "{metrics}");
    let sentence = refused(journey.run(&[&dress[..], &["--backend", "reference", "--out", "other"]].concat()));
    assert!(sentence.starts_with("--backend reference: seams of outfit would close around the arms"), "{sentence}");
    assert_eq!(journey.names(""), ["out"]);
}

#[test]
fn a_body_that_lies_is_turned_and_dressed() {
    let journey = Journey::new();
    let mut options = toile::files::BodyOptions::default();
    options.clip = Some("apose_to_walk".to_owned());
    let path = PathBuf::from(fixture("bodies/walking_woman.glb"));
    let body = toile::files::read_body(&path, &options).expect("the fixture").mesh;
    let vertices = body.positions.iter().map(|p| format!("v {} {} {}\n", p.x, -p.z, p.y));
    let faces = body.triangles.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    fs::write(journey.folder.path().join("lying.obj"), vertices.chain(faces).collect::<String>()).expect("written");
    let skirt = fixture("garments/skirt.json");
    let dress = ["dress", "--body", "lying.obj", "--garment", &skirt, "--spacing", "6cm", "--texel", "2cm", "--json"];
    let output = journey.run(&dress);
    let said = String::from_utf8(output.stderr).expect("UTF-8 text");
    let sentence = "turned the body by -90 degrees about x: +z was up (--up overrules it)";
    assert_eq!((output.status.code(), said.as_str()), (Some(0), format!("note: {sentence}\n").as_str()));
    let metrics = journey.metrics("out");
    assert_eq!(metrics["fit"], serde_json::json!([sentence]));
    let cloth = fs::read_to_string(journey.folder.path().join("out/garment.obj")).expect("written");
    let heights: Vec<f64> =
        cloth.lines().filter_map(|line| line.strip_prefix("v ")?.split(' ').nth(1)?.parse().ok()).collect();
    let [low, high] = [heights.iter().copied().fold(9.0, f64::min), heights.iter().copied().fold(0.0, f64::max)];
    assert!(0.3 < low && 0.85 < high && high < 1.2, "from {low} to {high} m it hangs from her waist");
}
