//! Imports: a line `#import shared/name` stands for the text of that file, `#import struct/Name` for that struct; once per kernel.
//!
//! A shared file may have sections. `#import shared/particles reads positions writes velocities` takes those that begin with
//! `#section positions`, `#section velocities` and `#section written velocities`, and puts the access for `$access`.
//! Resources have no numbers: they get them in the order in which they appear.

use crate::structs;
use std::collections::BTreeMap;

macro_rules! shared {
    ($($name:literal),* $(,)?) => {
        [$((concat!("shared/", $name), include_str!(concat!("../wgsl/shared/", $name, ".wgsl")))),*]
    };
}

const SHARED: &[(&str, &str)] = &shared![
    "area",
    "cluster",
    "crossings",
    "elongation",
    "hold_cluster",
    "item",
    "layer_box",
    "layer_raster",
    "layer_planes",
    "lead",
    "nodes",
    "side_planes",
    "over_long",
    "packed",
    "pair",
    "particles",
    "point",
    "polish",
    "quad",
    "reduction",
    "response",
    "seam",
    "span",
    "step_params",
    "vertices",
];

/// The WGSL of a kernel with its imports resolved, each shared file once, before its first use.
///
/// # Panics
/// When a file imports one that does not exist: the WGSL is part of this crate, so that is a mistake in it.
pub(crate) fn resolve(source: &str) -> String {
    let mut resolver = Resolver { written: BTreeMap::new(), seen: Vec::new(), text: String::new(), bindings: 0 };
    resolver.gather(source);
    resolver.append(source);
    resolver.text
}

struct Resolver<'a> {
    /// The sections that are wanted, and whether to write.
    written: BTreeMap<&'a str, bool>,
    seen: Vec<&'a str>,
    text: String,
    bindings: u32,
}

impl<'a> Resolver<'a> {
    /// Finds the sections that a file and what it imports want: what one of them writes, all of them have to write.
    fn gather(&mut self, source: &'a str) {
        for (name, mut sections) in source.lines().filter_map(import) {
            let mut writes = false;
            for section in &mut sections {
                match section {
                    "reads" | "writes" => writes = section == "writes",
                    _ => *self.written.entry(section).or_default() |= writes,
                }
            }
            self.gather(shared(name));
        }
    }

    fn append(&mut self, source: &'a str) {
        let mut wanted = true;
        let mut access = "read";
        for line in source.lines() {
            if let Some((name, _)) = import(line) {
                if !self.seen.contains(&name) {
                    self.seen.push(name);
                    self.append(shared(name));
                }
            } else if let Some(section) = line.strip_prefix("#section ") {
                let written = section.strip_prefix("written ");
                let writes = self.written.get(written.unwrap_or(section));
                wanted = writes.is_some_and(|writes| *writes || written.is_none());
                access = if writes == Some(&true) { "read_write" } else { "read" };
            } else if wanted {
                self.line(&line.replace("$access", access));
            }
        }
    }

    fn line(&mut self, line: &str) {
        match line.strip_prefix("@group(0) var") {
            Some(rest) => {
                self.text += &format!("@group(0) @binding({}) var{rest}", self.bindings);
                self.bindings += 1;
            }
            None => self.text += line,
        }
        self.text.push('\n');
    }
}

/// What a line imports: a name, and the words after it.
fn import(line: &str) -> Option<(&str, impl Iterator<Item = &str>)> {
    let mut words = line.strip_prefix("#import ")?.split_whitespace();
    Some((words.next()?, words))
}

fn shared(name: &str) -> &'static str {
    let known = SHARED.iter().chain(structs::WGSL).find(|(known, _)| *known == name);
    known.unwrap_or_else(|| panic!("wgsl imports {name}, which is neither a shared file nor a struct")).1
}
