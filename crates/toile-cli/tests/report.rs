//! The command `toile report` from outside.

use serde_json::Value;
use std::fs;
use std::process::{Command, Output};
use tempfile::TempDir;

fn run(folder: &TempDir, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_toile"));
    command.arg("report").args(arguments).current_dir(folder);
    command.env_remove("XDG_RUNTIME_DIR").env_remove("NODEVICE_SELECT").output().expect("the program starts")
}

/// Names of everything in a folder of it, sorted.
fn names(folder: &TempDir, below: &str) -> Vec<String> {
    let entries = fs::read_dir(folder.path().join(below)).expect("a folder");
    let mut names: Vec<_> =
        entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name")).collect();
    names.sort();
    names
}

/// The output of a run that succeeds and says nothing beside it.
fn good(output: Output) -> String {
    let said = String::from_utf8(output.stderr).expect("UTF-8 text");
    assert_eq!((output.status.code(), said.as_str()), (Some(0), ""));
    String::from_utf8(output.stdout).expect("UTF-8 text")
}

/// The one sentence of a run that fails.
fn refused(output: Output) -> String {
    let said = String::from_utf8(output.stderr).expect("UTF-8 text");
    assert_eq!((output.status.code(), output.stdout.as_slice()), (Some(2), &[][..]), "{said}");
    assert_eq!(said.trim_end().lines().count(), 1, "{said}");
    said.strip_prefix("error: ").expect("a sentence of an error").to_owned()
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// One experiment is run, written, and put beside itself.
#[test]
fn a_report_is_written_and_compared() {
    let folder = TempDir::new().expect("a temporary folder");
    let said = good(run(&folder, &["--quick", "--only", "cost", "--seed", "3"]));
    assert_eq!(said.trim_end(), "wrote report/report.html");
    assert_eq!(names(&folder, "report"), ["report-cost-1.svg", "report.html", "report.json", "report.md"]);
    assert_eq!(names(&folder, "."), ["report"], "nothing else is left");
    let text = fs::read_to_string(folder.path().join("report/report.json")).expect("the report");
    let report = json(&text);
    assert_eq!((&report["seed"], &report["scale"]), (&Value::from(3), &Value::from("quick")));
    assert_eq!(list(&report["sections"]).len(), 1);
    let both = ["--compare", "report/report.json", "report/report.json", "--out", "both", "--json"];
    let page = json(&good(run(&folder, &both)));
    assert_eq!(
        names(&folder, "both"),
        ["comparison-cost-1.svg", "comparison.html", "comparison.json", "comparison.md"]
    );
    let rows = list(&page["sections"][0]["blocks"]).iter().flat_map(|block| list(&block["table"]["rows"]));
    let ratios: Vec<f64> = rows.filter_map(|row| row[4]["number"].as_f64()).collect();
    assert!(ratios.len() > 20 && ratios.iter().all(|ratio| *ratio == 1.0), "{ratios:?}");
}

#[test]
fn a_report_refuses_what_it_does_not_know() {
    let folder = TempDir::new().expect("a temporary folder");
    let sentence = refused(run(&folder, &["--only", "speed"]));
    for experiment in ["precision", "settings", "cost", "terms"] {
        assert!(sentence.contains(experiment), "{sentence}");
    }
    let sentence = refused(run(&folder, &["--compare", "a.json", "b.json"]));
    assert!(sentence.starts_with("a.json: cannot be read"), "{sentence}");
    fs::write(folder.path().join("a.json"), "{}").expect("a file");
    let sentence = refused(run(&folder, &["--compare", "a.json", "a.json"]));
    assert!(sentence.starts_with("a.json: it is no report.json"), "{sentence}");
    assert!(refused(run(&folder, &["--compare", "a.json", "a.json", "--quick"])).contains("--quick"));
    assert_eq!(names(&folder, "."), ["a.json"], "nothing is left behind");
}
