//! No two limits or seam pairs of a colour share a particle: a dispatch of one colour never races.

use std::collections::HashSet;
use std::fmt::Write;
use std::ops::Range;
use toile_lab::fixtures::{GARMENTS, SCENES, garment, scene, settings, sheet_model};
use toile_model::Model;

/// Two items of one colour that share a particle, or an item that no colour has.
fn fault(name: &str, ends: &[[u32; 2]], colours: &[Range<u32>]) -> Option<String> {
    let mut next = 0;
    for (colour, range) in colours.iter().enumerate() {
        if range.start != next || range.is_empty() {
            return Some(format!("{name}: colour {colour} is {range:?} after {next} items"));
        }
        next = range.end;
        let mut taken = HashSet::new();
        for pair in &ends[range.start as usize..range.end as usize] {
            for end in pair {
                if !taken.insert(*end) {
                    return Some(format!("{name}: colour {colour} has particle {end} twice"));
                }
            }
        }
    }
    (next as usize != ends.len()).then(|| format!("{name}: {next} of {} have a colour", ends.len()))
}

fn check(name: &str, model: &Model) {
    let limits: Vec<_> = model.limits.iter().map(|limit| limit.ends).collect();
    let pairs: Vec<_> = model.seam_pairs.iter().map(|pair| pair.ends).collect();
    assert_eq!(fault(name, &limits, &model.limit_colours), None);
    assert_eq!(fault(&format!("{name}, seams"), &pairs, &model.seam_colours), None);
}

fn sheet(name: &str, n: u32) -> Model {
    sheet_model(&scene(name, &[("n", &n.to_string())]))
}

#[test]
fn a_grid_has_eight_colours() {
    for n in [5, 16, 33, 64, 65] {
        let model = sheet("hang", n);
        check(&format!("hang {n}"), &model);
        assert_eq!(model.colour_count(), 8, "n = {n}");
    }
}

#[test]
fn no_two_of_a_colour_share_a_particle() {
    let mut text = String::new();
    let mut note = |name: &str, model: &Model| {
        check(name, model);
        writeln!(
            text,
            "{name}: {} particles, {} quads, {} springs, {} limits in {} colours, {} seam pairs in {} colours",
            model.particle_count(),
            model.quad_count(),
            model.spring_count(),
            model.limits.len(),
            model.colour_count(),
            model.seam_pair_count(),
            model.seam_colours.len(),
        )
        .expect("text");
    };
    for name in SCENES {
        note(name, &sheet(name, 64));
    }
    for name in GARMENTS {
        let open = Model::from_garment(&garment(name), &settings(0.02)).unwrap_or_else(|error| panic!("{error}"));
        note(&format!("{name}, open"), &open);
        note(&format!("{name}, sewn"), &open.sewn().0);
    }
    insta::assert_snapshot!(text);
}

/// The saboteur: one limit moved into the colour before its own.
#[test]
fn a_limit_of_the_wrong_colour_is_found() {
    let model = sheet("hang", 16);
    let limits: Vec<_> = model.limits.iter().map(|limit| limit.ends).collect();
    let mut colours = model.limit_colours.clone();
    colours[0].end += 1;
    colours[1].start += 1;
    assert!(fault("sabotaged", &limits, &colours).is_some());
}
