//! What a step costs against the number of particles. D fig. 8.

use crate::Experiment;
use crate::page::{Axis, Block, Cell, Plot, Section, Series, SeriesStyle, Table};
use toile::gpu::GpuError;
use toile::scene::{Rule, VelocityModification};
use toile_lab::scenes::hanging_sheet;
use toile_lab::{Lab, LabError, Run, StepCost};

/// The row of the table.
pub const EXPERIMENT: Experiment = Experiment { name: "cost", title: "Cost against size", minutes: [0.1, 1.0], run };

/// The rules that are compared: the springs alone, and the default.
const RULES: [(&str, Rule); 2] = [("none", Rule::None), ("hierarchical", Rule::Hierarchical)];

/// Particles on a side beyond which one step is timed: it takes so long that nothing else on the machine matters.
const LARGE: u32 = 256;

/// Cost of a step of the hanging sheet of n × n particles: the least of so many steps.
pub fn step_cost(lab: &Lab, rule: Rule, n: u32, steps: usize) -> Result<StepCost, LabError> {
    let (sheet, mut settings) = hanging_sheet(n);
    settings.velocity_modification = VelocityModification::new(rule);
    let mut run = Run::sheet(lab, &sheet, &settings, Default::default())?;
    run.cost(lab, steps)
}

/// The exponent p of the power law c·x^p that comes nearest to points by the logarithm; `None` for fewer than two of them.
pub fn fitted_exponent(points: &[[f64; 2]]) -> Option<f64> {
    let logs: Vec<[f64; 2]> =
        points.iter().filter(|point| point.iter().all(|value| *value > 0.0)).map(|point| point.map(f64::ln)).collect();
    let count = logs.len() as f64;
    let [x, y] = [0, 1].map(|part| logs.iter().map(|log| log[part]).sum::<f64>() / count);
    let spread: f64 = logs.iter().map(|log| (log[0] - x).powi(2)).sum();
    let along: f64 = logs.iter().map(|log| (log[0] - x) * (log[1] - y)).sum();
    (spread > 0.0).then(|| along / spread)
}

fn run(lab: &mut Lab) -> Result<Section, LabError> {
    let sizes: &[u32] = lab.pick(&[32, 64, 128, 256], &[32, 64, 128, 256, 512, 1024]);
    let steps = lab.pick(3, 5);
    let caption = format!(
        "Time of one step of a sheet of 1 m × 1 m hanging on two corners, 0.2 kg/m², springs of 20, 10 and 2 N/m, n × n particles for n \
         from {} to {}, without limits and with two sweeps of hierarchical ones; the fastest of {steps} steps, beyond n = {LARGE} a single one. {}",
        sizes[0],
        sizes[sizes.len() - 1],
        lab.place()
    );
    let mut table = Table::new(
        format!("The figures of the plot above: cost of a step by rule and size. {}", lab.place()),
        &[
            ["rule", ""],
            ["particles", ""],
            ["step", "ms"],
            ["step", "state copies"],
            ["state copy", "ms"],
            ["per particle", "ns"],
        ],
    );
    let mut series = Vec::new();
    let mut exponents = Vec::new();
    for (index, (name, rule)) in RULES.into_iter().enumerate() {
        let mut points = Vec::new();
        for (place, &n) in sizes.iter().enumerate() {
            let share = (index * sizes.len() + place) as f64 / (RULES.len() * sizes.len()) as f64;
            lab.say(share, &format!("{n} × {n} particles, {name}"))?;
            let particles = f64::from(n) * f64::from(n);
            let count = Cell::Count(u64::from(n) * u64::from(n));
            let cost = match step_cost(lab, rule, n, if n > LARGE { 1 } else { steps }) {
                Err(LabError::Toile(toile::Error::Gpu(GpuError::BufferTooLarge { .. }))) => {
                    let missing = [Cell::Missing, Cell::Missing, Cell::Missing];
                    let words = [Cell::text(name), count, Cell::text("does not fit the device")];
                    table.push(words.into_iter().chain(missing).collect());
                    continue;
                }
                cost => cost?,
            };
            points.push([particles, cost.milliseconds()]);
            table.push(vec![
                Cell::text(name),
                count,
                Cell::number(cost.milliseconds()),
                Cell::number_or_missing(cost.copies()),
                Cell::number(cost.state_copy),
                Cell::number(1e6 * cost.milliseconds() / particles),
            ]);
        }
        // A dispatch has a price of its own, which small sheets pay for nothing else.
        let large = &points[(points.len() / 2).saturating_sub(1)..];
        exponents.push((name, fitted_exponent(&points), fitted_exponent(large)));
        series.push(Series::new(name, SeriesStyle::LineAndMarks, points));
    }
    if let [[start, _], .., through] = *series[series.len() - 1].points {
        series.push(Series::new("linear", SeriesStyle::Line, [[start, through[1] * start / through[0]], through]));
    }
    let told: Vec<String> = exponents
        .iter()
        .map(|(name, all, large)| {
            let shown = |exponent: &Option<f64>| exponent.map_or("–".to_owned(), |p| format!("{p:.2}"));
            format!("{name} {} over all sizes and {} over the larger half", shown(all), shown(large))
        })
        .collect();
    let lead = format!(
        "The papers found the time of a step linear in the number of particles (D fig. 8). The exponent p of the power law time ∝ \
         particles^p that fits best: {}. Where dispatches have a price of \
         their own, small sheets cost more per particle, and the exponent is below 1.",
        told.join("; ")
    );
    let mut section = EXPERIMENT.section(lead);
    let plot = Plot { caption, x: Axis::log("particles", ""), y: Axis::log("time of a step", "ms"), series };
    section.blocks = vec![Block::Plot(plot), Block::Table(table)];
    Ok(section)
}
