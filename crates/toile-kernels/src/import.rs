//! Imports: a line `#import shared/name` stands for the text of that file, `#import struct/Name` for that struct; once per kernel.

use crate::structs;

macro_rules! shared {
    ($($name:literal),* $(,)?) => {
        [$((concat!("shared/", $name), include_str!(concat!("../../../wgsl/shared/", $name, ".wgsl")))),*]
    };
}

const SHARED: &[(&str, &str)] = &shared![
    "elongation",
    "item",
    "map_planes",
    "over_long",
    "pair",
    "point",
    "polish",
    "quad",
    "reduction",
    "response",
    "span",
    "step_params",
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
                    .chain(structs::WGSL)
                    .find(|(known, _)| *known == name.trim())
                    .unwrap_or_else(|| panic!("wgsl imports {name}, which is neither a shared file nor a struct"));
                if !seen.contains(name) {
                    seen.push(name);
                    append(shared, seen, text);
                }
            }
        }
    }
}
