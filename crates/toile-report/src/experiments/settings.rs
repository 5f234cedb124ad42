//! How far the rest shape moves when a setting that should not matter changes.

use crate::Experiment;
use crate::experiments::rest::{Rest, RestScene, RestSettings, come_to_rest};
use crate::page::{Block, Cell, Section, Table};
use toile_lab::Distance;
use toile_lab::{Lab, LabError};

/// The row of the table.
pub const EXPERIMENT: Experiment =
    Experiment { name: "settings", title: "Settings do not change the answer", minutes: [0.3, 2.0], run };

/// A change of the settings that should leave the rest shape where it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Half the step.
    Step,
    /// Twice the sweeps.
    Sweeps,
    /// Half the spacing.
    Resolution,
    /// Half the frame rate.
    FrameRate,
}

/// Every change, and what the report calls it.
pub const CHANGES: [(Change, &str); 4] = [
    (Change::Step, "half the step"),
    (Change::Sweeps, "twice the sweeps"),
    (Change::FrameRate, "30 frames per second instead of 60"),
    (Change::Resolution, "half the spacing"),
];

impl Change {
    /// The settings with this change.
    pub fn of(self, settings: RestSettings) -> RestSettings {
        match self {
            Change::Step => RestSettings { step_division: 2 * settings.step_division, ..settings },
            Change::Sweeps => RestSettings { sweeps: 2 * settings.sweeps, ..settings },
            Change::Resolution => RestSettings { n: 2 * settings.n - 1, ..settings },
            Change::FrameRate => RestSettings { frame_rate: 0.5 * settings.frame_rate, ..settings },
        }
    }
}

/// How far the rest shape of a scene moves [m] under a change, and the time that the changed cloth took to rest [s]; `rest` is where it
/// rests with the settings as they are.
pub fn moved_by(
    lab: &Lab,
    scene: RestScene,
    settings: RestSettings,
    rest: &Rest,
    change: Change,
) -> Result<(Distance, f64), LabError> {
    let after = change.of(settings);
    let changed = come_to_rest(lab, scene, after)?;
    let moved = Distance::between_meshes(&rest.positions, settings.n, &changed.positions, after.n);
    Ok((moved, changed.seconds))
}

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let n = lab.pick(7, 33);
    let caption = format!(
        "How far the particles of a cloth at rest move when one setting changes. Scenes: {}; {}. {n} × {n} particles of 0.2 kg/m², \
         springs of 20, 10 and 2 N/m, threshold 5 %, hierarchical limits, 960 steps per second of two sweeps each, 60 frames per \
         second, damped by 20 /s until no particle is faster than 2 mm/s. {}",
        RestScene::Hammock.description(),
        RestScene::Cap.description(),
        lab.place()
    );
    let columns =
        [["scene", ""], ["change", ""], ["moved, mean", "mm"], ["moved, farthest", "mm"], ["time to rest", "s"]];
    let mut table = Table::new(&caption, &columns);
    let mut worst: [f64; 4] = [0.0; 4];
    let scenes = [("hammock", RestScene::Hammock), ("cap", RestScene::Cap)];
    let mut done = 0.0;
    for (name, scene) in scenes {
        let settings = RestSettings::new(n);
        lab.say(done / 10.0, name)?;
        let rest = come_to_rest(lab, scene, settings)?;
        for ((change, words), worst) in CHANGES.into_iter().zip(&mut worst) {
            done += 1.0;
            lab.say(done / 10.0, &format!("{name}, {words}"))?;
            let (moved, seconds) = moved_by(lab, scene, settings, &rest, change)?;
            *worst = worst.max(moved.max);
            table.push(vec![
                Cell::text(name),
                Cell::text(words),
                Cell::number(1e3 * moved.rms),
                Cell::number(1e3 * moved.max),
                Cell::number(seconds),
            ]);
        }
        done += 1.0;
    }
    let told: Vec<String> = CHANGES
        .iter()
        .zip(worst)
        .map(|((_, words), worst)| format!("{words} {}", Cell::number(1e3 * worst).shown()))
        .collect();
    let lead = format!(
        "A rest shape should belong to the cloth, not to the numbers of the solver. The farthest any particle moves, in mm: {}. The mean \
         is the root of the mean square over the particles; under half the spacing those are compared that stand at the same place of \
         the cloth.",
        told.join("; ")
    );
    let mut section = EXPERIMENT.section(lead);
    section.blocks = vec![Block::Table(table)];
    Ok(section)
}
