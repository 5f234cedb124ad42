//! Sizes that bodies and panels can have; what is outside has the wrong unit.

/// Heights [m] that a body can have. Outside, the unit is wrong rather than the person.
pub(crate) const HEIGHTS: [f64; 2] = [0.2, 4.0];

/// Largest extent of a body to the sides [m]. Wider, something lies far from it, and its maps would be mostly empty.
pub(crate) const WIDTH_MAX: f64 = 10.0;

/// Largest side of a panel's box [m]. Above, the unit is wrong.
pub(crate) const LARGEST_PANEL: f64 = 10.0;
