//! What a garment must be like: panels that stand somewhere, seams between edges that exist.

use crate::check::{COMPONENTS, UNIT, check_vector};
use crate::{Curve, EdgeRef, Garment, OutOfRange, Panel};
use glam::DVec2;

impl Garment {
    /// An error where a number is one that no garment has, or a seam has an edge that does not exist.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number.
    pub fn check(&self) -> Result<(), OutOfRange> {
        self.panels.iter().try_for_each(|panel| check_panel(&format!("{}: panel {}", self.name, panel.name), panel))?;
        for (at, seam) in self.seams.iter().enumerate() {
            for EdgeRef { panel, edge } in seam.sides {
                let of = |part: &str| format!("{}: {part} of seam {at}", self.name);
                check_index(of("panel"), panel, self.panels.len())?;
                check_index(of("edge"), edge, self.panels[panel].edges.len())?;
            }
        }
        Ok(())
    }
}

fn check_panel(name: &str, panel: &Panel) -> Result<(), OutOfRange> {
    check_vector(&format!("{name}: translation"), panel.placement.translation, &COMPONENTS, "m")?;
    OutOfRange::check(format!("{name}: rotation"), panel.placement.rotation.length(), &UNIT, "")?;
    for (at, edge) in panel.edges.iter().enumerate() {
        let place = |part: &str, place: DVec2| {
            check_vector(&format!("{name}: {part} of edge {at}"), place.extend(0.0), &COMPONENTS, "m")
        };
        place("start", edge.start)?;
        match edge.curve {
            Curve::Straight => {}
            Curve::Quadratic { control } => place("control point", control)?,
            Curve::Cubic { controls } => {
                controls.into_iter().try_for_each(|control| place("control point", control))?
            }
            Curve::Arc { radius, .. } => {
                OutOfRange::check(format!("{name}: radius of edge {at}"), radius, &(0.0..=*COMPONENTS.end()), "m")?;
            }
        }
    }
    Ok(())
}

/// An error where an index is not below a count.
fn check_index(name: String, index: usize, count: usize) -> Result<(), OutOfRange> {
    OutOfRange::check(name, index as f64, &(0.0..=count as f64 - 1.0), "")
}
