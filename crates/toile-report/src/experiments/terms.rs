//! What each term of the model costs, and what it buys: the same scene with it and without.

mod purpose;
mod term;
mod trial;

pub use term::{Scene, Term};
pub use trial::{Outcome, Trial, outcome};

use crate::Experiment;
use crate::page::{Block, Cell, Section, Table};
use toile_lab::Distance;
use toile_lab::{Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "terms", title: "What each term costs and buys", minutes: [0.2, 1.2], run };

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let (n, frames) = lab.pick((13, 18), (33, 90));
    let caption = format!(
        "The same scene with a term of the model and without it. Sheets of 1 m × 1 m, {n} × {n} particles, 0.2 kg/m², springs of 20, 10 and 2 \
         N/m, threshold 5 %, hierarchical limits, two sweeps, 960 steps per second, {frames} frames of 1/60 s. hang: on two corners; \
         ball: laid on a sphere of radius 0.25 m; moving ball: on a sphere that swings 0.4 m to the side and back in 4 s, seen through \
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
    // Terms of the same scene share the run in which nothing is changed.
    let mut known: Vec<(Trial, Outcome)> = Vec::new();
    for (index, term) in Term::ALL.into_iter().enumerate() {
        let trials = [term.with(), term.without()];
        for (half, trial) in trials.into_iter().enumerate() {
            let share = (2 * index + half) as f64 / (2 * Term::ALL.len()) as f64;
            lab.say(share, &format!("{}, {}", term.name(), ["with it", "without"][half]))?;
            if !known.iter().any(|(done, _)| *done == trial) {
                known.push((trial, outcome(lab, trial, n, frames)?));
            }
        }
        let of = |trial: Trial| known.iter().find(|(done, _)| *done == trial).map(|(_, outcome)| outcome);
        let [Some(with), Some(without)] = trials.map(of) else { continue };
        let moved = Distance::between(&with.positions, &without.positions);
        table.push(vec![
            Cell::text(term.name()),
            Cell::text(term.scene().name()),
            Cell::number_or_missing(with.copies),
            Cell::number_or_missing(without.copies),
            Cell::number(1e3 * moved.rms),
            Cell::text(term.purpose()),
            Cell::number(term.measure(with)),
            Cell::number(term.measure(without)),
        ]);
    }
    let lead = "Model only what a scene needs: a term that is left out has no pass and no buffer. What each costs in a step, how far the cloth \
                ends from where it would with it, and the one number that the term is there for.";
    let mut section = EXPERIMENT.section(lead);
    section.blocks = vec![Block::Table(table)];
    Ok(section)
}
