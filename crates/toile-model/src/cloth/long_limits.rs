//! Limits that span many cells: what one of them holds, a sweep over single springs would take a sweep per cell to hold.

use crate::cloth::assemble::{aim, stretched};
use crate::cloth::lines::{Cloth, Line};
use crate::{Attachment, Csr, Limit, Model, Strand};
use glam::DVec2;
use std::ops::Range;

/// Particles of a strand at most: what a workgroup holds in its memory.
pub const STRAND_PARTICLES_MAX: u32 = 512;
/// Particles of a strand at least: what is shorter keeps no workgroup busy, and the passes over single springs hold it.
const STRAND_PARTICLES_MIN: usize = 8;
/// Chords of a long limit: around a body the cloth lies along a path, which a single chord cuts short.
const PATH_CHORDS: usize = 4;
/// Cells along the longest limits of a small cloth.
const CELLS_MIN: usize = 8;
/// Part of a square cloth that the longest limits span at most [1].
const CELLS_PART: f64 = 1.0 / 8.0;
/// Most pins, or groups of neighbouring pins, that one particle is attached to.
const ATTACHMENT_COUNT: usize = 4;

impl Model {
    /// Fills the strands of a cloth.
    pub(crate) fn add_strands(&mut self, cloth: &Cloth<'_>) {
        let cells_max = CELLS_MIN.max(((cloth.particle_count as f64).sqrt() * CELLS_PART).round() as usize);
        let rims = cloth.rims();
        let [sides, diagonals] = [cloth.side_lines(), cloth.diagonal_lines()].map(|lines| lines.cut(cells_max));
        let lines = || diagonals.iter().chain(&sides).filter(|line| line.particles.len() >= STRAND_PARTICLES_MIN);
        let coarse = lines().flat_map(|line| coarse_parts(line, cells_max));
        let parts: Vec<Part<'_>> = coarse.chain(lines().flat_map(|line| fine_parts(line, cells_max))).collect();
        let colours = part_colours(&parts, cloth.particle_count);
        for colour in 0..colours.iter().max().map_or(0, |last| last + 1) {
            let first = self.strands.len() as u32;
            for (part, _) in parts.iter().zip(&colours).filter(|(_, c)| **c == colour) {
                self.add_strand(part, cloth, &rims);
            }
            self.strand_colours.push(first..self.strands.len() as u32);
        }
    }

    fn add_strand(&mut self, part: &Part<'_>, cloth: &Cloth<'_>, rims: &Csr<[u32; 2]>) {
        let start = self.strand_particles.len() as u32;
        self.strand_particles.extend(part.particles());
        let mut strand = Strand {
            particles: start..self.strand_particles.len() as u32,
            stride: part.stride as u32,
            lengths: self.strand_lengths.len() as u32,
            level_count: 0,
        };
        let aim = aim(self.rule);
        let count = part.particles().len();
        let mut reach = 1;
        while reach < count && reach * part.stride <= part.cells_max {
            let chord = path_chord(reach);
            let chord_length = |place| {
                let span = cloth.span_from(part.line, place, chord * part.stride, rims);
                stretched(span.length as f32, aim * span.threshold as f32)
            };
            let lengths: Vec<f32> = part.places().take(count - chord).map(chord_length).collect();
            let path = |first: usize| lengths[first..=first + reach - chord].iter().step_by(chord).sum::<f32>();
            self.strand_lengths.extend((0..count - reach).map(path));
            strand.level_count += 1;
            reach *= 2;
        }
        self.strands.push(strand);
    }

    /// The limits of single springs that no strand holds.
    pub fn loose_limits(&self) -> impl Iterator<Item = &Limit> {
        let mut on_strands: Vec<[u32; 2]> = self.strand_limits().map(|(ends, _)| ends).collect();
        on_strands.sort_unstable();
        self.limits.iter().filter(move |limit| on_strands.binary_search(&limit.ends).is_err())
    }

    /// Every limit along every strand, strand by strand, from those over one step to the longest: its two particles and its maximum length [m].
    pub fn strand_limits(&self) -> impl Iterator<Item = ([u32; 2], f32)> {
        self.strands.iter().flat_map(move |strand| {
            let particles = &self.strand_particles[strand.particles.start as usize..strand.particles.end as usize];
            (0..strand.level_count).flat_map(move |level| {
                let reach = 1 << level;
                let lengths = &self.strand_lengths[strand.lengths_from(level) as usize..];
                particles
                    .iter()
                    .zip(&particles[reach..])
                    .zip(lengths)
                    .map(|((a, b), &max_length)| ([*a.min(b), *a.max(b)], max_length))
            })
        })
    }
}

