//! Stitches: which edges become one seam.

use crate::error::{Fault, Found, Place};
use crate::garment::garment_json::{SideJson, StitchPart};
use std::collections::HashMap;
use toile_scene::{EdgeRef, Panel, Seam};

/// Converts a stitch; `numbers` finds a panel by its name; `sewn` remembers which stitch took an edge.
pub(crate) fn convert(
    index: usize,
    stitch: &[StitchPart],
    panels: &[Panel],
    numbers: &HashMap<&str, usize>,
    sewn: &mut HashMap<EdgeRef, usize>,
) -> Result<Seam, Found> {
    let malformed = |message: &str| Found::malformed(Place::Stitch(index), message);
    let (first, second, right_wrong) = match stitch {
        [StitchPart::Side(first), StitchPart::Side(second)] => (first, second, false),
        [StitchPart::Side(first), StitchPart::Side(second), StitchPart::Flag(flag)] => {
            if flag != "right_wrong" {
                return Err(malformed(&format!("its third entry \"{flag}\" is not \"right_wrong\"")));
            }
            (first, second, true)
        }
        _ => {
            return Err(malformed("it must name two edges, and may add \"right_wrong\""));
        }
    };
    let side = |side: &SideJson| {
        let Some(panel) = numbers.get(side.panel.as_str()).copied() else {
            let known = panels.iter().map(|panel| panel.name.clone()).collect();
            let fault = Fault::Unknown { what: "panel", name: side.panel.clone(), known };
            return Err(Found::at(Place::Stitch(index), fault));
        };
        let count = panels[panel].edges.len();
        match usize::try_from(side.edge).ok().filter(|edge| *edge < count) {
            Some(edge) => Ok(EdgeRef { panel, edge }),
            None => {
                let message =
                    format!("panel \"{}\" has no edge {}: its edges are 0 to {}", side.panel, side.edge, count - 1);
                Err(malformed(&message))
            }
        }
    };
    let sides = [side(first)?, side(second)?];
    if sides[0] == sides[1] {
        let message = format!("edge {} of panel \"{}\" is stitched to itself", first.edge, first.panel);
        return Err(malformed(&message));
    }
    for (side, written) in sides.iter().zip([first, second]) {
        if let Some(known) = sewn.insert(*side, index) {
            let message =
                format!("edge {} of panel \"{}\" is already sewn by stitch {known}", written.edge, written.panel);
            return Err(malformed(&message));
        }
    }
    let mut seam = Seam::new(sides);
    seam.right_wrong = right_wrong;
    Ok(seam)
}
