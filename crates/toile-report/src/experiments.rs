//! The table of experiments, in the order of the report.

pub mod cost;
pub mod hard_cases;
pub mod object_space;
pub mod parity;
pub mod precision;
pub mod rest;
pub mod settings;
pub mod speed;
pub mod stability;
pub mod terms;
pub mod validation;

use crate::Experiment;

/// Every experiment, in the order of the report.
pub const EXPERIMENTS: &[Experiment] = &[
    precision::EXPERIMENT,
    settings::EXPERIMENT,
    stability::EXPERIMENT,
    hard_cases::EXPERIMENT,
    validation::EXPERIMENT,
    object_space::EXPERIMENT,
    speed::EXPERIMENT,
    cost::EXPERIMENT,
    parity::EXPERIMENT,
    terms::EXPERIMENT,
];