impl Strand {
    /// Index in [`Model::strand_lengths`] of the first limit of a level: level k has one for every two particles that are 2^k steps
    /// apart, after those of the levels below.
    pub fn lengths_from(&self, level: u32) -> u32 {
        let count = self.particles.end - self.particles.start;
        self.lengths + level * count - ((1 << level) - 1)
    }
}

/// Steps that one chord of a limit over so many steps of a strand spans: over four steps and more it goes along a path of four chords,
/// over one and two along one.
pub fn path_chord(steps: usize) -> usize {
    if steps < PATH_CHORDS { steps } else { steps / PATH_CHORDS }
}

/// Particles of a line that become one strand: as many edges apart each, with limits over at most so many edges of the line.
struct Part<'a> {
    line: &'a Line,
    first: usize,
    end: usize,
    stride: usize,
    cells_max: usize,
}

impl Part<'_> {
    /// Where its particles stand in the line.
    fn places(&self) -> impl ExactSizeIterator<Item = usize> {
        (self.first..self.end).step_by(self.stride)
    }

    fn particles(&self) -> impl ExactSizeIterator<Item = u32> {
        self.places().map(|place| self.line.particles[place])
    }
}

/// Edges from one particle to the next of the strands that hold the longest limits of a line: 1 where one strand takes all of it.
fn stride_of(line: &Line, cells_max: usize) -> usize {
    let fewest = line.particles.len().div_ceil(STRAND_PARTICLES_MAX as usize);
    fewest.next_power_of_two().min(1 << (cells_max / 2).ilog2())
}

/// The strands with the longest limits of a line. Those of a line that is too long for one lie between one another, each on every second particle,
/// or fourth, or eighth, and so on: no limit ends where a strand is full, or the cloth would be stretched there.
fn coarse_parts(line: &Line, cells_max: usize) -> impl Iterator<Item = Part<'_>> {
    let stride = stride_of(line, cells_max);
    let count = line.particles.len();
    let pieces = pieces(count, STRAND_PARTICLES_MAX as usize * stride);
    pieces.flat_map(move |piece| {
        (piece.start..piece.start + stride).map(move |first| Part { line, first, end: piece.end, stride, cells_max })
    })
}

/// The strands with the limits that are too short for those of [`coarse_parts`].
fn fine_parts(line: &Line, cells_max: usize) -> impl Iterator<Item = Part<'_>> {
    let stride = stride_of(line, cells_max);
    let count = if stride > 1 { line.particles.len() } else { 0 };
    pieces(count, STRAND_PARTICLES_MAX as usize).map(move |piece| Part {
        line,
        first: piece.start,
        end: piece.end,
        stride: 1,
        cells_max: stride / 2,
    })
}

/// As few pieces as there can be of at most so many particles, all as long.
fn pieces(count: usize, count_max: usize) -> impl Iterator<Item = Range<usize>> {
    let length = count.div_ceil(count.div_ceil(count_max).max(1)).max(1);
    (0..count).step_by(length).map(move |start| start..count.min(start + length))
}

/// A colour for each part: no two of a colour share a particle. In their order, so that the diagonals of a grid come before its warp and weft,
/// as among single springs: what comes last is drawn out by nothing.
fn part_colours(parts: &[Part<'_>], particle_count: usize) -> Vec<u32> {
    let mut used: Vec<Vec<u32>> = vec![Vec::new(); particle_count];
    let colour = |part: &Part<'_>| {
        let is_free = |colour: &u32| part.particles().all(|p| !used[p as usize].contains(colour));
        let colour = (0..).find(is_free).expect("there is no end of colours");
        part.particles().for_each(|p| used[p as usize].push(colour));
        colour
    };
    parts.iter().map(colour).collect()
}

impl Model {
    /// For each particle of a convex panel the pins that hold it: of each group of neighbouring pins the nearest one, and of the groups
    /// the nearest ones. Kim, Chentanez and Müller, Long Range Attachments, 2012.
    pub(crate) fn attachments(&self, flat: &[DVec2], groups: &[Vec<u32>]) -> Csr<Attachment> {
        let aim = aim(self.rule);
        let rows = flat.iter().zip(&self.inverse_masses).map(|(here, inverse_mass)| {
            let nearest = |group: &Vec<u32>| {
                let distances = group.iter().map(|&pin| (flat[pin as usize].distance(*here), pin));
                distances.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            };
            let mut pins: Vec<(f64, u32)> = groups.iter().filter_map(nearest).collect();
            pins.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let count = if *inverse_mass > 0.0 { pins.len().min(ATTACHMENT_COUNT) } else { 0 };
            pins.truncate(count);
            pins.into_iter().map(move |(distance, pin)| {
                let threshold = self.threshold.along(*here - flat[pin as usize]) as f32;
                Attachment { pin, max_length: stretched(distance as f32, aim * threshold) }
            })
        });
        Csr::from_rows(rows)
    }
}
