//! Stiffness that the step can carry.

use crate::{Csr, Link};
use toile_scene::{Rule, Settings};

/// Shortest step [s] that springs may ask for under a rule that holds the elongation by itself: 16 in a frame of 1/60 s. It does
/// not depend on the frame rate, so neither does the cloth.
const STEP_MIN: f64 = 1.0 / 960.0;

/// Largest ω·dt that softened links have. Stable is 2; below it, so that contacts do not excite the stiffest springs.
const RATE_PER_STEP: f64 = 1.6;

/// Longest step [s] that the links of a model must be stable at; `None` when they keep the stiffness of the fabric.
///
/// What the limits carry, the springs need not: under the predictive rules a stiff fabric does not force more steps on a frame.
/// What is lost is resistance to compression and bending where the particles are too light for it. The other rules leave
/// the tension to the springs, so there the step follows the stiffness.
pub(crate) fn step_wanted(settings: &Settings) -> Option<f64> {
    matches!(settings.velocity_modification.rule, Rule::Predictive | Rule::Hierarchical).then_some(STEP_MIN)
}

/// Makes links softer where their particles are too light for a step [s]: with Gershgorin's bound ω² ≤ 2·Σk·w the largest
/// stable step is 2/ω. Both ends of a spring get the same stiffness.
pub(crate) fn soften(links: &mut Csr<Link>, inverse_masses: &[f32], step: f64) {
    let allowed = (RATE_PER_STEP / step).powi(2);
    let factors: Vec<f64> = (0..links.row_count())
        .map(|i| {
            let stiffness: f64 = links.row(i).iter().map(|l| f64::from(l.stiffness)).sum();
            (allowed / (2.0 * stiffness * f64::from(inverse_masses[i]))).min(1.0)
        })
        .collect();
    for i in 0..links.row_count() {
        for k in links.range(i) {
            let link = &mut links.values[k as usize];
            link.stiffness = (f64::from(link.stiffness) * factors[i].min(factors[link.other as usize])) as f32;
        }
    }
}
