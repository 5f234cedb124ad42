//! Work-precision of the limits: elongation beyond the threshold against cost.

use crate::page::{Axis, Block, Cell, Plot, Series, SeriesStyle, Table};
use std::collections::BTreeMap;
use toile::model::{Model, StepSettings};
use toile::scene::{Rule, VelocityModification};
use toile_lab::scenes::hanging_sheet;
use toile_lab::{Lab, LabError, Run};

/// Excess below this is drawn at it: none cannot be shown on a logarithmic axis.
const EXCESS_MIN: f64 = 1e-4;

/// A way to limit the elongation of the hanging sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limiting {
    /// Rule of the velocity modification.
    pub rule: Rule,
    /// Its sweeps.
    pub sweeps: u32,
    /// By how much the step is divided, against the one that toile chooses.
    pub step_division: u32,
    /// Particles on a side.
    pub n: u32,
}

/// What came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limited {
    /// Steps in a frame of 1/60 s.
    pub steps_per_frame: u32,
    /// Largest elongation at the end of any frame [1]; infinite when the run diverged.
    pub elongation_max: f64,
    /// Elongation that 99 of 100 springs do not exceed at the end [1]; infinite when the run diverged.
    pub elongation_p99: f64,
    /// Cost of a frame [ms].
    pub milliseconds: f64,
    /// Cost of a frame [state copies].
    pub copies: Option<f64>,
}

/// Lets the sheet swing down on two corners for some frames.
pub fn limited(lab: &Lab, limiting: Limiting, frames: u32) -> Result<Limited, LabError> {
    let (sheet, mut settings) = hanging_sheet(limiting.n);
    settings.velocity_modification = VelocityModification::new(limiting.rule);
    settings.velocity_modification.sweeps = Some(limiting.sweeps);
    let model = Model::from_sheet(&sheet, &settings);
    let mut step = StepSettings::new(&settings, &model);
    step.dt /= limiting.step_division as f32;
    step.steps_per_frame *= limiting.step_division;
    let steps_per_frame = step.steps_per_frame;
    let mut run = Run::new(lab, model, step, Default::default())?;
    let mut elongation_max: f64 = 0.0;
    for _ in 0..frames {
        let Some(status) = run.frame(lab)? else {
            elongation_max = f64::INFINITY;
            break;
        };
        elongation_max = elongation_max.max(f64::from(status.elongation_max));
    }
    let elongations = run.elongations(lab)?;
    let cost = run.cost(lab, 3)?;
    let steps = f64::from(steps_per_frame);
    Ok(Limited {
        steps_per_frame,
        elongation_max,
        elongation_p99: elongations[elongations.len() * 99 / 100],
        milliseconds: steps * cost.milliseconds(),
        copies: cost.copies().map(|copies| steps * copies),
    })
}

pub(super) fn blocks(lab: &mut Lab, progress: [f64; 2]) -> Result<Vec<Block>, LabError> {
    let sizes: &[u32] = lab.pick(&[13], &[17, 33, 65]);
    let frames = lab.pick(36, 60);
    let threshold = hanging_sheet(2).1.fabric.threshold.least();
    let caption = format!(
        "Elongation beyond the threshold of {} % against cost: a sheet of 1 m × 1 m, 0.2 kg/m², springs of 20, 10 and 2 N/m, damping \
         0.1 /s, swings down from level on two held corners; n × n particles, {frames} frames of 1/60 s, each rule with several sweeps \
         per step and with the step that toile chooses or a half of it. {}",
        1e2 * threshold,
        lab.place()
    );
    let columns = [
        ["rule", ""],
        ["n", ""],
        ["sweeps", ""],
        ["steps per frame", ""],
        ["beyond the threshold, worst in the run", "%"],
        ["p99 at the end", "%"],
        ["frame", "ms"],
        ["frame", "state copies"],
    ];
    let figures =
        format!("The figures of the plot above: elongation and cost by rule, size, sweeps and step. {}", lab.place());
    let mut table = Table::new(figures, &columns);
    let mut curves: BTreeMap<usize, Vec<[f64; 2]>> = BTreeMap::new();
    let rows: Vec<(usize, Limiting)> = sizes.iter().flat_map(|n| limitings(lab, *n)).collect();
    for (index, (rule, limiting)) in rows.iter().enumerate() {
        let share = progress[0] + (progress[1] - progress[0]) * index as f64 / rows.len() as f64;
        let name = Rule::ALL[*rule].0;
        lab.say(share, &format!("elongation, {name}, n = {}", limiting.n))?;
        let limited = limited(lab, *limiting, frames)?;
        let excess = limited.elongation_max - threshold;
        let point = limited.copies.map(|copies| [copies, excess.max(EXCESS_MIN)]);
        curves.entry(*rule).or_default().extend(point);
        table.push(vec![
            Cell::text(name),
            Cell::Count(limiting.n.into()),
            Cell::Count(limiting.sweeps.into()),
            Cell::Count(limited.steps_per_frame.into()),
            Cell::number(1e2 * excess.max(0.0)),
            Cell::number(1e2 * limited.elongation_p99),
            Cell::number(limited.milliseconds),
            Cell::number_or_missing(limited.copies),
        ]);
    }
    let series = curves.into_iter().map(|(rule, points)| Series::new(Rule::ALL[rule].0, SeriesStyle::Marks, points));
    let plot = Plot {
        caption: format!(
            "{caption} Runs that diverged are not drawn; an excess below {EXCESS_MIN} is drawn at {EXCESS_MIN}."
        ),
        x: Axis::log("cost of a frame", "state copies"),
        y: Axis::log("elongation beyond the threshold, worst in the run", "1"),
        series: series.collect(),
    };
    Ok(vec![Block::Plot(plot), Block::Table(table)])
}

/// Every rule with the sweeps that make sense for it, and with half the step.
fn limitings(lab: &Lab, n: u32) -> Vec<(usize, Limiting)> {
    let of_rule = |(index, (_, rule)): (usize, (&str, Rule))| -> Vec<(usize, Limiting)> {
        let sweeps: &[u32] = match rule {
            Rule::None | Rule::Zero | Rule::Average | Rule::Directional => &[1],
            Rule::Position => lab.pick(&[1], &[1, 4]),
            Rule::Predictive => lab.pick(&[1, 8], &[1, 2, 4, 8, 16]),
            Rule::Hierarchical => lab.pick(&[1, 4], &[1, 2, 4]),
        };
        let with = |(sweeps, step_division): (u32, u32)| (index, Limiting { rule, sweeps, step_division, n });
        let last = sweeps[sweeps.len() - 1];
        sweeps.iter().map(|sweeps| (*sweeps, 1)).chain([(last, 2)]).map(with).collect()
    };
    Rule::ALL.into_iter().enumerate().flat_map(of_rule).collect()
}
