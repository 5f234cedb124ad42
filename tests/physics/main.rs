//! Physics on the device: what must hold whatever the implementation.

mod friction;
mod laws;
mod polish;
mod stability;
mod strain;
mod wind;
