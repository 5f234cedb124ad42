//! The response of a point to a surface, shared by quads and particles. W §5, eq. 15.

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

/// How a point answers a surface. The default is not at all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    /// Change of velocity [m/s].
    pub change: Vec3,
    /// Change of position that leads out of the body [m]; it does not change the velocity.
    pub push: Vec3,
    /// Whether the point is in contact.
    pub touching: bool,
}

/// The response of a point with velocity `velocity` [m/s] to its probe. W eq. 15 on the velocity relative to the surface,
/// with the approach cut so that the coming move ends on the surface.
pub(crate) fn response(velocity: Vec3, probe: &Probe, settings: &StepSettings) -> Response {
    let dt = settings.dt;
    let normal = probe.normal;
    let relative = velocity - probe.velocity;
    let approach = relative.dot(normal);
    if !(probe.hit && probe.distance + approach * dt < settings.contact_margin) {
        return Response::default();
    }
    let push = normal * (-probe.distance).max(0.0).min(settings.push_speed * dt);
    let wanted = (-probe.distance / dt).min(0.0);
    if !(approach < wanted) {
        return Response { change: Vec3::ZERO, push, touching: true };
    }
    let rebound = wanted.max(-(settings.reflection * approach));
    let tangential = relative - normal * approach;
    let slip = match settings.law {
        Friction::Papers { velocity_kept, .. } => tangential * velocity_kept as f32,
        Friction::Coulomb => {
            let speed = tangential.length();
            let limit = settings.friction * (rebound - approach);
            if speed > limit { tangential * ((speed - limit) / speed) } else { Vec3::ZERO }
        }
    };
    Response { change: (slip + normal * rebound) - relative, push, touching: true }
}
