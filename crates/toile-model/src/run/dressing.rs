//! How a garment gets onto a body: sewn first, then draped, each until measured criteria hold.

use crate::{Model, Status, StepSettings};
use glam::Vec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Seams count as closed when no gap is wider than this [m].
const SEAM_GAP: f32 = 0.002;
/// A garment is at rest when its particles have on average the kinetic energy of this speed [m/s] or less.
const REST_SPEED: f32 = 0.02;
/// For so many frames on end: a swing has no speed at its turning points.
const CALM_FRAMES: u32 = 10;
/// Simulated time after which open seams are an error [s].
const SEWING_SECONDS: f32 = 3.0;
/// Simulated time that a sewn garment has to ease [s].
const EASING_SECONDS: f32 = 0.5;
/// Simulated time after which a garment that does not come to rest is an error [s].
const DRAPING_SECONDS: f32 = 8.0;
/// Viscous damping while sewing [1/s]: panels follow their seams without a momentum that would fold them over.
const SEWING_DAMPING: f32 = 20.0;
/// Viscous damping while draping, where the way does not matter, only the end [1/s].
const DRAPING_DAMPING: f32 = 8.0;

/// What a garment is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum DressingStage {
    /// Its seams are being closed, without gravity.
    Sewing,
    /// It is sewn and falls without friction to where it stretches least, its labelled edges still held.
    Easing,
    /// It comes to rest.
    Draping,
    /// It is at rest.
    Dressed,
}

/// The way of one garment onto a body.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Dressing {
    stage: DressingStage,
    rest_energy: f32,
    dt: f32,
    sewing_steps: u64,
    draping_steps: u64,
    seam_gap: f32,
    calm_frames: u32,
}

/// Why a garment could not be dressed.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DressingError {
    /// Seams stayed open.
    #[error("the seams did not close within {steps} steps: the widest gap is {gap_mm:.1} mm, more than {limit_mm} mm")]
    SeamsOpen {
        /// Steps sewn.
        steps: u64,
        /// Widest gap [mm].
        gap_mm: f32,
        /// Widest gap allowed [mm].
        limit_mm: f32,
    },
    /// The garment kept moving.
    #[error(
        "the garment did not come to rest within {steps} steps: its particles have {energy:.2e} J each, more than {limit:.2e} J; \
         a garment too tight for the body or the garments below it keeps moving: cut it wider, or wear it below them"
    )]
    NotAtRest {
        /// Steps draped.
        steps: u64,
        /// Mean kinetic energy of a particle [J].
        energy: f32,
        /// Mean kinetic energy allowed [J].
        limit: f32,
    },
    /// The simulation diverged.
    #[error(
        "the simulation diverged: {count} particles are not finite or faster than 1 km/s at step {step}, the first is particle {particle}"
    )]
    Diverged {
        /// Step at which it was seen.
        step: u64,
        /// First particle by index.
        particle: u32,
        /// Number of particles.
        count: u32,
    },
}

impl Dressing {
    /// The way of a garment onto a body, from its open model.
    pub fn new(open: &Model, settings: &StepSettings) -> Self {
        let mass = open.masses.iter().sum::<f32>() / open.particle_count().max(1) as f32;
        Self {
            stage: if open.seam_pairs.is_empty() { DressingStage::Draping } else { DressingStage::Sewing },
            rest_energy: 0.5 * mass * REST_SPEED * REST_SPEED,
            dt: settings.dt,
            sewing_steps: 0,
            draping_steps: 0,
            seam_gap: 0.0,
            calm_frames: 0,
        }
    }

    /// What the garment is doing.
    pub fn stage(&self) -> DressingStage {
        self.stage
    }

    /// Steps sewn so far.
    pub fn sewing_steps(&self) -> u64 {
        self.sewing_steps
    }

    /// Steps from the closed seams on.
    pub fn draping_steps(&self) -> u64 {
        self.draping_steps
    }

    /// Widest seam gap when the pairs were merged [m].
    pub fn seam_gap(&self) -> f32 {
        self.seam_gap
    }

    /// Takes the status at the end of a frame and says what to do next. When [`DressingStage::Sewing`] becomes
    /// [`DressingStage::Easing`] the solver must be handed over to the sewn model before its next step; when that becomes
    /// [`DressingStage::Draping`], to the draping settings.
    ///
    /// # Errors
    /// [`DressingError`] when the step limit is reached or the state is not finite.
    pub fn advance(&mut self, status: &Status, particle_count: u32) -> Result<DressingStage, DressingError> {
        if let Some(particle) = status.first_non_finite {
            return Err(DressingError::Diverged { step: status.step, particle, count: status.non_finite_count });
        }
        match self.stage {
            DressingStage::Sewing => {
                self.sewing_steps = status.step;
                self.seam_gap = status.seam_gap_max;
                if status.seam_gap_max <= SEAM_GAP {
                    self.stage = DressingStage::Easing;
                } else if self.sewing_steps as f32 * self.dt > SEWING_SECONDS {
                    return Err(DressingError::SeamsOpen {
                        steps: self.sewing_steps,
                        gap_mm: 1e3 * status.seam_gap_max,
                        limit_mm: 1e3 * SEAM_GAP,
                    });
                }
            }
            DressingStage::Easing => {
                self.draping_steps = status.step - self.sewing_steps;
                if self.draping_steps as f32 * self.dt >= EASING_SECONDS {
                    self.stage = DressingStage::Draping;
                }
            }
            DressingStage::Draping => {
                self.draping_steps = status.step - self.sewing_steps;
                let energy = status.kinetic_energy / particle_count.max(1) as f32;
                self.calm_frames = if energy <= self.rest_energy { self.calm_frames + 1 } else { 0 };
                if self.calm_frames >= CALM_FRAMES {
                    self.stage = DressingStage::Dressed;
                } else if self.draping_steps as f32 * self.dt > DRAPING_SECONDS {
                    return Err(DressingError::NotAtRest {
                        steps: self.draping_steps,
                        energy,
                        limit: self.rest_energy,
                    });
                }
            }
            DressingStage::Dressed => {}
        }
        Ok(self.stage)
    }
}

impl StepSettings {
    /// These settings while a garment is sewn: no gravity, no wind, no friction, no polish, and damped.
    pub fn sewing(&self) -> Self {
        Self { gravity: Vec3::ZERO, damping: self.damping.max(SEWING_DAMPING), ..self.easing() }
    }

    /// These settings while a garment eases, newly sewn or on the way to another pose: no wind, no friction, no polish, and damped; its
    /// labelled edges are still held.
    pub fn easing(&self) -> Self {
        Self { friction: 0.0, polish: None, ..self.indoors() }
    }

    /// These settings while a sewn garment comes to rest: no wind, damped, and held by the body alone.
    pub fn draping(&self) -> Self {
        Self { hold_rate: 0.0, ..self.indoors() }
    }

    /// Cloth in wind never comes to rest, so that a garment is dressed without.
    fn indoors(&self) -> Self {
        Self { wind: None, damping: self.damping.max(DRAPING_DAMPING), ..self.clone() }
    }
}

impl Model {
    /// Name and gap [m] of the seam that is open the widest at these positions; `None` without seams.
    pub fn widest_seam(&self, positions: &[Vec3]) -> Option<(&str, f32)> {
        let gap = |pair: &crate::SeamPair| {
            let [a, b] = pair.ends.map(|i| positions[i as usize]);
            a.distance(b)
        };
        let widest = self.seam_pairs.iter().max_by(|a, b| gap(a).total_cmp(&gap(b)))?;
        Some((&self.seam_names[widest.seam as usize], gap(widest)))
    }
}
