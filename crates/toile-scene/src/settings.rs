//! How a scene is simulated.

use crate::Fabric;
use glam::DVec3;

/// How a scene is simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The cloth.
    pub fabric: Fabric,
    /// What keeps the cloth from stretching like rubber.
    pub velocity_modification: VelocityModification,
    /// How the cloth slides on a body.
    pub friction: Friction,
    /// Part of the approach velocity that a collision gives back [1], 0 to 1: C_refl of W eq. 15.
    pub reflection: f64,
    /// Gravity [m/s²].
    pub gravity: DVec3,
    /// Distance of neighbouring particles along warp and weft [m].
    pub spacing: f64,
    /// Edge length of a map texel [m]. D eq. 11.
    pub texel: f64,
    /// Frames per second of simulated time [1/s].
    pub frame_rate: f64,
    /// Part of the largest stable step that is used [1], 0 to 1.
    pub safety: f64,
    /// Whether the whole way of a point is tested against the bodies, not its end alone: fast bodies and fast cloth then do not
    /// pass through each other.
    pub swept: bool,
}

impl Settings {
    /// The default settings for a fabric: one predictive sweep, Coulomb friction, particles at 1 cm, texels of 0.5 cm (D eq. 11),
    /// 60 frames per second.
    pub fn new(fabric: Fabric) -> Self {
        Self {
            fabric,
            velocity_modification: VelocityModification { rule: Rule::Predictive, sweeps: 1 },
            friction: Friction::Coulomb,
            reflection: 0.0,
            gravity: DVec3::new(0.0, -9.81, 0.0),
            spacing: 0.01,
            texel: 0.005,
            frame_rate: 60.0,
            safety: 0.8,
            swept: true,
        }
    }
}

/// What keeps the cloth from stretching like rubber.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VelocityModification {
    /// Which rule.
    pub rule: Rule,
    /// How often the rule goes over all limits in one step.
    pub sweeps: u32,
}

/// How the ends of an over-long spring change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Not at all.
    None,
    /// Both axial velocities become zero. D §4.3.
    Zero,
    /// Both axial velocities become their mean. W eq. 5.
    Average,
    /// The rear end takes the axial velocity of the front end along v_dir. W §3.2, eq. 6.
    Directional,
    /// Both ends are moved together after the step. Provot; W §3.1.
    Position,
    /// The part of the velocities that would make the spring over-long after the coming move is removed.
    Predictive,
}

/// How the cloth slides on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// Coulomb: the tangential impulse is at most μ times the normal one, so cloth sticks on slopes up to atan(μ).
    /// μ is [`Fabric::friction`].
    Coulomb,
    /// The papers' law. It creeps on every slope.
    Papers {
        /// Part of the tangential velocity that a collision keeps [1]: C_fric of W eq. 15; 1 is no friction.
        velocity_kept: f64,
        /// Part of the tangential force that a contact removes [1]: C_fric of W eq. 16; 1 is full friction.
        force_removed: f64,
    },
}
