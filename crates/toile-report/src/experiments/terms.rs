//! What each term of the model costs, and what it buys: the same scene with it and without.

mod ways;

pub use ways::{Outcome, Term, Way, outcome};

use crate::distance::Distance;
use crate::page::{Block, Cell, Section, Table};
use crate::{Experiment, Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "terms", title: "What each term costs and buys", minutes: [0.7, 6.0], run };

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let (n, frames) = lab.pick((17, 45), (49, 120));
    let caption = format!(
        "The same scene with a term of the model and without it. Sheets of 1 m × 1 m, {n} × {n} particles, 0.2 kg/m², springs of 20, 10 and 2 \
         N/m, threshold 5 %, hierarchical limits, four sweeps, 960 steps per second, {frames} frames of 1/60 s. hang: on two corners; \
         ball: dropped on a sphere of radius 0.25 m; moving ball: on a sphere that swings 0.4 m to the side and back in 4 s, seen through \
         maps with texels of 1 cm. {}",
        lab.place()
    );
    let columns = [
        ["term", ""],
        ["scene", ""],
        ["step with it", "state copies"],
        ["step without", "state copies"],
        ["difference of the ends, mean", "mm"],
        ["what it is for", ""],
        ["with it", ""],
        ["without", ""],
    ];
    let mut table = Table::new(&caption, &columns);
    for (index, term) in Term::ALL.into_iter().enumerate() {
        let [with, without] = [Way::With, Way::Without].map(|way| (index, way));
        let mut measured = Vec::new();
        for (index, way) in [with, without] {
            let share = (2 * index + measured.len()) as f64 / (2 * Term::ALL.len()) as f64;
            lab.say(share, &format!("{}, {}", term.name(), way.word()))?;
            measured.push(outcome(lab, term, way, n, frames)?);
        }
        let [with, without] = [&measured[0], &measured[1]];
        let moved = Distance::between(&with.positions, &without.positions);
        table.push(vec![
            Cell::text(term.name()),
            Cell::text(term.scene()),
            Cell::number(with.copies),
            Cell::number(without.copies),
            Cell::number(1e3 * moved.rms),
            Cell::text(term.purpose()),
            Cell::number(with.measure),
            Cell::number(without.measure),
        ]);
    }
    let lead = "Model only what a scene needs: a term that is left out has no pass and no buffer. What each costs in a step, how far the cloth \
                ends from where it would with it, and the one number that the term is there for. On software Vulkan at this size a step \
                is mostly the price of its dispatches, so the number of passes decides, not their arithmetic.";
    let mut section = Section::new(&EXPERIMENT, lead);
    section.blocks = vec![Block::Table(table)];
    Ok(section)
}
