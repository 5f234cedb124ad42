//! Numbers that have a range, each with its name, its unit and its place.

use std::fmt;
use std::ops::RangeInclusive;

/// A number of a fabric, of the air or of the settings, and what it may be.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Number<T> {
    /// Its name in a scene file.
    pub name: &'static str,
    /// What it may be.
    pub range: RangeInclusive<f64>,
    /// Its unit; empty is 1.
    pub unit: &'static str,
    /// Where it is kept.
    pub of: fn(&mut T) -> &mut f64,
}

impl<T: Clone> Number<T> {
    /// Its value.
    pub fn value(&self, holder: &T) -> f64 {
        *(self.of)(&mut holder.clone())
    }

    /// An error where it lies out of its range, or is no number. `prefix` stands before its name.
    ///
    /// # Errors
    /// [`OutOfRange`].
    pub(crate) fn check(&self, prefix: &str, holder: &T) -> Result<(), OutOfRange> {
        OutOfRange::check(format!("{prefix}{}", self.name), self.value(holder), &self.range, self.unit)
    }
}

/// A number that no scene has.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct OutOfRange {
    /// Which number, as a scene file has it: `fabric.thickness`.
    pub name: String,
    /// What it is.
    pub value: f64,
    /// What it may be.
    pub range: RangeInclusive<f64>,
    /// Its unit; empty is 1.
    pub unit: &'static str,
}

impl OutOfRange {
    /// An error where a value lies out of its range, or is no number.
    ///
    /// # Errors
    /// [`OutOfRange`] with this name.
    pub fn check(
        name: impl Into<String>,
        value: f64,
        range: &RangeInclusive<f64>,
        unit: &'static str,
    ) -> Result<(), Self> {
        if range.contains(&value) {
            return Ok(());
        }
        Err(Self { name: name.into(), value, range: range.clone(), unit })
    }
}

impl fmt::Display for OutOfRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let space = if self.unit.is_empty() { "" } else { " " };
        let (least, most) = (self.range.start(), self.range.end());
        write!(f, "{} is {} and must be {least} to {most}{space}{}", self.name, self.value, self.unit)
    }
}

impl std::error::Error for OutOfRange {}
