//! What a step does with all limits of a cloth, colour by colour: [`Reference`](crate::Reference) without forces and bodies.

use crate::{Contact, Nodes, Particles, Probe, step};
use glam::Vec3;
use std::ops::Range;
use toile_model::{Arrays, StepSettings};
use toile_scene::Rule;

/// Particles begin a step with part of what limits gave them in the last: `pulls` [m/s], shape [particle_count].
pub fn warm_start(particles: &mut Particles, settings: &StepSettings, pulls: &mut [Vec3]) {
    if settings.sweeps > 0 && matches!(settings.rule, Rule::Predictive | Rule::Hierarchical) {
        step::warm_start(particles, pulls);
    }
}

/// The limits' part of a sweep; under the hierarchical rule from pins outward, then from the coarsest level to the cloth itself. `contacts`
/// are those of the last step, shape [particle_count], where there is a body; `pulls` [m/s] go on through the step, shape [particle_count].
pub fn sweep(
    particles: &mut Particles,
    model: &Arrays,
    settings: &StepSettings,
    contacts: Option<&[Contact]>,
    pulls: &mut [Vec3],
) {
    if settings.sweeps == 0 {
        return;
    }
    if settings.rule == Rule::Hierarchical {
        step::limit_attachments(particles, &model.attachments, settings.dt);
        levels(particles, model, settings, pulls);
        return;
    }
    for colour in &model.limit_colours {
        let limits = part(&model.limits, colour);
        match settings.rule {
            Rule::None | Rule::Position | Rule::Hierarchical => {}
            Rule::Zero => step::limit_zero(particles, limits),
            Rule::Average => step::limit_average(particles, limits),
            Rule::Directional => step::limit_directional(particles, limits, contacts, settings),
            Rule::Predictive => step::limit_predictive(particles, limits, pulls, settings.dt),
        }
    }
}

/// From the coarsest level to the cloth itself: each begins with what it is led by.
fn levels(particles: &mut Particles, model: &Arrays, settings: &StepSettings, pulls: &mut [Vec3]) {
    let mut nodes = Nodes::new(model.positions.len() + model.coarse_particles.len());
    step::limit_small_levels(&mut nodes, particles, model, settings);
    for level in model.levels.iter().rev().filter(|level| !level.is_small()) {
        step::lead_level(&mut nodes, &level.nodes, particles, model, settings.dt);
        for colour in (0..settings.level_passes(level)).flat_map(|_| &level.colours) {
            step::limit_level(&mut nodes, model, colour, StepSettings::relaxation(level));
        }
    }
    step::shift_velocities(particles, &nodes, pulls, settings.dt);
}

/// After the sweeps, where no seam is open: no contact leaves a spring stretched far beyond its limit, and no particle goes deeper into a
/// body for it than the cloth is thick. `probes` are what the particles saw in this step, shape [particle_count], empty without body.
pub fn guard(particles: &mut Particles, model: &Arrays, settings: &StepSettings, probes: &[Probe]) {
    if settings.rule != Rule::Hierarchical || settings.sweeps == 0 || !model.seam_pairs.is_empty() {
        return;
    }
    for pass in 0..settings.guard_passes {
        for (colour, index) in model.levels.first().iter().flat_map(|level| &level.colours).zip(0..) {
            step::limit_guard(particles, model, colour, settings.guard_share(pass, index), settings);
        }
    }
    step::keep_out(particles, probes, settings);
}

/// The items of a colour.
pub(crate) fn part<'a, T>(items: &'a [T], colour: &Range<u32>) -> &'a [T] {
    &items[colour.start as usize..colour.end as usize]
}
