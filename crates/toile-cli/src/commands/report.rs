//! `toile report`: runs the experiments and writes the report, or puts two reports side by side.

use crate::adapter;
use crate::args::ReportOf;
use crate::interrupt::{self, Interrupted};
use crate::output;
use crate::stdout::print;
use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use toile::files::write_atomically;
use toile_lab::{Lab, LabError, Progress, Scale};
use toile_report::page::{self, Page, Report};
use toile_report::{EXPERIMENTS, Experiment};

/// Runs the experiments and writes the report, or puts two reports side by side.
pub fn run(arguments: &ReportOf) -> Result<()> {
    output::check(&arguments.out, "report.json")?;
    let (page, json, stem, end) = match arguments.compare.as_slice() {
        [a, b] => {
            let page = page::compare(&read(a)?, &read(b)?);
            let json = serde_json::to_string_pretty(&page)?;
            (page, json, "comparison", Ok(()))
        }
        _ => {
            let (report, end) = measure(arguments)?;
            if report.sections.is_empty() {
                return end;
            }
            (Page::from(&report), page::json(&report), "report", end)
        }
    };
    output::write_whole(&arguments.out, |folder| write(folder, &page, &json, stem))?;
    if arguments.json {
        print(&json)?;
    } else if !arguments.quiet {
        print(&format!("wrote {}", arguments.out.join(format!("{stem}.html")).display()))?;
    }
    end.with_context(|| format!("ended early: what was finished is in {}", arguments.out.display()))
}

fn read(path: &PathBuf) -> Result<Report> {
    let text = fs::read_to_string(path).with_context(|| format!("{}: cannot be read", path.display()))?;
    page::parse(&text).with_context(|| format!("{}: it is no report.json of this version", path.display()))
}

fn write(folder: &Path, page: &Page, json: &str, stem: &str) -> Result<()> {
    let (text, plots) = page::markdown(page, stem);
    write_atomically(&folder.join(format!("{stem}.md")), text.as_bytes())?;
    write_atomically(&folder.join(format!("{stem}.html")), page::html(page).as_bytes())?;
    write_atomically(&folder.join(format!("{stem}.json")), json.as_bytes())?;
    for (name, plot) in plots {
        write_atomically(&folder.join(name), plot.as_bytes())?;
    }
    Ok(())
}

/// The report of the experiments, and how they ended: what was measured is not lost to the last of them, or to ctrl-c.
fn measure(arguments: &ReportOf) -> Result<(Report, Result<()>)> {
    let wanted = |experiment: &&Experiment| {
        arguments.only.is_empty() || arguments.only.iter().any(|name| name == experiment.name)
    };
    let experiments: Vec<&Experiment> = EXPERIMENTS.iter().filter(wanted).collect();
    let gpu = adapter::open(&arguments.place())?;
    let scale = if arguments.quick { Scale::Quick } else { Scale::Full };
    let mut lab = Lab::new(gpu.device, gpu.queue, gpu.name, scale, arguments.seed);
    let clock = Clock::new(&experiments, scale, arguments.quiet || arguments.json);
    let mut sections = Vec::new();
    let mut end = Ok(());
    for (index, experiment) in experiments.iter().enumerate() {
        lab.progress = clock.listener(index);
        match (experiment.run)(&mut lab) {
            Ok(section) => sections.push(section),
            Err(error) => {
                end = Err(match error {
                    LabError::Interrupted => Interrupted.into(),
                    error => anyhow::Error::from(error).context(format!("the experiment {} failed", experiment.name)),
                });
                break;
            }
        }
    }
    interrupt::forget();
    clock.bar.finish_and_clear();
    let Lab { adapter, seed, .. } = lab;
    Ok((Report { adapter, version: env!("CARGO_PKG_VERSION").to_owned(), scale, seed, sections }, end))
}

/// How long the experiments have run, and how long they will.
struct Clock {
    bar: ProgressBar,
    start: Instant,
    /// Title and estimated minutes of each experiment.
    plan: Vec<(&'static str, f64)>,
}

impl Clock {
    fn new(experiments: &[&Experiment], scale: Scale, quiet: bool) -> Self {
        let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(1000) };
        let style = ProgressStyle::with_template("{spinner} {wide_bar} {percent:>3} % · {msg} [{elapsed}]");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(200));
        let plan = experiments.iter().map(|experiment| (experiment.name, experiment.minutes_at(scale))).collect();
        Self { bar, start: Instant::now(), plan }
    }

    /// What an experiment tells its progress to.
    fn listener(&self, index: usize) -> Progress {
        let before: f64 = self.plan[..index].iter().map(|(_, minutes)| minutes).sum();
        let total: f64 = self.plan.iter().map(|(_, minutes)| minutes).sum();
        let (name, minutes) = self.plan[index];
        let (bar, start) = (self.bar.clone(), self.start);
        Box::new(move |share, message| {
            let done = before + share.clamp(0.0, 1.0) * minutes;
            let left = minutes_left(start.elapsed().as_secs_f64() / 60.0, done, total);
            bar.set_position((1000.0 * done / total.max(f64::MIN_POSITIVE)) as u64);
            bar.set_message(format!("{name}: {message}, about {} left", time(left)));
            interrupt::check().is_ok()
        })
    }
}

/// Minutes that are left of `total` estimated ones, `done` of which took `elapsed`. The estimate counts for a minute of
/// experience, so that the first moments say little.
fn minutes_left(elapsed: f64, done: f64, total: f64) -> f64 {
    let pace = (elapsed + 1.0) / (done + 1.0);
    (total - done) * pace
}

fn time(minutes: f64) -> String {
    if minutes < 1.5 { format!("{:.0} s", (60.0 * minutes).max(1.0)) } else { format!("{minutes:.0} min") }
}

#[cfg(test)]
mod tests {
    use super::{minutes_left, time};

    #[test]
    fn the_time_left_follows_the_estimate_first_and_experience_later() {
        assert_eq!(minutes_left(0.0, 0.0, 60.0), 60.0);
        let slow = minutes_left(59.0, 29.0, 60.0);
        assert!((slow - 62.0).abs() < 1e-9, "half as fast as thought: {slow}");
        assert_eq!(minutes_left(70.0, 60.0, 60.0), 0.0);
    }

    #[test]
    fn times_are_told_in_seconds_or_minutes() {
        assert_eq!([0.0, 0.5, 1.4, 12.4].map(time), ["1 s", "30 s", "84 s", "12 min"]);
    }
}
