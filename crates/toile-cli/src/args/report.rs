//! What the user types of `toile report`.

use super::place::{Backend, Place};
use clap::Args;
use clap::builder::PossibleValuesParser;
use std::path::PathBuf;
use toile_report::EXPERIMENTS;

/// `toile report`.
#[derive(Args, Debug)]
pub struct ReportOf {
    /// Measure less: about four minutes on two cores.
    #[arg(long)]
    pub quick: bool,
    /// Run only these experiments.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = PossibleValuesParser::new(EXPERIMENTS.iter().map(|experiment| experiment.name)))]
    pub only: Vec<String>,
    /// Folder for the report.
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub out: PathBuf,
    /// Seed of everything that is random.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Measure nothing: put two reports side by side.
    #[arg(long, value_names = ["A.json", "B.json"], num_args = 2, conflicts_with_all = ["quick", "only", "seed", "adapter"])]
    pub compare: Vec<PathBuf>,
    /// Print the report as JSON, and nothing else.
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors.
    #[arg(long)]
    pub quiet: bool,
    /// Part of the name of the adapter to use.
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
}

impl ReportOf {
    /// Where it runs: the report is about the device, so always on one.
    pub fn place(&self) -> Place {
        Place { adapter: self.adapter.clone(), backend: Backend::Gpu }
    }
}
