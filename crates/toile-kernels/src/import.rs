//! Imports: a line `#import shared/name` stands for the text of that file, once per kernel.

macro_rules! shared {
    ($($name:literal),* $(,)?) => {
        [$((concat!("shared/", $name), include_str!(concat!("../../../wgsl/shared/", $name, ".wgsl")))),*]
    };
}

const SHARED: &[(&str, &str)] = &shared![
    "attachment",
    "contact",
    "elongation",
    "item",
    "limit",
    "map_box",
    "map_planes",
    "midpoint",
    "over_long",
    "pair",
    "point",
    "polish",
    "probe",
    "quad",
    "reduction",
    "response",
    "seam_pair",
    "span",
    "status",
    "step_params",
    "strand",
    "vertices",
];

/// The WGSL of a kernel with its imports resolved, each shared file once, before its first use.
///
/// # Panics
/// When a file imports one that does not exist: the WGSL is part of this crate, so that is a mistake in it.
pub(crate) fn resolve(source: &str) -> String {
    let mut seen = Vec::new();
    let mut text = String::new();
    append(source, &mut seen, &mut text);
    text
}

fn append(source: &str, seen: &mut Vec<&'static str>, text: &mut String) {
    for line in source.lines() {
        match line.strip_prefix("#import ") {
            None => {
                text.push_str(line);
                text.push('\n');
            }
            Some(name) => {
                let (name, shared) = SHARED
                    .iter()
                    .find(|(known, _)| *known == name.trim())
                    .unwrap_or_else(|| panic!("wgsl imports {name}, which is not among the shared files"));
                if !seen.contains(name) {
                    seen.push(name);
                    append(shared, seen, text);
                }
            }
        }
    }
}
