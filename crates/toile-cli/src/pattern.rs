//! The flat panels of a cloth with the limits of its length on them, as SVG.

mod layout;
mod legend;
#[cfg(test)]
mod tests;

use glam::Vec2;
use layout::Layout;
use legend::Counts;
use std::collections::BTreeSet;
use std::fmt::{Arguments, Write};
use toile::model::{Limit, Merge, Model, NO_CORNER, SpringKind, Strand, path_chord};
use toile_report::page::escaped;

/// Golden section: the long limits of neighbouring strands do not lie beside each other.
const SPREAD: f64 = 0.618_034;

const STYLE: &str = "\
text{font:13px system-ui,sans-serif;fill:#1b1d22}\
.name{font-weight:600}\
.number{font-size:11px;fill:#a8327f;stroke:#fff;stroke-width:3px;paint-order:stroke;text-anchor:middle}\
path{fill:none;stroke-linecap:round;stroke-linejoin:round}\
.strand{stroke-width:.8}\
.warp{stroke:#0072b2}\
.weft{stroke:#c44e00}\
.diagonal{stroke:#b4bac3}\
.long{stroke-width:1.8;marker-start:url(#end);marker-end:url(#end)}\
.long.diagonal{stroke:#7f8793;stroke-width:1.1}\
.loose{stroke:#00a37a;stroke-width:1.2}\
.attachment{stroke:#d4b020;stroke-width:.4;stroke-opacity:.6}\
.seam{stroke:#a8327f;stroke-width:2.6}\
.edge{stroke:#1b1d22;stroke-width:1.4}";

/// A cloth before and after its seams are closed.
pub struct Pattern {
    /// Name of the garment or sheet.
    pub name: String,
    /// Its panels, where nothing is sewn.
    pub open: Model,
    /// The cloth when it is sewn; `None` for a sheet, which is so from the start.
    pub sewn: Option<Model>,
    /// Which particles of the panels each of the sewn cloth is.
    pub merge: Merge,
}

impl Pattern {
    /// The cloth whose limits are drawn.
    fn cloth(&self) -> &Model {
        self.sewn.as_ref().unwrap_or(&self.open)
    }
}

/// The panels of all cloths: strands as lines by direction, one long limit of each, the limits that lie on no strand, those from pins, and the seams.
pub fn draw(patterns: &[Pattern]) -> String {
    let mut panels = String::new();
    let mut counts = Counts::default();
    let mut size = Vec2::ZERO;
    for pattern in patterns {
        let layout = Layout::new(pattern, size.y);
        Drawing { pattern, layout: &layout, svg: &mut panels }.draw(&mut counts);
        size = Vec2::new(size.x.max(layout.size.x), layout.size.y);
    }
    size.y = counts.legend(&mut panels, size.y);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0} {1:.0}\" width=\"{0:.0}\" height=\"{1:.0}\">\
         <style>{STYLE}</style><defs><marker id=\"end\" viewBox=\"-2 -2 4 4\" markerWidth=\"3\" markerHeight=\"3\">\
         <circle r=\"1.2\" fill=\"#1b1d22\"/></marker></defs><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{panels}</svg>\n",
        size.x, size.y
    )
}

/// One cloth that is drawn.
struct Drawing<'a> {
    pattern: &'a Pattern,
    layout: &'a Layout,
    svg: &'a mut String,
}

