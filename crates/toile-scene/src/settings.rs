//! How a scene is simulated.

use crate::{Fabric, Number};
use glam::DVec3;
use std::ops::RangeInclusive;

/// How a scene is simulated.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Settings {
    /// What every cloth is made of that has no fabric of its own.
    pub fabric: Fabric,
    /// What keeps the cloth from stretching like rubber.
    pub velocity_modification: VelocityModification,
    /// How the cloth slides on a body.
    pub friction: Friction,
    /// Part of the approach velocity that a collision gives back [1], 0 to 1: C_refl of W eq. 15.
    pub reflection: f64,
    /// Gravity [m/s²].
    pub gravity: DVec3,
    /// The air around the cloth; `None` is none, not even still air.
    pub wind: Option<Wind>,
    /// Distance of neighbouring particles along warp and weft [m].
    pub spacing: f64,
    /// How the maps see bodies.
    pub maps: MapKind,
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
    /// Spacings that make cloth [m]: below, a dress has millions of particles; above, its panels have none inside.
    pub const SPACINGS: RangeInclusive<f64> = 0.001..=0.1;
    /// Texels that show a body [m].
    pub const TEXELS: RangeInclusive<f64> = 0.0005..=0.05;
    /// Frame rates that show a motion [1/s].
    pub const FRAME_RATES: RangeInclusive<f64> = 1.0..=1000.0;
    /// Safety factors that leave a step [1].
    pub const SAFETIES: RangeInclusive<f64> = 0.01..=1.0;
    /// The numbers that have a range, by the names that scenes give them.
    pub const NUMBERS: &[Number<Self>] = &[
        Number { name: "spacing", range: Self::SPACINGS, unit: "m", of: |settings| &mut settings.spacing },
        Number { name: "texel", range: Self::TEXELS, unit: "m", of: |settings| &mut settings.texel },
        Number { name: "frame_rate", range: Self::FRAME_RATES, unit: "1/s", of: |settings| &mut settings.frame_rate },
        Number { name: "safety", range: Self::SAFETIES, unit: "", of: |settings| &mut settings.safety },
        Number { name: "reflection", range: 0.0..=1.0, unit: "", of: |settings| &mut settings.reflection },
    ];
    /// Most particles of a cloth: four times the 1024² grid that the step is made for.
    pub const PARTICLE_COUNT_MAX: u32 = 4 << 20;

    /// The default settings for a fabric: two sweeps of hierarchical limits, Coulomb friction, particles at 1 cm, texels of 0.5 cm (D eq. 11),
    /// 60 frames per second.
    pub fn new(fabric: Fabric) -> Self {
        Self {
            fabric,
            velocity_modification: VelocityModification::new(Rule::Hierarchical),
            friction: Friction::Coulomb,
            reflection: 0.0,
            gravity: DVec3::new(0.0, -9.81, 0.0),
            wind: None,
            spacing: 0.01,
            maps: MapKind::Layers,
            texel: 0.005,
            frame_rate: 60.0,
            safety: 0.8,
            swept: true,
        }
    }

    /// The same settings for a cloth of this fabric; `None` is theirs.
    pub fn of_fabric(&self, fabric: Option<&Fabric>) -> Self {
        let fabric = fabric.unwrap_or(&self.fabric).clone();
        Self { fabric, ..self.clone() }
    }
}

/// Density of the air [kg/m³]: dry air at 20 °C and sea level.
pub const AIR_DENSITY: f64 = 1.2;

/// The air around the cloth. Each quad is a flat plate in it: with u the velocity of the air relative to the quad, A its area and
/// α the angle between u and its normal, it is dragged along u by ½·[`AIR_DENSITY`]·A·u²·|cos α|·`drag` and lifted across u, in
/// the plane of u and the normal, by ½·[`AIR_DENSITY`]·A·u²·|cos α|·sin α·`lift`. Air at rest brakes the cloth all the same.
///
/// The force is divided by 1 + dt·rate, where rate [1/s] is ½·[`AIR_DENSITY`]·A·u·|cos α|·(`drag` + `lift`) over the mass of the
/// quad, so that a step of length dt does not overshoot the air's velocity. With the coefficients of [`Wind::new`], cloth of
/// 0.2 kg/m² across a wind of 10 m/s and steps of 1 ms it is 7 % smaller for that.
///
/// No part of the cloth shelters another, and the cloth does not change the wind.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Wind {
    /// Velocity of the air [m/s].
    pub velocity: DVec3,
    /// Drag coefficient of a plate across the wind [1], 0 or more.
    pub drag: f64,
    /// Lift coefficient [1], 0 or more: that of the pressure on an inclined plate.
    pub lift: f64,
    /// How much more the air presses on the inside of the cloth than on its outside [Pa]: what is closed is blown up, and a sail stands.
    /// It stays the same however much the cloth holds.
    pub pressure: f64,
}

