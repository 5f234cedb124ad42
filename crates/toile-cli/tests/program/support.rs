//! What all calls of the program need.

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

/// Calls of the program in an empty folder, on a machine without a session.
pub struct Journey {
    /// Where it is called.
    pub folder: TempDir,
}

impl Journey {
    pub fn new() -> Self {
        Self { folder: TempDir::new().expect("a temporary folder") }
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_toile"));
        command.args(arguments).current_dir(&self.folder);
        command.env_remove("XDG_RUNTIME_DIR").env_remove("NODEVICE_SELECT");
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().expect("the program starts")
    }

    /// Names of everything in a folder of it, sorted.
    pub fn names(&self, below: &str) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path().join(below)).expect("a folder");
        let mut names: Vec<_> =
            entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a plain name")).collect();
        names.sort();
        names
    }

    pub fn metrics(&self, folder: &str) -> Value {
        json(&fs::read_to_string(self.folder.path().join(folder).join("metrics.json")).expect("the metrics"))
    }
}

pub fn fixture(path: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    root.canonicalize().expect("the fixtures").join(path).display().to_string()
}

/// The output of a run that succeeds and says nothing beside it, but how far it is where a machine takes long.
pub fn good(output: Output) -> String {
    let said = String::from_utf8(output.stderr).expect("UTF-8 text");
    let heard = ["error", "warning", "note"];
    let beside: Vec<&str> = said.lines().filter(|line| heard.iter().any(|word| line.starts_with(word))).collect();
    assert_eq!((output.status.code(), beside.as_slice()), (Some(0), [].as_slice()), "{said}");
    String::from_utf8(output.stdout).expect("UTF-8 text")
}

/// The one sentence of a run that fails.
pub fn refused(output: Output) -> String {
    let said = String::from_utf8(output.stderr).expect("UTF-8 text");
    assert_eq!((output.status.code(), output.stdout.as_slice()), (Some(2), &[][..]), "{said}");
    let sentence = said.strip_prefix("error: ").unwrap_or_else(|| panic!("no sentence of an error: {said}"));
    assert_eq!(sentence.lines().count(), 1, "{said}");
    sentence.trim_end().to_owned()
}

pub fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

pub fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}
