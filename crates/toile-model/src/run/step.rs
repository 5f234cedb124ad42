//! The numbers of one step, and the largest step that is stable.

use crate::cloth::aim;
use crate::{Level, Model, ModelError};
use glam::Vec3;
use toile_scene::{Friction, Polish, Rule, Settings, VelocityModification, Wind};

/// Passes of a sweep over the limits of single springs, of cloth of at most [`LEVELS_OF_SMALL_CLOTH`] levels; one more for each further level. Where
/// cloth whips or slaps on a body it becomes taut within a step over several cells, and over the more, the finer it is.
const LIMIT_PASSES: u32 = 2;

/// Passes over single springs after all sweeps, of cloth of at most [`LEVELS_OF_SMALL_CLOTH`] levels; one more for each further level.
const GUARD_PASSES: u32 = 2;

/// Threshold that the passes above hold [1]. Below it sweeps must leave less, and go over all limits more often.
const WIDE: f64 = 0.03;

/// How many times as often they do at most.
const TIGHTNESS_MAX: f64 = 4.0;

/// How much more than its excess a limit between coarse particles takes [1].
const COARSE_RELAXATION: f32 = 1.2;

/// Levels of a sheet of 64 × 64 particles.
const LEVELS_OF_SMALL_CLOTH: usize = 7;

/// Twenty times the weight of the cloth: of cotton about 30 Pa, as if it were drawn with 3 N/m around a waist [m/s²].
const PRESSING: f32 = 200.0;

/// The numbers of one step, the same for every particle.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct StepSettings {
    /// Time step [s].
    pub dt: f32,
    /// Steps from one frame to the next.
    pub steps_per_frame: u32,
    /// Gravity [m/s²].
    pub gravity: Vec3,
    /// The air around the cloth.
    pub wind: Option<Wind>,
    /// Viscous damping rate [1/s].
    pub damping: f32,
    /// Distance kept from bodies [m].
    pub thickness: f32,
    /// Largest speed at which a particle inside a body is moved out [m/s]; it changes positions, not velocities.
    pub push_speed: f32,
    /// A particle nearer to the surface than this is in contact [m].
    pub contact_margin: f32,
    /// Part of the approach velocity that a collision gives back [1]: C_refl of W eq. 15.
    pub reflection: f32,
    /// Friction law.
    pub law: Friction,
    /// Coulomb coefficient μ [1].
    pub friction: f32,
    /// Largest normal acceleration of a contact that friction counts [m/s²]. Where cloth is too tight to hold its limits, these press it
    /// on the body without bound, as no yarn could; friction by that would hold every particle where it is, however stretched.
    pub pressing: f32,
    /// Speed of a held edge towards its height, per metre from it [1/s].
    pub hold_rate: f32,
    /// Largest speed of a held edge towards its height [m/s].
    pub hold_speed: f32,
    /// Rule of the velocity modification.
    pub rule: Rule,
    /// Sweeps over all limits per step.
    pub sweeps: u32,
    /// How often a sweep goes over the limits of single springs.
    pub limit_passes: u32,
    /// How often a sweep goes over the limits of each level of coarse particles.
    pub coarse_passes: u32,
    /// How often the guard goes over the limits of single springs at the end of a step.
    pub guard_passes: u32,
    /// Further sweeps in steps that need them.
    pub polish: Option<Polish>,
    /// Whether the whole way of a point is tested against the bodies, not its end alone.
    pub swept: bool,
}

impl StepSettings {
    /// How often all seams are drawn and closed in a sweep. Where four particles meet at the corner of two seams, the pairs that are shut by then undo
    /// what the open ones were given; once more and they do not.
    pub const SEAM_PASSES: u32 = 2;

    /// The step of a model under the settings of its scene: the largest stable one times the safety factor, cut so that a
    /// whole number of steps makes a frame.
    pub fn new(settings: &Settings, model: &Model) -> Self {
        let frame = 1.0 / settings.frame_rate;
        let bound = model.step_wanted.unwrap_or(f64::INFINITY).min(settings.safety * stable_step(model));
        let steps_per_frame = (frame / bound - 1e-3).ceil().max(1.0);
        let VelocityModification { rule, sweeps, polish, .. } = settings.velocity_modification;
        let hierarchical = rule == Rule::Hierarchical;
        let tightness = (WIDE / settings.fabric.threshold.least()).round().clamp(1.0, TIGHTNESS_MAX) as u32;
        let further_passes = model.levels.len().saturating_sub(LEVELS_OF_SMALL_CLOTH) as u32;
        Self {
            dt: (frame / steps_per_frame) as f32,
            steps_per_frame: steps_per_frame as u32,
            gravity: settings.gravity.as_vec3(),
            wind: settings.wind,
            damping: settings.fabric.damping as f32,
            thickness: settings.fabric.thickness as f32,
            push_speed: 0.1,
            contact_margin: 1e-4,
            reflection: settings.reflection as f32,
            law: settings.friction,
            friction: settings.fabric.friction as f32,
            pressing: PRESSING,
            hold_rate: 10.0,
            hold_speed: 0.5,
            rule,
            sweeps: sweeps.unwrap_or(rule.sweeps()),
            limit_passes: if hierarchical { (LIMIT_PASSES + further_passes) * tightness } else { 1 },
            coarse_passes: tightness.min(2),
            guard_passes: (GUARD_PASSES + further_passes) * tightness.min(2),
            polish,
            swept: settings.swept,
        }
    }
}

