//! How each quad's midpoint answers the body. D §6; W §5, eq. 15.

use crate::contact::response;
use crate::{Midpoints, Probe, Response};
use toile_model::StepSettings;

/// The response of each quad's midpoint to its probe; shape [quad_count]. D §6; W §5, eq. 15.
pub fn quad_responses(midpoints: &Midpoints, probes: &[Probe], settings: &StepSettings) -> Vec<Response> {
    midpoints.velocities.iter().zip(probes).map(|(&velocity, probe)| response(velocity, probe, settings)).collect()
}
