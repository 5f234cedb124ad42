//! Saboteurs: with any one sign of its WGSL flipped, a kernel no longer agrees with its reference.

use crate::kernels::{difference, input};
use std::collections::BTreeMap;
use toile_kernels::{Kernel, TABLE};
use toile_lab::kernels::{Compiled, VARIANTS};
use toile_workspace::gpu;

/// Lines that a flipped sign does not break on these inputs, each with its reason.
const SPARED: &[&str] = &[
    // The second dimension of a dispatch begins beyond 65 535 workgroups.
    "return id.x + id.y * (groups.x * WORKGROUP_SIZE);",
    "let partial = group.x + group.y * groups.x;",
    "let item = group.x + group.y * groups.x;",
    // The rim of the maps is empty, so what lies beyond it is nothing too.
    "if !(left >= 0.0 && left + 1.0 < f32(map_box.columns) && top >= 0.0 && top + 1.0 < f32(map_box.rows)) {",
];

/// One sign of a line: the line, and where in it the sign stands.
type Sign = (String, usize);

/// The WGSL of a kernel with one sign flipped, for every sign.
fn sabotaged(source: &str) -> Vec<(Sign, String)> {
    let mut all = Vec::new();
    let lines: Vec<&str> = source.lines().collect();
    for (number, line) in lines.iter().enumerate() {
        let code = line.split("//").next().unwrap_or_default();
        if SPARED.contains(&code.trim()) {
            continue;
        }
        let unary =
            code.match_indices('-').filter(|(i, _)| !code[i + 1..].starts_with([' ', '>'])).map(|(i, _)| (i, "-", ""));
        let binary = [(" + ", " - "), (" - ", " + ")];
        let binary =
            binary.iter().flat_map(|(sign, flip)| code.match_indices(sign).map(move |(i, _)| (i, *sign, *flip)));
        for (place, sign, flipped) in unary.chain(binary) {
            let changed = format!("{}{flipped}{}", &line[..place], &line[place + sign.len()..]);
            let text: Vec<&str> =
                lines.iter().enumerate().map(|(i, l)| if i == number { changed.as_str() } else { l }).collect();
            all.push(((line.trim().to_owned(), place), text.join("\n")));
        }
    }
    all
}

/// Whether the comparison with the reference finds the sabotage.
fn is_found(kernel: Kernel, source: &str) -> bool {
    // A sign whose flip does not even compile cannot be wrong by mistake.
    let Some(compiled) = Compiled::new(gpu(), kernel, source) else { return true };
    VARIANTS.iter().any(|variant| difference(&compiled, kernel, &input(kernel, 1757, *variant)).is_some())
}

/// What to change in kernels that have no sign of their own.
fn other_sabotage(kernel: Kernel, source: &str) -> Option<String> {
    let (from, to) = match kernel {
        Kernel::StateCopy => ("= velocities[i];", "= -velocities[i];"),
        Kernel::LimitZero => (", -dot(", ", dot("),
        _ => return None,
    };
    assert!(source.contains(from), "{}: no {from}", kernel.name());
    Some(source.replacen(from, to, 1))
}

#[test]
fn every_flipped_sign_is_found() {
    // Shared files have functions that not every kernel calls, so a sign counts as found once one kernel finds it.
    let mut found: BTreeMap<Sign, bool> = BTreeMap::new();
    for row in TABLE {
        let source = row.kernel.source();
        let mut any = other_sabotage(row.kernel, &source).is_some_and(|source| is_found(row.kernel, &source));
        for (sign, source) in sabotaged(&source) {
            let found = found.entry(sign).or_default();
            if !*found || !any {
                let here = is_found(row.kernel, &source);
                *found |= here;
                any |= here;
            }
        }
        assert!(any, "{}: no sabotage is found", row.kernel.name());
    }
    assert!(found.len() > 60, "only {} signs were flipped", found.len());
    let missed: Vec<_> = found.iter().filter(|(_, found)| !**found).map(|((line, _), _)| line).collect();
    assert!(missed.is_empty(), "nothing sees a flipped sign in\n{missed:#?}");
}
