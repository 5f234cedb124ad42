//! Values of keys, each checked where its range is known.

use crate::error::{Found, Place};
use glam::DVec3;
use std::fmt::Display;
use std::ops::RangeInclusive;

/// Lengths of a sheet, a sphere's radius [m] and periods [s]: what is smaller or larger is a slip of the keyboard.
pub(crate) const SIZES: RangeInclusive<f64> = 1e-3..=1e3;
/// Largest component of a vector: positions [m], velocities [m/s] and gravity [m/s²] beyond it are slips too.
const COMPONENT_MAX: f64 = 1e6;
/// A fault of the value of a key.
pub(crate) fn wrong(key: &str, message: impl Into<String>) -> Found {
    Found::malformed(Place::Key(key.into()), message)
}

/// The value, where it lies in a range; the unit stands in the error.
pub(crate) fn within<T>(key: &str, value: T, range: RangeInclusive<T>, unit: &str) -> Result<T, Found>
where
    T: PartialOrd + Display,
{
    if range.contains(&value) {
        return Ok(value);
    }
    let space = if unit.is_empty() { "" } else { " " };
    Err(wrong(key, format!("it is {value} and must be {} to {}{space}{unit}", range.start(), range.end())))
}

/// Three numbers, where none is a slip of the keyboard.
pub(crate) fn vector(key: &str, value: [f64; 3]) -> Result<DVec3, Found> {
    if value.iter().all(|component| component.abs() <= COMPONENT_MAX) {
        return Ok(DVec3::from(value));
    }
    Err(wrong(key, format!("it must be three numbers of at most {COMPONENT_MAX}")))
}
