//! How a point answers a surface. W §5, eq. 15.

use glam::Vec3;
use toile_model::StepSettings;
use toile_scene::Friction;

/// What a particle touched in the last step. The default is nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Unit normal of the surface, outward.
    pub normal: Vec3,
    /// Velocity of the surface [m/s].
    pub velocity: Vec3,
    /// Whether there was a contact.
    pub touching: bool,
}

/// The surface nearest to a point. The default is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Probe {
    /// Unit normal of the surface, outward.
    pub normal: Vec3,
    /// Distance to the surface [m], negative inside.
    pub distance: f32,
    /// Velocity of the surface [m/s].
    pub velocity: Vec3,
    /// Whether there is a surface to answer to.
    pub hit: bool,
}

/// Whether a point with velocity `velocity` [m/s] is in contact with its probe at the end of the coming move.
pub(crate) fn touches(velocity: Vec3, probe: &Probe, settings: &StepSettings) -> bool {
    let approach = (velocity - probe.velocity).dot(probe.normal);
    probe.hit && probe.distance + approach * settings.dt < settings.contact_margin
}

/// By how much the normal speed of a point must grow [m/s] so that the coming move does not enter the surface, with the
/// part of the approach that the collision gives back; 0 when it need not.
pub(crate) fn missing_speed(velocity: Vec3, probe: &Probe, settings: &StepSettings) -> f32 {
    let approach = (velocity - probe.velocity).dot(probe.normal);
    let wanted = (-probe.distance / settings.dt).min(0.0);
    if approach < wanted { wanted.max(-(settings.reflection * approach)) - approach } else { 0.0 }
}

/// Change of velocity [m/s] when the normal speed of a point grows by `gain` [m/s], with the friction that goes with it.
/// W eq. 15 on the velocity relative to the surface.
pub(crate) fn change(velocity: Vec3, probe: &Probe, gain: f32, settings: &StepSettings) -> Vec3 {
    let relative = velocity - probe.velocity;
    let approach = relative.dot(probe.normal);
    let tangential = relative - probe.normal * approach;
    let slip = match settings.law {
        Friction::Papers { velocity_kept, .. } => tangential * velocity_kept as f32,
        Friction::Coulomb => {
            let speed = tangential.length();
            let stopped = settings.friction * gain.min(settings.pressing_speed_per_sweep());
            if speed > stopped { tangential * ((speed - stopped) / speed) } else { Vec3::ZERO }
        }
    };
    (slip + probe.normal * (approach + gain)) - relative
}
