//! What the lines of the picture mean, and how many there are.

use super::{LEVEL_CLASSES, put};
use std::collections::BTreeMap;

/// Distance from one line of the legend to the next [px].
const LINE: f32 = 20.0;

/// How many lines of each kind there are.
#[derive(Debug, Default)]
pub(super) struct Counts {
    /// Nodes and limits of each level, by how coarse it is.
    levels: BTreeMap<usize, [usize; 2]>,
    /// Limits from pins.
    pub(super) attachments: usize,
    /// Seams.
    pub(super) seams: usize,
}

impl Counts {
    /// Adds a level of a cloth.
    pub(super) fn add_level(&mut self, index: usize, node_count: usize, limit_count: usize) {
        let [nodes, limits] = self.levels.entry(index).or_default();
        *nodes += node_count;
        *limits += limit_count;
    }

    /// Writes the legend below `top` [px]; gives where it ends.
    pub(super) fn legend(&self, svg: &mut String, top: f32) -> f32 {
        let levels = self.levels.iter().map(|(index, [nodes, limits])| {
            let what = match index {
                0 => "limits of single springs".to_owned(),
                _ => format!("limits between {nodes} coarse particles"),
            };
            (format!("level{}", index.min(&(LEVEL_CLASSES - 1))), *limits, what)
        });
        let others = [
            ("attachment", self.attachments, "limits of the distance from a pin"),
            ("seam", self.seams, "seams; both sides of one have its number"),
        ];
        let others = others.map(|(class, count, what)| (class.to_owned(), count, what.to_owned()));
        let mut y = top;
        for (class, count, what) in levels.chain(others).filter(|(_, count, _)| *count > 0) {
            // A rectangle, so that the lines of the panels can be counted.
            put(
                svg,
                format_args!(
                    "<g class=\"{class}\" fill=\"none\"><polyline points=\"24,{0} 64,{0}\"/></g><text x=\"78\" y=\"{y}\">{count} {what}</text>\n",
                    y - 4.0
                ),
            );
            y += LINE;
        }
        y
    }
}