impl Wind {
    /// Wind with the drag coefficient of a square flat plate across the wind, 1.17 (Matthews, Aeronautical Engineer's Data Book,
    /// 2002, figure 5.13), and the same for lift: what a pressure of 1.17·|cos α| along the normal has across the wind.
    pub fn new(velocity: DVec3) -> Self {
        Self { velocity, drag: 1.17, lift: 1.17, pressure: 0.0 }
    }

    /// Components of velocities that air has [m/s]: no storm is faster.
    pub const VELOCITIES: RangeInclusive<f64> = -100.0..=100.0;

    /// The numbers beside the velocity, by the names that scenes give them.
    pub const NUMBERS: &[Number<Self>] = &[
        Number { name: "drag", range: 0.0..=100.0, unit: "", of: |wind| &mut wind.drag },
        Number { name: "lift", range: 0.0..=100.0, unit: "", of: |wind| &mut wind.lift },
        Number { name: "pressure", range: -1e4..=1e4, unit: "Pa", of: |wind| &mut wind.pressure },
    ];
}

/// What keeps the cloth from stretching like rubber.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct VelocityModification {
    /// Which rule.
    pub rule: Rule,
    /// How often the rule goes over all limits in one step; after each time the cloth answers the bodies. `None` is as often as the rule
    /// is made for: [`Rule::sweeps`].
    pub sweeps: Option<u32>,
    /// Further sweeps in steps that need them; `None` is none. It needs [`Rule::Predictive`] or [`Rule::Hierarchical`].
    pub polish: Option<Polish>,
}

impl VelocityModification {
    /// Sweeps per step that make sense.
    pub const SWEEPS: RangeInclusive<u32> = 1..=64;

    /// A rule with the sweeps that it is made for.
    pub fn new(rule: Rule) -> Self {
        Self { rule, sweeps: None, polish: None }
    }
}

/// Further sweeps in the steps that need them, and a bound on them.
///
/// After the sweeps of a step, the springs are measured as the coming move would leave them. While one is stretched beyond the target,
/// another sweep follows, at most so many; a step that then still misses the target is counted. A step that holds it moves
/// as if there were no polish.
///
/// A sweep goes on until limits hold, not until the target does. Those of [`Rule::Hierarchical`] are at three fifths of
/// the fabric's threshold, so that a target below is missed in every step where springs are taut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polish {
    /// Largest elongation that needs no further sweep [1], in [`Polish::TARGETS`].
    pub target: f64,
    /// At most so many further sweeps in a step, in [`Polish::SWEEPS`].
    pub sweeps: u32,
}

impl Polish {
    /// Targets that make sense [1].
    pub const TARGETS: RangeInclusive<f64> = 0.001..=0.5;
    /// Further sweeps that make sense.
    pub const SWEEPS: RangeInclusive<u32> = 1..=64;
}

/// How the ends of an over-long spring change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rule {
    /// Not at all.
    #[default]
    None,
    /// Both axial velocities become zero. D §4.3.
    Zero,
    /// Both axial velocities become their mean. W eq. 5.
    Average,
    /// The rear end takes the axial velocity of the front end along v_dir. W §3.2, eq. 6.
    Directional,
    /// Both ends are moved together after the step. Provot; W §3.1.
    Position,
    /// The part of the velocities that would make the spring over-long after the coming move is removed. A spring begins each step with
    /// half of the impulse that it ended the last one with.
    Predictive,
    /// The same, and before it on limits that span 2, 4, 8… cells, the longest first, so that a sweep reaches far; and where the cloth
    /// has pins, from each of them outward. After the sweeps no contact may leave a spring stretched more than twice as far as its limit, as far as
    /// the thickness of the cloth gives way, unless seams are open.
    Hierarchical,
}

impl Rule {
    /// Every rule, by the name that scenes give it.
    pub const ALL: [(&'static str, Self); 7] = [
        ("none", Self::None),
        ("zero", Self::Zero),
        ("average", Self::Average),
        ("directional", Self::Directional),
        ("position", Self::Position),
        ("predictive", Self::Predictive),
        ("hierarchical", Self::Hierarchical),
    ];

    /// Sweeps per step that the rule is made for: two of hierarchical limits, one of all others.
    pub fn sweeps(self) -> u32 {
        if self == Self::Hierarchical { 2 } else { 1 }
    }
}

/// How the maps see bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// All that the columns of three axes meet: limbs, sides and bodies that turn. D §8, W §7.
    Layers,
    /// What two cameras along z see, from the front and the back: the papers' maps. W §4.
    Sides,
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
