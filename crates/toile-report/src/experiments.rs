//! The table of experiments, in the order of the report.

pub mod cost;
pub mod precision;
pub mod rest;
pub mod settings;
pub mod terms;
pub mod validation;

use crate::Experiment;

/// Every experiment, in the order of the report.
pub const EXPERIMENTS: &[Experiment] =
    &[precision::EXPERIMENT, settings::EXPERIMENT, cost::EXPERIMENT, terms::EXPERIMENT, validation::EXPERIMENT];
