//! What was measured, as the report shows figures: a table and a plot.

use crate::options::Options;
use crate::{Outcome, Row};
use toile_lab::Scale;
use toile_lab::peers::Figures;
use toile_report::page::{
    Axis, Block, Cell, Page, Plot, Report, Section, Series, SeriesStyle, Table, json as report_json, markdown,
    standalone,
};

/// How far the middle of a sheet may be from that of stiff cloth [m] for its strain to count.
const MIDDLE_MAX: f64 = 0.05;

/// The section of a run.
pub fn section(rows: &[Row], adapter: &str, options: &Options, absent: Option<&str>) -> Section {
    let mut blocks = vec![Block::Plot(plot(rows, adapter, options)), Block::Table(table(rows, adapter, options))];
    if let Some(hint) = absent {
        blocks.push(Block::Text(format!("Taichi is absent: {hint}.")));
    }
    let lead = "A point further left is cheaper, further down more exact. Milliseconds do not carry over to other machines; their ratios within \
                one run do, roughly."
        .to_owned();
    Section { name: "peers".to_owned(), title: "Beside other programs".to_owned(), lead, blocks }
}

fn plot(rows: &[Row], adapter: &str, options: &Options) -> Plot {
    let mut series: Vec<(String, Vec<[f64; 2]>)> = Vec::new();
    let mut left_out = 0;
    for row in rows {
        // The legend is narrow.
        let name = format!("{}: {} {}", row.program.replace(" scheme, ours", ""), row.scene, row.n);
        let Some(figures) = figures(row) else {
            left_out += 1;
            continue;
        };
        if figures.middle.distance(row.stiff) > MIDDLE_MAX {
            left_out += 1;
            continue;
        }
        let point = [figures.milliseconds, 1e2 * figures.elongation_max_over_run];
        match series.iter_mut().find(|(known, _)| *known == name) {
            Some((_, points)) => points.push(point),
            None => series.push((name, vec![point])),
        }
    }
    Plot {
        caption: format!(
            "Largest elongation in the run against what a frame takes. {} Left out: {left_out} settings that diverged, took too long, or whose middle is \
             more than {:.0} cm from that of stiff cloth half-way.",
            caption(adapter, options),
            1e2 * MIDDLE_MAX
        ),
        x: Axis::log("a frame", "ms"),
        y: Axis::log("largest elongation of a side of a cell in the run", "%"),
        series: series.into_iter().map(|(name, points)| Series::new(name, SeriesStyle::LineAndMarks, points)).collect(),
    }
}

fn table(rows: &[Row], adapter: &str, options: &Options) -> Table {
    let columns = [
        ["program", ""],
        ["scene", ""],
        ["n", ""],
        ["setting", ""],
        ["a frame", "ms"],
        ["least", "ms"],
        ["most", "ms"],
        ["largest elongation in the run", "%"],
        ["at the end", "%"],
        ["p99 at the end", "%"],
        ["middle beside stiff cloth", "mm"],
    ];
    let mut table = Table::new(format!("The figures of the plot. {}", caption(adapter, options)), &columns);
    for row in rows {
        let mut cells =
            vec![Cell::text(&row.program), Cell::text(&row.scene), Cell::Count(row.n.into()), Cell::text(&row.setting)];
        match (&row.outcome, figures(row)) {
            (Outcome::Done(all), Some(figures)) => {
                let times = || all.iter().map(|figures| figures.milliseconds);
                cells.extend([
                    Cell::number(figures.milliseconds),
                    Cell::number(times().fold(f64::INFINITY, f64::min)),
                    Cell::number(times().fold(0.0, f64::max)),
                    Cell::number(1e2 * figures.elongation_max_over_run),
                    Cell::number(1e2 * figures.elongation_max),
                    Cell::number(1e2 * figures.elongation_p99),
                    Cell::number(1e3 * figures.middle.distance(row.stiff)),
                ]);
            }
            (Outcome::Late, _) => cells.push(Cell::text(format!("longer than {} s in all", options.limit))),
            (Outcome::Failed(fault), _) => cells.push(Cell::text(format!("failed: {fault}"))),
            _ => cells.push(Cell::text("diverged")),
        }
        cells.resize(columns.len(), Cell::Missing);
        table.push(cells);
    }
    table
}

fn caption(adapter: &str, options: &Options) -> String {
    format!(
        "A sheet of 1 m × 1 m and 0.2 kg/m², n × n particles, damped by 0.1 /s, {} frames of 1/60 s: `hang` swings down from level on two held \
         corners, `ball` falls from 0.2 m on a sphere of radius 0.25 m. Times are those of the median frame after the first two, of it the median of {} repetitions in \
         turns; toile on {adapter}, NvCloth's scheme in our own code on one thread of the CPU, Taichi on all of its cores, of which there are {}.",
        options.frames,
        options.repetitions,
        std::thread::available_parallelism().map_or(1, usize::from)
    )
}

/// The median time of the repetitions, and the largest of what they measured else; `None` where it was not measured.
fn figures(row: &Row) -> Option<Figures> {
    let Outcome::Done(all) = &row.outcome else { return None };
    let mut times: Vec<f64> = all.iter().map(|figures| figures.milliseconds).collect();
    times.sort_by(f64::total_cmp);
    let largest = |of: fn(&Figures) -> f64| all.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let farthest = all.iter().max_by(|a, b| a.middle.distance(row.stiff).total_cmp(&b.middle.distance(row.stiff)))?;
    Some(Figures {
        // Of an even number, the mean of the two in the middle.
        milliseconds: 0.5 * (times[(times.len() - 1) / 2] + times[times.len() / 2]),
        elongation_max_over_run: largest(|figures| figures.elongation_max_over_run),
        elongation_max: largest(|figures| figures.elongation_max),
        elongation_p99: largest(|figures| figures.elongation_p99),
        middle: farthest.middle,
    })
}

/// The section as text for a terminal.
pub fn text(section: &Section) -> String {
    let tables = Section {
        blocks: section.blocks.iter().filter(|block| !matches!(block, Block::Plot(_))).cloned().collect(),
        ..section.clone()
    };
    let page = Page { title: "Peers".to_owned(), lead: String::new(), sections: vec![tables] };
    markdown(&page, "peers").0
}

/// Its plot as SVG.
pub fn svg(section: &Section) -> String {
    let plot = section.blocks.iter().find_map(|block| match block {
        Block::Plot(plot) => Some(plot),
        _ => None,
    });
    standalone(plot.expect("a section of peers has a plot"))
}

/// All of it as JSON, in the form of the report.
pub fn json(section: Section, adapter: String) -> String {
    let version = env!("CARGO_PKG_VERSION").to_owned();
    report_json(&Report { adapter, version, scale: Scale::Full, seed: 1, sections: vec![section] })
}