impl StepSettings {
    /// Most steps of a frame. The default rule has 16 at 60 frames per second and 960 at one; a rule that leaves the tension to stiff springs
    /// has hundreds on fine cloth. More of them are a slip in a scene, which must not ask for years.
    pub const STEPS_PER_FRAME_MAX: u32 = 10_000;

    /// The same as [`StepSettings::new`], of a cloth with this name.
    ///
    /// # Errors
    /// [`ModelError::Steps`] when a frame would have more than [`StepSettings::STEPS_PER_FRAME_MAX`].
    pub fn of_cloth(name: &str, settings: &Settings, model: &Model) -> Result<Self, ModelError> {
        let step = Self::new(settings, model);
        let (steps, most) = (step.steps_per_frame, Self::STEPS_PER_FRAME_MAX);
        if steps > most {
            return Err(ModelError::Steps { cloth: name.to_owned(), steps, most });
        }
        Ok(step)
    }

    /// The same frame in so many more steps that it has a multiple of `parts`.
    pub fn in_parts(&self, parts: u32) -> Self {
        let steps_per_frame = self.steps_per_frame.next_multiple_of(parts);
        if steps_per_frame == self.steps_per_frame {
            return self.clone();
        }
        let frame = f64::from(self.dt) * f64::from(self.steps_per_frame);
        Self { dt: (frame / f64::from(steps_per_frame)) as f32, steps_per_frame, ..self.clone() }
    }

    /// The same step with the numbers of settings that may change while a cloth runs: gravity, air, damping, friction and reflection.
    pub fn with_numbers_of(&self, settings: &Settings) -> Self {
        Self {
            gravity: settings.gravity.as_vec3(),
            wind: settings.wind,
            damping: settings.fabric.damping as f32,
            friction: settings.fabric.friction as f32,
            reflection: settings.reflection as f32,
            law: settings.friction,
            ..self.clone()
        }
    }

    /// These settings at the step of others, as a cloth that runs keeps it.
    ///
    /// # Errors
    /// [`ModelError::Steps`] when they ask for a shorter one; `name` is that of the cloth.
    pub(crate) fn at_step_of(&self, name: &str, other: &Self) -> Result<Self, ModelError> {
        let (steps, most) = (self.steps_per_frame, other.steps_per_frame);
        if steps > most {
            return Err(ModelError::Steps { cloth: name.to_owned(), steps, most });
        }
        Ok(Self { dt: other.dt, steps_per_frame: most, ..self.clone() })
    }

    /// The part of [`Self::push_speed`] that each of the sweeps has [m/s]; further sweeps have as much each.
    pub fn push_speed_per_sweep(&self) -> f32 {
        self.push_speed / self.sweeps.max(1) as f32
    }

    /// Part of the threshold that the limits of the rule hold [1]; the rest is for what the sweeps leave.
    pub fn aim(&self) -> f32 {
        aim(self.rule)
    }

    /// How often a sweep goes over the limits of a level.
    pub fn level_passes(&self, level: &Level) -> u32 {
        if level.is_coarse() { self.coarse_passes } else { self.limit_passes }
    }

    /// Part of an excess that a pass of the guard removes from the springs of a colour [1]. All of it, but in the last pass every second colour
    /// leaves half: along a taut line it takes the rest over from the colour before, which would get all of it back.
    pub fn guard_share(&self, pass: u32, colour: u32) -> f32 {
        if pass + 1 == self.guard_passes && colour % 2 == 1 { 0.5 } else { 1.0 }
    }

    /// How much more than its excess a limit of a level takes [1]: what is behind the ends of coarse ones follows later.
    pub fn relaxation(level: &Level) -> f32 {
        if level.is_coarse() { COARSE_RELAXATION } else { 1.0 }
    }

    /// How much the guard shortens a spring at once [m]: the thickness in all its passes, for that is what it has to give way.
    pub fn guard_way(&self) -> f32 {
        self.thickness / self.guard_passes as f32
    }

    /// The change of normal speed by one sweep that friction counts at most [m/s]: what [`Self::pressing`] gives in a step, in equal parts;
    /// further sweeps count as much each.
    pub fn pressing_speed_per_sweep(&self) -> f32 {
        self.pressing * self.dt / self.sweeps.max(1) as f32
    }
}

/// Largest step [s] at which symplectic Euler is surely stable on this model's springs: 2/ω with Gershgorin's bound
/// ω² ≤ 2·Σk·w over the springs of a particle. Infinite without springs.
fn stable_step(model: &Model) -> f64 {
    let squared_rate = (0..model.positions.len())
        .map(|i| {
            let stiffness: f64 = model.links.row(i).iter().map(|l| f64::from(l.stiffness)).sum();
            2.0 * stiffness * f64::from(model.inverse_masses[i])
        })
        .fold(0.0, f64::max);
    2.0 / squared_rate.sqrt()
}
