//! How a garment gets onto a body: sewn first, then draped, each until measured criteria hold.

use crate::{Model, Motion, Status, StepSettings};
use glam::Vec3;
use serde::{Deserialize, Serialize};
use toile_scene::Rule;

/// Seams count as closed when no gap is wider than this [m].
pub(crate) const SEAM_GAP: f32 = 0.002;
/// A garment is at rest when its particles move from frame to frame with this speed [m/s] or less, as the root of the mean square.
pub const REST_SPEED: f32 = 0.02;
/// For so many frames on end: a swing has no speed at its turning points.
pub const CALM_FRAMES: u32 = 10;
/// Longest simulated time that seams have to close [s].
const SEWING_SECONDS: f32 = 10.0;
/// Seams are stuck when the widest does not close by this [m] ...
const STUCK_GAP: f32 = 0.001;
/// ... in this simulated time [s]: what holds it open is not cloth that follows slowly.
const STUCK_SECONDS: f32 = 0.25;
/// Seams that are stuck and no wider are merged all the same [m]: the limits of the sewn cloth take back half of it on either side.
const MERGED_GAP: f32 = 0.01;
/// Simulated time that a sewn garment has to ease [s].
const EASING_SECONDS: f32 = 0.5;
/// A garment is far too tight for its limits when, eased, it has a spring that is stretched by its threshold and this [1]. No garment that fits
/// has one, and one that is only a little too tight gives way into its thickness, as evenly as it would otherwise.
const TIGHT_ABOVE: f32 = 0.1;
/// A garment that is sewn with a spring so much longer than its threshold allows [1] yields at once: limits over many cells would take that
/// back within a step, and throw the garment through the body.
const FAR_TOO_TIGHT_ABOVE: f32 = 0.4;
/// Simulated time that such a garment has to find where it must stretch [s].
const YIELDING_SECONDS: f32 = 0.5;
/// Simulated time that a garment has to come to rest [s].
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
    /// It is too tight for its limits: those of single springs alone share out among themselves where it stretches.
    Yielding,
    /// It comes to rest.
    Draping,
    /// It is at rest, or has not come to rest in its time.
    Dressed,
}

/// The way of one garment onto a body.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Dressing {
    stage: DressingStage,
    dt: f32,
    /// Whether its rule has limits that hold more than a spring.
    may_yield: bool,
    sewing_steps: u64,
    draping_steps: u64,
    seam_gap: f32,
    /// An eased garment whose largest elongation is above this is too tight for its limits [1].
    tight: f32,
    /// A sewn one whose largest elongation is above this yields at once [1].
    far_too_tight: f32,
    /// The step at which it began to yield.
    yielding_from: u64,
    /// Widest gap when it last had closed by [`STUCK_GAP`] [m], and the step of that.
    closing: (f32, u64),
    /// The step whose motion was looked at last.
    seen_step: u64,
    is_left_open: bool,
    calm_frames: u32,
}

impl Dressing {
    /// The way of a garment onto a body, from its open model.
    pub fn new(open: &Model, settings: &StepSettings) -> Self {
        Self {
            stage: if open.seam_pairs.is_empty() { DressingStage::Draping } else { DressingStage::Sewing },
            dt: settings.dt,
            may_yield: settings.rule == Rule::Hierarchical,
            sewing_steps: 0,
            draping_steps: 0,
            seam_gap: 0.0,
            tight: open.threshold.most() as f32 + TIGHT_ABOVE,
            far_too_tight: open.threshold.most() as f32 + FAR_TOO_TIGHT_ABOVE,
            yielding_from: 0,
            closing: (f32::INFINITY, 0),
            seen_step: 0,
            is_left_open: false,
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

    /// Widest seam gap at the end of sewing [m].
    pub fn seam_gap(&self) -> f32 {
        self.seam_gap
    }

    /// Whether seams were too wide to be merged when their time was up. The garment then goes on as its open model, see
    /// [`Piece::leave_open`](crate::Piece::leave_open).
    pub fn is_left_open(&self) -> bool {
        self.is_left_open
    }

    /// Whether the garment came to rest in its time.
    pub fn is_at_rest(&self) -> bool {
        self.calm_frames >= CALM_FRAMES
    }

    /// Takes the status at the end of a frame, and how the cloth moves once it drapes, and says what to do next. When [`DressingStage::Sewing`] becomes
    /// [`DressingStage::Easing`] the solver must be handed over to the sewn model before its next step, or to the open one where
    /// [`Dressing::is_left_open`]; when that becomes [`DressingStage::Draping`], to the draping settings. Every stage ends, so a garment
    /// always gets to [`DressingStage::Dressed`]; how it is worn then is for a [`Verdict`](crate::Verdict) to say.
    pub fn advance(&mut self, status: &Status, motion: &Motion) -> DressingStage {
        match self.stage {
            DressingStage::Sewing => {
                self.sewing_steps = status.step;
                self.seam_gap = status.seam_gap_max;
                if status.seam_gap_max < self.closing.0 - STUCK_GAP {
                    self.closing = (status.seam_gap_max, status.step);
                }
                let is_stuck = (status.step - self.closing.1) as f32 * self.dt > STUCK_SECONDS;
                let is_late = self.sewing_steps as f32 * self.dt > SEWING_SECONDS;
                if status.seam_gap_max <= SEAM_GAP || is_stuck || is_late {
                    let is_narrow = status.seam_gap_max <= MERGED_GAP;
                    self.is_left_open = !is_narrow;
                    let yields = self.may_yield && is_narrow && status.elongation_max > self.far_too_tight;
                    self.stage = self.yielding_or(yields, DressingStage::Easing, status);
                }
            }
            DressingStage::Easing => {
                self.draping_steps = status.step - self.sewing_steps;
                if self.draping_steps as f32 * self.dt >= EASING_SECONDS {
                    let yields = self.may_yield && !self.is_left_open && status.elongation_max > self.tight;
                    self.stage = self.yielding_or(yields, DressingStage::Draping, status);
                }
            }
            DressingStage::Yielding => {
                self.draping_steps = status.step - self.sewing_steps;
                // Where it lies must be known: its limits are let out to that.
                let seen = motion.step().saturating_sub(self.yielding_from);
                if seen as f32 * self.dt >= YIELDING_SECONDS {
                    self.stage = DressingStage::Draping;
                }
            }
            DressingStage::Draping => {
                self.draping_steps = status.step - self.sewing_steps;
                if let Some(speed) = motion.speed().filter(|_| motion.step() > self.seen_step) {
                    self.seen_step = motion.step();
                    self.calm_frames = if speed <= REST_SPEED { self.calm_frames + 1 } else { 0 };
                }
                if self.is_at_rest() || self.draping_steps as f32 * self.dt > DRAPING_SECONDS {
                    self.stage = DressingStage::Dressed;
                }
            }
            DressingStage::Dressed => {}
        }
        self.stage
    }

    /// The next stage of a garment that yields, from this status on, or of one that does not.
    fn yielding_or(&mut self, yields: bool, otherwise: DressingStage, status: &Status) -> DressingStage {
        if !yields {
            return otherwise;
        }
        self.yielding_from = status.step;
        DressingStage::Yielding
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

    /// These settings while a garment that is too tight for its limits finds where it stretches: as it eases, but with single springs alone.
    /// Longer limits around a bend give more of their pull to the body than straight ones, and leave it stretched the more.
    pub fn yielding(&self) -> Self {
        Self { rule: Rule::Predictive, ..self.easing() }
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
