//! What a step does with all limits of a cloth, colour by colour: [`Reference`](crate::Reference) without forces and bodies.

use crate::{Coarse, Contact, Particles, Probe, step};
use std::ops::Range;
use toile_model::{Model, StepSettings};
use toile_scene::Rule;

/// Limits begin a step with part of what they pulled with at the end of the last: `impulses` [N·s], shape [limit_count].
pub fn warm_start(particles: &mut Particles, model: &Model, settings: &StepSettings, impulses: &mut [f32]) {
    if settings.sweeps == 0 || !matches!(settings.rule, Rule::Predictive | Rule::Hierarchical) {
        return;
    }
    for colour in &model.limit_colours {
        step::warm_start(particles, part(&model.limits, colour), part_mut(impulses, colour));
    }
}

/// The limits' part of a sweep; under the hierarchical rule from pins outward, along strands, then single springs. `contacts`
/// are those of the last step, shape [particle_count], where there is a body; `impulses` [N·s] go on through the step, shape [limit_count].
pub fn sweep(
    particles: &mut Particles,
    model: &Model,
    settings: &StepSettings,
    contacts: Option<&[Contact]>,
    impulses: &mut [f32],
) {
    if settings.sweeps == 0 {
        return;
    }
    if settings.rule == Rule::Hierarchical {
        step::limit_attachments(particles, &model.attachments, settings.dt);
        coarse_levels(particles, model, settings);
        let (line, lengths) = (&model.strand_particles, &model.strand_lengths);
        for colour in &model.strand_colours {
            step::limit_strands(particles, part(&model.strands, colour), line, lengths, settings.dt);
        }
    }
    for colour in (0..settings.limit_passes()).flat_map(|_| &model.limit_colours) {
        let limits = part(&model.limits, colour);
        match settings.rule {
            Rule::None | Rule::Position => {}
            Rule::Zero => step::limit_zero(particles, limits),
            Rule::Average => step::limit_average(particles, limits),
            Rule::Directional => step::limit_directional(particles, limits, contacts, settings),
            Rule::Predictive | Rule::Hierarchical => {
                step::limit_predictive(particles, limits, part_mut(impulses, colour), settings.dt);
            }
        }
    }
}

/// From the coarsest level to the finest: each begins with what it is led by.
fn coarse_levels(particles: &mut Particles, model: &Model, settings: &StepSettings) {
    if model.levels.is_empty() {
        return;
    }
    let mut coarse = Coarse::new(model.coarse_particles.len());
    for level in model.levels.iter().rev() {
        step::lead_coarse(&mut coarse, &level.particles, particles, model, settings.dt);
        for colour in (0..StepSettings::COARSE_PASSES).flat_map(|_| &level.colours) {
            step::limit_coarse(&mut coarse, &model.coarse_particles, part(&model.coarse_limits, colour));
        }
    }
    step::lead_particles(particles, &coarse, &model.leaders, settings.dt);
}

/// After the sweeps, where no seam is open: no contact leaves a spring stretched far beyond its limit, and no particle goes deeper into a
/// body for it than the cloth is thick. `probes` are what the particles saw in the last sweep, shape [particle_count], empty without body.
pub fn guard(particles: &mut Particles, model: &Model, settings: &StepSettings, probes: &[Probe]) {
    if settings.rule != Rule::Hierarchical || settings.sweeps == 0 || !model.seam_pairs.is_empty() {
        return;
    }
    for pass in 0..settings.guard_passes {
        for (colour, index) in model.limit_colours.iter().zip(0..) {
            step::limit_guard(particles, part(&model.limits, colour), settings.guard_share(pass, index), settings);
        }
    }
    step::keep_out(particles, probes, settings);
}

/// The items of a colour.
pub(crate) fn part<'a, T>(items: &'a [T], colour: &Range<u32>) -> &'a [T] {
    &items[colour.start as usize..colour.end as usize]
}

fn part_mut<'a, T>(items: &'a mut [T], colour: &Range<u32>) -> &'a mut [T] {
    &mut items[colour.start as usize..colour.end as usize]
}
