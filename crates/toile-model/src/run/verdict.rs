//! How a garment is worn, as a person would judge it: whether it is on, and what is wrong where it is not.

mod crossed;
mod flaw;
mod girth;
mod opening;
mod parts;
mod place;
mod solid;

pub use crossed::crossed_particles;
pub use flaw::Flaw;
pub use opening::Opening;
pub use place::Place;
pub use solid::Solid;

use crate::Model;
use crate::run::dressing::{REST_SPEED, SEAM_GAP};
use glam::Vec3;
use parts::Part;
use place::Panels;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// A garment whose highest particle is so far from the height that it was placed at is not where it belongs [m]. Panels stand a little
/// above where they come to hang, and no more.
const WAY_OFF: f32 = 0.25;
/// What sinks faster at the end falls [m/s].
const FALLING_SPEED: f32 = 0.2;
/// 99 of 100 springs of a garment that fits are stretched by their threshold and this at most [1].
const MOST_ABOVE: f64 = 0.01;
/// All of them by their threshold and this [1]: a narrow place takes hold of single springs.
const ALL_ABOVE: f64 = 0.05;

/// How a garment is worn.
///
/// What is decided: whether its seams closed, its parts hang where they were placed, a body goes through each of its openings, cloth is on the
/// wrong side of the body, anything moves, and how far it is stretched. What is not: which limb goes through an opening, and whether the
/// garment is turned around or inside out.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Verdict {
    /// What is wrong, the worst first; empty when the garment is on.
    pub findings: Vec<Flaw>,
    /// Its openings; none while its seams are open.
    pub openings: Vec<Opening>,
    /// Particles on the wrong side of the body, see [`crossed_particles`].
    pub crossed_count: u32,
}

/// A garment as it is when it is judged.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Judged<'a> {
    /// What is worn: [`Piece::model`](crate::Piece::model). Its positions are those where it was placed.
    pub model: &'a Model,
    /// Positions [m], shape [particle_count].
    pub positions: &'a [Vec3],
    /// How its particles move [m/s], shape [particle_count]: [`Motion::velocities`](crate::Motion::velocities).
    pub velocities: &'a [Vec3],
    /// Whether it came to rest in its time: [`Dressing::is_at_rest`](crate::Dressing::is_at_rest).
    pub is_at_rest: bool,
}

impl<'a> Judged<'a> {
    /// A garment with these positions [m] and velocities [m/s], one for each particle.
    pub fn new(model: &'a Model, positions: &'a [Vec3], velocities: &'a [Vec3], is_at_rest: bool) -> Self {
        Self { model, positions, velocities, is_at_rest }
    }
}

impl Verdict {
    /// How a garment is worn on a body.
    ///
    /// # Panics
    /// When there is not one position and one velocity for each particle.
    pub fn of(judged: &Judged<'_>, body: &Solid) -> Self {
        let Judged { model, positions, velocities, is_at_rest } = *judged;
        assert!(
            positions.len() == model.positions.len() && velocities.len() == positions.len(),
            "a garment that is judged has a position and a velocity for each of its particles"
        );
        let panels = Panels::of(model);
        let mut findings = Vec::new();
        let open = model.widest_seam(positions).filter(|(_, gap)| *gap > SEAM_GAP);
        findings.extend(open.map(|(seam, gap)| Flaw::SeamOpen { seam: seam.to_owned(), gap }));
        let mut staying: Vec<u32> = Vec::new();
        let mut openings = Vec::new();
        let mut empty = Vec::new();
        for part in parts::parts(model) {
            let drop = top(&part, &model.positions) - top(&part, positions);
            let sinking = -mean(&part, velocities).y;
            if drop.abs() > WAY_OFF || sinking > FALLING_SPEED {
                findings.push(Flaw::FallenOff { panels: panels.all(&part.particles), drop });
                continue;
            }
            staying.extend(&part.particles);
            if open.is_none() {
                let own = opening::openings(model, &part, &panels, positions, body);
                empty.extend(own.iter().filter(|opening| opening.limb_count == 0).cloned());
                openings.extend(own);
            }
        }
        findings.extend(empty.into_iter().map(|opening| Flaw::OpeningEmpty { opening }));
        let (crossed, depth) = crossed_particles(model, positions, body);
        findings.extend(panels.place_among(&crossed, positions).map(|place| Flaw::Caught {
            particle_count: crossed.len() as u32,
            depth: depth as f32,
            place,
        }));
        if !is_at_rest && !is_calm(model, &staying, velocities) {
            findings.extend(not_at_rest(&panels, &staying, positions, velocities));
        }
        findings.extend(too_tight(model, &panels, positions));
        Self { findings, openings, crossed_count: crossed.len() as u32 }
    }

