//! What the lines of the picture mean, and how many there are.

use super::put;
use std::collections::BTreeMap;

/// Distance from one line of the legend to the next [px].
const LINE: f32 = 20.0;

/// How many lines of each kind there are.
#[derive(Debug, Default)]
pub(super) struct Counts {
    /// Strands by direction.
    pub(super) strands: BTreeMap<&'static str, usize>,
    /// Limits that lie on no strand.
    pub(super) loose: usize,
    /// Limits from pins.
    pub(super) attachments: usize,
    /// Seams.
    pub(super) seams: usize,
}

impl Counts {
    /// Writes the legend below `top` [px]; gives where it ends.
    pub(super) fn legend(&self, svg: &mut String, top: f32) -> f32 {
        let strand = |direction: &str| self.strands.get(direction).copied().unwrap_or(0);
        let all: usize = self.strands.values().sum();
        let rows = [
            ("strand warp", strand("warp"), "strands along the warp: limits over 2, 4, 8… edges"),
            ("strand weft", strand("weft"), "strands along the weft"),
            ("strand diagonal", strand("diagonal"), "strands along diagonals"),
            ("long warp", all, "long limits, one of each strand"),
            ("loose", self.loose, "limits of single springs that lie on no strand"),
            ("attachment", self.attachments, "limits of the distance from a pin"),
            ("seam", self.seams, "seams; both sides of one have its number"),
        ];
        let mut y = top;
        for (class, count, what) in rows.into_iter().filter(|(_, count, _)| *count > 0) {
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
