//! Hard cases, each with what must hold and what happened.

mod bodies;
mod broken;
mod case;
mod cloth;
mod rest;

pub use case::{Case, Outcome};

use crate::Experiment;
use crate::page::{Block, Cell, Section, Table};
use toile_lab::{Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment { name: "hard_cases", title: "Hard cases", minutes: [0.3, 1.5], run };

/// Every case, in the order of the table.
pub const CASES: &[Case] = &[
    cloth::STIFFNESS,
    cloth::MASSES,
    cloth::NEEDLE,
    cloth::CRUMPLED,
    cloth::COINCIDENT,
    cloth::WEIGHTLESS,
    cloth::HEAVY,
    cloth::NO_THRESHOLD,
    cloth::FAR_AWAY,
    bodies::INSIDE,
    bodies::TELEPORT,
    bodies::SPIN,
    bodies::BULLET,
    rest::HANGING,
    rest::LYING,
    broken::NAN,
    broken::INFINITY,
];

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let caption = format!(
        "Hard cases under the default settings (hierarchical limits, two sweeps, 60 frames per second) unless the case says otherwise. The sheet is 1 m × 1 m of \
         0.2 kg/m², springs of 20, 10 and 2 N/m, threshold 5 %, 12 × 12 particles, on two held corners or free, for a quarter of a second, next to bodies for 0.4 s. {}",
        lab.place()
    );
    let mut table = Table::new(caption, &[["case", ""], ["must hold", ""], ["what happened", ""], ["held", ""]]);
    let mut failed = Vec::new();
    for (index, case) in CASES.iter().enumerate() {
        lab.say(index as f64 / CASES.len() as f64, case.name)?;
        let outcome = (case.run)(lab)?;
        if !outcome.held {
            failed.push(case.name);
        }
        let held = if outcome.held { "yes" } else { "no" };
        table.push([case.name, case.must, &outcome.happened, held].map(Cell::text).to_vec());
    }
    let lead = if failed.is_empty() {
        format!("All {} cases held. Nothing panicked, hung, or went silently non-finite.", CASES.len())
    } else {
        format!("{} of {} cases did not hold: {}.", failed.len(), CASES.len(), failed.join("; "))
    };
    let mut section = EXPERIMENT.section(lead);
    section.blocks = vec![Block::Table(table)];
    Ok(section)
}
