//! The pose that a body is dressed in, where the host leaves the choice.

use super::{Fit, arms};
use glam::Vec3;
use toile_scene::{Garment, Mesh, MovingMesh};

/// Poses of a clip that are looked at.
const POSE_COUNT: u32 = 12;
/// A pose that stands farther from the first one than this [m] is no place for panels that were placed around it.
const STAND: f32 = 0.2;

/// Time in which arms go down [s].
const LOWERING_SECONDS: f64 = 1.0;

/// A pose, and how far from clear of the panels it stands.
pub(crate) struct Choice {
    /// The body in it; `None` is the first pose of its motion.
    pub(crate) body: Option<MovingMesh>,
    /// Time in the clip [s]; `None` without the clip.
    pub(crate) time: Option<f64>,
    /// Whether the arms are raised against what stands there.
    pub(crate) has_raised_arms: bool,
}

/// The first of these that stands clear of the panels as they are placed and of what their seams sweep, or else the clearest: the first pose of the
/// motion, the pose without a clip, both with level arms, poses over the clip. Patterns are placed around a body that stands still: a leg
/// that strides would stand in front of them.
pub(crate) fn choose(body: &MovingMesh, garments: &[&Garment]) -> Choice {
    let mut best = Choice { body: None, time: Some(0.0), has_raised_arms: false };
    let first = Fit::misfit(&body.mesh, garments);
    let mut least = first.all();
    if least == 0 {
        return best;
    }
    let resting = || body.at_rest().map(|resting| (resting, None, false));
    let raised = || {
        let resting = body.at_rest().and_then(|resting| arms::raised(&resting)).map(|raised| (raised, None, true));
        let raised = resting.into_iter().chain(arms::raised(body).map(|raised| (raised, Some(0.0), true)));
        raised.filter(|_| first.swept > 0)
    };
    let posed = (1..=POSE_COUNT).filter_map(|index| {
        let time = body.duration() * f64::from(index) / f64::from(POSE_COUNT + 1);
        body.held(time).map(|held| (held, Some(time), false))
    });
    let still = std::iter::once_with(resting).flatten().chain(std::iter::once_with(raised).flatten());
    for (pose, time, has_raised_arms) in still.chain(posed.filter(|_| body.duration() > 0.0)) {
        if time.is_some() && middle(&pose.mesh).distance(middle(&body.mesh)) > STAND {
            continue;
        }
        let misfit = Fit::misfit(&pose.mesh, garments).all();
        if misfit < least {
            least = misfit;
            best = Choice { body: Some(pose), time, has_raised_arms };
        }
        if least == 0 {
            break;
        }
    }
    best
}

/// The way of a body at rest from level arms to how it stands, where seams would close around them and it stands clearer so.
pub(crate) fn raise_arms(body: &Mesh, garments: &[&Garment]) -> Option<MovingMesh> {
    let standing = Fit::misfit(body, garments);
    if standing.swept == 0 {
        return None;
    }
    let jointed = arms::jointed(body)?;
    let raised = arms::raised(&jointed)?;
    (Fit::misfit(&raised.mesh, garments).all() < standing.all())
        .then(|| MovingMesh::transition(&raised, &jointed, LOWERING_SECONDS))?
}

fn middle(mesh: &Mesh) -> Vec3 {
    mesh.bounds().map_or(Vec3::ZERO, |[low, high]| low.midpoint(high))
}
