//! The command `toile report` from outside.

use crate::support::{Journey, good, json, list, refused};
use serde_json::Value;
use std::fs;
use std::process::Output;

fn run(journey: &Journey, arguments: &[&str]) -> Output {
    journey.run(&[&["report"], arguments].concat())
}

/// One experiment is run, written, and put beside itself.
#[test]
fn a_report_is_written_and_compared() {
    let journey = Journey::new();
    let said = good(run(&journey, &["--quick", "--only", "cost", "--seed", "3"]));
    assert_eq!(said.trim_end(), "wrote report/report.html");
    assert_eq!(journey.names("report"), ["report-cost-1.svg", "report.html", "report.json", "report.md"]);
    assert_eq!(journey.names("."), ["report"], "nothing else is left");
    let read = |file: &str| fs::read_to_string(journey.folder.path().join("report").join(file)).expect("the report");
    let page = read("report.html");
    assert!(page.contains("time of a step") && !page.contains("src=\"http"), "{page}");
    let text = read("report.json");
    let report = json(&text);
    assert_eq!((&report["seed"], &report["scale"]), (&Value::from(3), &Value::from("quick")));
    assert_eq!(list(&report["sections"]).len(), 1);
    let both = ["--compare", "report/report.json", "report/report.json", "--out", "both", "--json"];
    let page = json(&good(run(&journey, &both)));
    assert_eq!(journey.names("both"), ["comparison-cost-1.svg", "comparison.html", "comparison.json", "comparison.md"]);
    let tables = list(&page["sections"][0]["blocks"]).iter().filter_map(|block| block["table"]["rows"].as_array());
    let rows = tables.flatten();
    let ratios: Vec<f64> = rows.filter_map(|row| row[4]["number"].as_f64()).collect();
    assert!(ratios.len() > 20 && ratios.iter().all(|ratio| *ratio == 1.0), "{ratios:?}");
}

#[test]
fn a_report_refuses_what_it_does_not_know() {
    let journey = Journey::new();
    let sentence = refused(run(&journey, &["--only", "cost,swiftness"]));
    for experiment in ["precision", "settings", "cost", "terms"] {
        assert!(sentence.contains(experiment), "{sentence}");
    }
    let sentence = refused(run(&journey, &["--compare", "a.json", "b.json"]));
    assert!(sentence.starts_with("a.json: cannot be read"), "{sentence}");
    fs::write(journey.folder.path().join("a.json"), "{").expect("a file");
    assert!(refused(run(&journey, &["--compare", "a.json", "a.json"])).starts_with("a.json"));
    fs::write(journey.folder.path().join("a.json"), "{}").expect("a file");
    let sentence = refused(run(&journey, &["--compare", "a.json", "a.json"]));
    assert!(sentence.starts_with("a.json: it is no report.json"), "{sentence}");
    assert!(refused(run(&journey, &["--compare", "a.json", "a.json", "--quick"])).contains("--quick"));
    assert_eq!(journey.names("."), ["a.json"], "nothing is left behind");
}
