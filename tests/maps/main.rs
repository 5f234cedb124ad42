//! The maps: what the device draws is what the reference draws, and what they say of bodies is true.

mod layers;
mod plan;
mod sides;
