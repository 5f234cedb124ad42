//! Panels that stand in the body are moved along their facing until they are clear of it.

use super::FitError;
use super::figure::Figure;
use super::finding::{Finding, InBody};
use super::laid::Laid;
use crate::Inside;
use glam::DVec3;
use toile_scene::{Garment, Panel};

/// How far a panel is moved at most [m].
const REACH: f64 = 0.5;
/// Steps in which a clear place is sought [m].
const STEP: f64 = 0.01;
/// A panel is clear when it could go back by this and still stand outside [m].
const SPARE: f64 = 0.01;

/// What stands in the body's way: the body's inside, and the person that it is.
pub(crate) struct Obstacle<'a> {
    pub(crate) inside: &'a Inside,
    pub(crate) figure: Option<&'a Figure>,
}

/// Moves the panels of a garment that stand in a body out of it: outward; away from an arm that is none of theirs, also inward.
///
/// # Errors
/// [`FitError::InBody`] when no way out of a person is free.
pub(crate) fn clear(garment: &mut Garment, laid: &[Laid], obstacle: &Obstacle<'_>) -> Result<Vec<Finding>, FitError> {
    let mut findings = Vec::new();
    for (panel, laid) in garment.panels.iter_mut().zip(laid) {
        let Some(place) = place_in_body(panel, laid, obstacle) else { continue };
        let (garment, name) = (garment.name.clone(), panel.name.clone());
        let facing = laid.facing(panel);
        match way_out(panel, laid, obstacle, facing, &place) {
            Some(distance) => {
                panel.placement.translation += facing * distance;
                findings.push(Finding::MovedPanel { garment, panel: name, distance, place });
            }
            None if obstacle.figure.is_some() => {
                return Err(FitError::InBody { garment, panel: name, place, reach_cm: 1e2 * REACH });
            }
            // What is no person may be a stand that a garment is meant to hang in.
            None => findings.push(Finding::LeftPanel { garment, panel: name, place }),
        }
    }
    Ok(findings)
}

/// Where a panel stands in a body; `None` where it stands outside.
fn place_in_body(panel: &Panel, laid: &Laid, obstacle: &Obstacle<'_>) -> Option<InBody> {
    let found = laid.places_inside(panel, obstacle.inside);
    let facing = laid.facing(panel);
    let depth = |place: &DVec3| {
        let steps = (1..=(REACH / STEP) as u32).map(|step| f64::from(step) * STEP);
        steps.take_while(|distance| obstacle.inside.holds(*place + facing * *distance)).last().unwrap_or(0.0)
    };
    let depths = found.iter().map(|place| (depth(place), *place));
    let (depth, deepest) = depths.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let part = obstacle.figure.map_or("body", |figure| figure.part_at(deepest));
    Some(InBody { part, depth: depth + STEP, area: Laid::area(found.len()) })
}

/// How far along its facing a panel is clear [m].
fn way_out(panel: &Panel, laid: &Laid, obstacle: &Obstacle<'_>, facing: DVec3, place: &InBody) -> Option<f64> {
    let is_free = |distance: f64| laid.places(panel).all(|at| !obstacle.inside.holds(at + facing * distance));
    let count = (REACH / STEP) as i32;
    let clear = |step: &i32| {
        let distance = f64::from(*step) * STEP;
        is_free(distance) && is_free(distance - SPARE * distance.signum())
    };
    let out = (1..=count).find(clear);
    // Cloth before a hand that hangs before the hip would be sewn around both.
    let is_in_arm = place.part.ends_with("arm");
    let own = obstacle.figure.is_some_and(|figure| figure.part_at(laid.middle(panel)).ends_with("arm"));
    let back = (is_in_arm && !own).then(|| (1..=count).map(|step| -step).find(clear)).flatten();
    let nearest = [out, back].into_iter().flatten().min_by_key(|step| step.abs())?;
    Some(f64::from(nearest) * STEP)
}