    /// Whether the garment is on and fits.
    pub fn is_on(&self) -> bool {
        self.findings.is_empty()
    }

    /// Whether it is on, though it may be too tight.
    pub fn is_worn(&self) -> bool {
        self.findings.iter().all(|finding| matches!(finding, Flaw::TooTight { .. }))
    }

    /// The verdict in a word or three: "on", or that of the worst finding.
    pub fn word(&self) -> &'static str {
        self.findings.first().map_or("on", Flaw::word)
    }
}

/// Height of the highest particle [m].
fn top(part: &Part, positions: &[Vec3]) -> f32 {
    part.particles.iter().map(|&particle| positions[particle as usize].y).fold(f32::NEG_INFINITY, f32::max)
}

fn mean(part: &Part, vectors: &[Vec3]) -> Vec3 {
    part.particles.iter().map(|&particle| vectors[particle as usize]).sum::<Vec3>() / part.particles.len().max(1) as f32
}

/// Whether particles have on average no more energy than cloth at rest.
fn is_calm(model: &Model, particles: &[u32], velocities: &[Vec3]) -> bool {
    let sum = |value: &dyn Fn(usize) -> f32| particles.iter().map(|&particle| value(particle as usize)).sum::<f32>();
    let energy = sum(&|particle| model.masses[particle] * velocities[particle].length_squared());
    energy <= sum(&|particle| model.masses[particle]) * REST_SPEED * REST_SPEED
}

fn not_at_rest(panels: &Panels<'_>, particles: &[u32], positions: &[Vec3], velocities: &[Vec3]) -> Option<Flaw> {
    let speed = |particle: u32| velocities[particle as usize].length();
    let moving: Vec<u32> = particles.iter().copied().filter(|&particle| speed(particle) > REST_SPEED).collect();
    Some(Flaw::NotAtRest {
        particle_count: moving.len() as u32,
        speed: moving.iter().map(|&particle| speed(particle)).fold(0.0, f32::max),
        place: panels.place_among(&moving, positions)?,
    })
}

fn too_tight(model: &Model, panels: &Panels<'_>, positions: &[Vec3]) -> Option<Flaw> {
    let thresholds: HashMap<[u32; 2], f64> =
        model.springs.iter().map(|spring| (spring.ends, f64::from(spring.threshold))).collect();
    let elongation = |limit: &crate::Limit| {
        let [a, b] = limit.ends.map(|end| positions[end as usize].as_dvec3());
        a.distance(b) / f64::from(limit.rest_length) - 1.0
    };
    let threshold = |limit: &crate::Limit| {
        let [a, b] = limit.ends;
        thresholds.get(&[a.min(b), a.max(b)]).copied().unwrap_or(0.0)
    };
    let mut above: Vec<(f64, &crate::Limit)> =
        model.limits.iter().map(|limit| (elongation(limit) - threshold(limit), limit)).collect();
    above.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (worst, spring) = *above.last()?;
    let most = above[(99 * above.len()).div_ceil(100) - 1].0;
    let allowed = model.threshold.warp.max(model.threshold.weft);
    let girth = girth::tightest(model, panels, positions).filter(|girth| girth.elongation() > allowed);
    if girth.is_none() && most <= MOST_ABOVE && worst <= ALL_ABOVE {
        return None;
    }
    let elongation_max = model.limits.iter().map(elongation).fold(0.0, f64::max) as f32;
    let [length, rest_length, allowed] = match &girth {
        Some(girth) => [girth.length, girth.rest_length, allowed],
        None => {
            let rest = f64::from(spring.rest_length);
            [rest * (1.0 + elongation(spring)), rest, threshold(spring)]
        }
    };
    Some(Flaw::TooTight {
        place: girth.map(|girth| girth.place).or_else(|| panels.place(&spring.ends, positions))?,
        length: length as f32,
        rest_length: rest_length as f32,
        threshold: allowed as f32,
        elongation_max,
    })
}
