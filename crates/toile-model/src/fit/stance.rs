//! Which way is up for a body, and where it faces.

use super::axis::{Axis, quarter_turns};
use super::figure::Figure;
use super::finding::Finding;
use super::section::Skin;
use super::{FitError, FitOptions};
use glam::{DMat3, DVec2, DVec3};
use toile_scene::Mesh;

/// A body that faces +z by this much or less aside is left as it stands [°]: people twist as they walk.
const ASIDE: f64 = 40.0;
/// A body that faces an axis by this much or less aside is turned by quarters, which has no rounding [°].
const QUARTER: f64 = 20.0;
/// Heights that people have [m].
const HEIGHTS: [f64; 2] = [0.5, 2.5];

/// How a body has to be turned, and what is said of it.
pub(crate) struct Stance {
    pub(crate) turn: DMat3,
    pub(crate) findings: Vec<Finding>,
}

/// How a body has to be turned to stand upright and face +z. Of what is no person, no word is said.
///
/// # Errors
/// [`FitError::Lies`] when it is a person by more than one way up.
pub(crate) fn of(body: &Mesh, options: &FitOptions) -> Result<Stance, FitError> {
    let figure = |up: Axis| Figure::of(&Skin::turned(body, up.upright()));
    let mut stance = Stance { turn: DMat3::IDENTITY, findings: Vec::new() };
    let (up, person) = match options.up {
        Some(up) => (up, figure(up)),
        None => match figure(Axis::Y) {
            Some(person) => (Axis::Y, Some(person)),
            None => {
                let others = Axis::ALL.into_iter().filter(|up| *up != Axis::Y);
                let found: Vec<_> = others.filter_map(|up| Some((up, figure(up)?))).collect();
                match <[_; 1]>::try_from(found) {
                    Ok([(up, person)]) => (up, Some(person)),
                    Err(several) if several.is_empty() => (Axis::Y, None),
                    Err(_) => {
                        let size = body.bounds().map_or(DVec3::ZERO, |[low, high]| (high - low).as_dvec3());
                        return Err(FitError::Lies { height: size.y, length: size.max_element() });
                    }
                }
            }
        },
    };
    if up != Axis::Y {
        stance.findings.push(Finding::TurnedUpright { up });
    }
    let facing = match (options.facing, &person) {
        (Some(facing), _) => DVec2::new(facing.direction().x, facing.direction().z),
        (None, Some(Figure { facing: Some(facing), .. })) => *facing,
        (None, _) => DVec2::Y,
    };
    let degrees = -facing.x.atan2(facing.y).to_degrees();
    if degrees.abs() > ASIDE {
        // Both ways around are half a turn.
        let quarters = if degrees < -135.0 { 2.0 } else { (degrees / 90.0).round() };
        let is_quarter = (degrees - 90.0 * quarters).abs() <= QUARTER || (degrees + 180.0).abs() <= QUARTER;
        let degrees = if is_quarter { 90.0 * quarters } else { degrees.round() };
        let about = match is_quarter {
            true => quarter_turns(Axis::Y, quarters as i64),
            false => DMat3::from_rotation_y(degrees.to_radians()),
        };
        stance.turn = about * up.upright();
        let facing = Axis::nearest(DVec3::new(facing.x, 0.0, facing.y));
        stance.findings.push(Finding::TurnedAbout { degrees, facing });
    } else {
        stance.turn = up.upright();
    }
    if let Some(person) = person.filter(|person| !(HEIGHTS[0]..=HEIGHTS[1]).contains(&person.height())) {
        stance.findings.push(Finding::Size { height: person.height() });
    }
    Ok(stance)
}
