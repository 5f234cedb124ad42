//! Limits that span many cells: what one of them holds, one sweep over single springs would take a sweep per cell to hold.

use crate::colouring::{Pair, sort_by_colour};
use crate::strands::{Cloth, Stretch};
use crate::{Attachment, Csr, Limit};
use glam::DVec2;
use std::ops::Range;

/// Cells along the longest diagonals: farther than this a sweep along warp and weft leaves them nothing to do.
const DIAGONAL_CELLS: usize = 8;
/// Cells along the longest limits of a small cloth.
const CELLS_MIN: usize = 8;
/// Part of a square cloth that the longest limits span at least [1].
const CELLS_PART: f64 = 1.0 / 16.0;
/// Most pins, or groups of neighbouring pins, that one particle is attached to.
const ATTACHMENT_COUNT: usize = 4;

/// Limits that span 2, 4, 8… cells along warp, weft and the diagonals, each as long as the flat cloth between its ends times
/// `stretch`. Sorted by level, the longest first, and inside a level by colour; with the range of each colour.
pub(crate) fn long_limits(cloth: &Cloth<'_>, stretch: f32) -> (Vec<Limit>, Vec<Range<u32>>) {
    let cells_max = CELLS_MIN.max(((cloth.particle_count as f64).sqrt() * CELLS_PART).round() as usize);
    let rims = cloth.rims();
    let mut sides = cloth.side_strands(&rims);
    let mut diagonals = cloth.diagonal_strands(&rims);
    let mut levels = Vec::new();
    let mut cells = 2;
    while cells <= cells_max {
        let mut stretches = sides.doubled();
        if cells <= DIAGONAL_CELLS {
            stretches.extend(diagonals.doubled());
        }
        levels.push(level(&stretches, stretch, cloth.particle_count));
        cells *= 2;
    }
    let mut limits: Vec<Limit> = Vec::new();
    let mut colours = Vec::new();
    for (level, level_colours) in levels.into_iter().rev() {
        let first = limits.len() as u32;
        limits.extend(level);
        colours.extend(level_colours.into_iter().map(|colour| first + colour.start..first + colour.end));
    }
    (limits, colours)
}

fn level(stretches: &[Stretch], stretch: f32, particle_count: usize) -> (Vec<Limit>, Vec<Range<u32>>) {
    let limit = |s: &Stretch| {
        let rest_length = s.length as f32;
        Limit { ends: s.ends, rest_length, max_length: stretch * rest_length }
    };
    let mut limits: Vec<Limit> = stretches.iter().map(limit).collect();
    let pairs: Vec<Pair> = stretches.iter().map(|s| Pair { ends: s.ends, family: Some(s.family) }).collect();
    let colours = sort_by_colour(&mut limits, &pairs, particle_count);
    (limits, colours)
}

/// For each particle of a convex panel the pins that hold it: of each group of neighbouring pins the nearest one, and of the groups
/// the nearest ones. Kim, Chentanez and Müller, Long Range Attachments, 2012.
pub(crate) fn attachments(
    flat: &[DVec2],
    inverse_masses: &[f32],
    groups: &[Vec<u32>],
    stretch: f32,
) -> Csr<Attachment> {
    let rows = flat.iter().zip(inverse_masses).map(|(here, inverse_mass)| {
        let nearest = |group: &Vec<u32>| {
            let distances = group.iter().map(|&pin| (flat[pin as usize].distance(*here), pin));
            distances.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
        };
        let mut pins: Vec<(f64, u32)> = groups.iter().filter_map(nearest).collect();
        pins.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let count = if *inverse_mass > 0.0 { pins.len().min(ATTACHMENT_COUNT) } else { 0 };
        pins.truncate(count);
        pins.into_iter().map(|(distance, pin)| Attachment { pin, max_length: stretch * distance as f32 })
    });
    Csr::from_rows(rows)
}