impl Drawing<'_> {
    fn draw(mut self, counts: &mut Counts) {
        let cloth = self.pattern.cloth();
        for (place, name) in &self.layout.names {
            let [x, y] = place.to_array();
            put(self.svg, format_args!("<text class=\"name\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>\n", escaped(name)));
        }
        counts.attachments += self.attachments();
        let mut long = Vec::new();
        // Strands of long lines go over the same line as others that show it from edge to edge.
        for (strand, index) in cloth.strands.iter().filter(|strand| strand.stride == 1).zip(0..) {
            let particles = &cloth.strand_particles[strand.particles.start as usize..strand.particles.end as usize];
            let steps = self.layout.steps(particles);
            let direction = self.direction(particles, &steps);
            *counts.strands.entry(direction).or_default() += 1;
            self.path(&format!("strand {direction}"), &steps);
            long.push((direction, long_limit(cloth, strand, &steps, index)));
        }
        for limit in cloth.loose_limits() {
            self.path("loose", &self.loose(limit));
            counts.loose += 1;
        }
        // Diagonals below the others, of which there are fewer.
        long.sort_by_key(|(direction, _)| *direction != "diagonal");
        for (direction, steps) in long {
            self.path(&format!("long {direction}"), &steps);
        }
        for (class, sides) in [("edge", &self.layout.edges), ("seam", &self.layout.seam_sides)] {
            if !sides.is_empty() {
                self.path(class, sides);
            }
        }
        counts.seams += self.seam_numbers(counts.seams);
    }

    /// "warp", "weft" or "diagonal": by the springs that a strand lies on, and where it leads.
    fn direction(&self, particles: &[u32], steps: &[[u32; 2]]) -> &'static str {
        let springs = &self.pattern.cloth().springs;
        let ends = [particles[0].min(particles[1]), particles[0].max(particles[1])];
        let kind = springs.binary_search_by_key(&ends, |spring| spring.ends).map(|k| springs[k].kind);
        let way: Vec2 = steps.iter().map(|step| self.layout.way(*step).abs()).sum();
        match kind {
            Ok(SpringKind::Shear) => "diagonal",
            _ if way.y > way.x => "warp",
            _ => "weft",
        }
    }

    /// A limit in its panel; where it goes over a seam, to an end of the seam's side and on from it in the other panel.
    fn loose(&self, limit: &Limit) -> Vec<[u32; 2]> {
        let Pattern { open, .. } = self.pattern;
        let cloth = self.pattern.cloth();
        let steps = self.layout.steps(&limit.ends);
        if let [[from, to]] = steps[..] {
            // Both ends can lie in one panel and the limit go over a dart all the same.
            let mut quads = open.particle_quads.row(from as usize).iter();
            if quads.any(|quad| open.quads[*quad as usize].contains(&to)) {
                return steps;
            }
        }
        let near = |end: u32| -> BTreeSet<u32> {
            let quads = cloth.particle_quads.row(end as usize).iter().map(|quad| cloth.quads[*quad as usize]);
            quads.flatten().filter(|corner| *corner != NO_CORNER).collect()
        };
        let [a, b] = limit.ends;
        let ways = near(a).intersection(&near(b)).map(|middle| self.layout.steps(&[a, *middle, b])).collect::<Vec<_>>();
        ways.into_iter().find(|way| way.len() == 2).unwrap_or_default()
    }

    /// Draws the limits from pins; gives their number.
    fn attachments(&mut self) -> usize {
        let attachments = &self.pattern.cloth().attachments;
        for i in 0..attachments.row_count() as u32 {
            for attachment in attachments.row(i as usize) {
                self.path("attachment", &self.layout.steps(&[i, attachment.pin]));
            }
        }
        attachments.values.len()
    }

    /// Writes the number of each seam at the middle of both its sides; gives how many seams there are.
    fn seam_numbers(&mut self, before: usize) -> usize {
        let open = &self.pattern.open;
        for seam in 0..open.seam_names.len() as u32 {
            let pairs = || open.seam_pairs.iter().filter(move |pair| pair.seam == seam).map(|pair| pair.ends);
            let place = |end: u32| self.layout.places[end as usize];
            let count = pairs().count().max(1) as f32;
            let mean = pairs().map(|ends| place(ends[0])).sum::<Vec2>() / count;
            let from_mean = |ends: &[u32; 2]| place(ends[0]).distance_squared(mean);
            let middle = pairs().min_by(|a, b| from_mean(a).total_cmp(&from_mean(b)));
            for end in middle.into_iter().flatten() {
                let ([x, y], number) = (place(end).to_array(), before + seam as usize + 1);
                put(
                    self.svg,
                    format_args!("<text class=\"number\" x=\"{x:.1}\" y=\"{:.1}\">{number}</text>\n", y + 4.0),
                );
            }
        }
        open.seam_names.len()
    }

    /// Draws steps between particles of the panels as one line, which is broken where it goes over a seam.
    fn path(&mut self, class: &str, steps: &[[u32; 2]]) {
        let mut line = String::new();
        let mut here = None;
        for step in steps {
            let [from, to] = step.map(|end| self.layout.places[end as usize]);
            if here != Some(step[0]) {
                put(&mut line, format_args!("M{:.1} {:.1}", from.x, from.y));
            }
            put(&mut line, format_args!("L{:.1} {:.1}", to.x, to.y));
            here = Some(step[1]);
        }
        put(self.svg, format_args!("<path class=\"{class}\" d=\"{line}\"/>\n"));
    }
}

/// One of the longest limits of a strand, along the strand where it counts the way, in straight chords where it counts distances.
fn long_limit(cloth: &Model, strand: &Strand, steps: &[[u32; 2]], index: u32) -> Vec<[u32; 2]> {
    let top = strand.level_count - 1;
    let reach = 1_usize << top;
    let first = ((f64::from(index) * SPREAD).fract() * (steps.len() + 1 - reach) as f64) as usize;
    let length = |level: u32, k: usize| cloth.strand_lengths[strand.lengths_from(level) as usize + k];
    let way: f32 = (first..first + reach).map(|k| length(0, k)).sum();
    let along = &steps[first..first + reach];
    if length(top, first) < way * (1.0 - 1e-5) {
        along.chunks(path_chord(reach)).map(|chord| [chord[0][0], chord[chord.len() - 1][1]]).collect()
    } else {
        along.to_vec()
    }
}

fn put(svg: &mut String, part: Arguments<'_>) {
    svg.write_fmt(part).expect("a text takes every letter");
}
