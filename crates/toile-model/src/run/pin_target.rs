//! A particle that a host holds or lets go.

use glam::Vec3;

/// A particle that a host holds, moves or lets go, as it is told before the next steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinTarget {
    /// The particle.
    pub particle: u32,
    /// Where it is wanted [m].
    pub position: Vec3,
    /// One by the time that it has for its way [1/s]; 0 has it stand still where it is.
    pub rate: f32,
    /// Whether it is held; otherwise it is free from now on, with the velocity that it has.
    pub is_held: bool,
}

impl PinTarget {
    /// A particle that is at a place [m] after some seconds.
    pub fn held(particle: u32, position: Vec3, seconds: f64) -> Self {
        Self { particle, position, rate: (1.0 / seconds) as f32, is_held: true }
    }

    /// A particle that stands still where it is.
    pub fn still(particle: u32) -> Self {
        Self { particle, position: Vec3::ZERO, rate: 0.0, is_held: true }
    }

    /// A particle that is free.
    pub fn free(particle: u32) -> Self {
        Self { particle, position: Vec3::ZERO, rate: 0.0, is_held: false }
    }
}
