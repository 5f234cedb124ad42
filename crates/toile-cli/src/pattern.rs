//! The flat panels of a cloth with the limits of its length on them, as SVG.

mod layout;
mod legend;
#[cfg(test)]
mod tests;

use glam::Vec2;
use layout::Layout;
use legend::Counts;
use std::fmt::{Arguments, Write};
use toile::model::{Level, Merge, Model};
use toile_report::page::escaped;

/// Levels with a colour of their own; those that are coarser have that of the last.
const LEVEL_CLASSES: usize = 5;

const STYLE: &str = "\
text{font:13px system-ui,sans-serif;fill:#1b1d22}\
.name{font-weight:600}\
.number{font-size:11px;fill:#a8327f;stroke:#fff;stroke-width:3px;paint-order:stroke;text-anchor:middle}\
path{fill:none;stroke-linecap:round;stroke-linejoin:round}\
.level0{stroke:#ccd0d6;stroke-width:.6}\
.level1{stroke:#0072b2;stroke-width:.8}\
.level2{stroke:#00a37a;stroke-width:1.1}\
.level3{stroke:#c44e00;stroke-width:1.4}\
.level4{stroke:#7a3fa0;stroke-width:1.8}\
circle{fill:#fff;stroke-width:1}\
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

/// The panels of all cloths: the limits of every level, the coarse particles between which those of the coarser ones lie, the limits from pins, and the seams.
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
         <style>{STYLE}</style><rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{panels}</svg>\n",
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
        for (level, index) in cloth.levels.iter().enumerate().map(|(index, level)| (level, index)) {
            self.level(level, index, counts);
        }
        for (class, sides) in [("edge", &self.layout.edges), ("seam", &self.layout.seam_sides)] {
            if !sides.is_empty() {
                self.path(class, sides);
            }
        }
        counts.seams += self.seam_numbers(counts.seams);
    }

    /// Draws the limits of a level: those of single springs where it is the cloth itself, else those between coarse particles, with these. A limit that goes
    /// over a seam is drawn where both its ends lie in one panel, else told in the legend alone.
    fn level(&mut self, level: &Level, index: usize, counts: &mut Counts) {
        let cloth = self.pattern.cloth();
        let class = format!("level{}", index.min(LEVEL_CLASSES - 1));
        let limits = cloth.level_limits(level);
        for ends in limits.keys() {
            let steps = self.layout.steps(&ends.map(|node| cloth.site(node)));
            if !steps.is_empty() {
                self.path(&class, &steps);
            }
        }
        if level.is_coarse() {
            let radius = 1.0 + index as f32;
            for node in level.nodes.clone() {
                for place in self.layout.places_of(cloth.site(node)) {
                    let [x, y] = place.to_array();
                    put(
                        self.svg,
                        format_args!("<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\"/>\n"),
                    );
                }
            }
        }
        counts.add_level(index, level.nodes.len(), limits.len());
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

fn put(svg: &mut String, part: Arguments<'_>) {
    svg.write_fmt(part).expect("a text takes every letter");
}
