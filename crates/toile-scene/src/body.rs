//! What the cloth collides with.

use crate::Mesh;
use glam::DVec3;

/// Something the cloth collides with.
#[derive(Clone, Debug)]
pub enum Body {
    /// A mesh at rest, sampled through its depth and normal maps.
    Mesh(Mesh),
    /// An analytic sphere, tested exactly and without maps.
    Sphere(Sphere),
}

/// An analytic sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre at time 0 [m].
    pub centre: DVec3,
    /// Radius [m], positive.
    pub radius: f64,
    /// How the centre moves.
    pub motion: SphereMotion,
}

/// How the centre of a sphere moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SphereMotion {
    /// It does not.
    Still,
    /// There and back: centre + amplitude·(1 − cos(2π·time/period))/2, which starts at rest.
    Swing {
        /// Farthest displacement from the centre at time 0 [m].
        amplitude: DVec3,
        /// Time of one swing there and back [s], positive.
        period: f64,
    },
    /// Straight on while it turns.
    Steady {
        /// Velocity [m/s].
        velocity: DVec3,
        /// Angular velocity [rad/s].
        spin: DVec3,
    },
}

impl Sphere {
    /// Centre [m] and velocity [m/s] at a time [s].
    pub fn at(&self, time: f64) -> (DVec3, DVec3) {
        match self.motion {
            SphereMotion::Still => (self.centre, DVec3::ZERO),
            SphereMotion::Steady { velocity, .. } => (self.centre + velocity * time, velocity),
            SphereMotion::Swing { amplitude, period } => {
                let rate = std::f64::consts::TAU / period;
                let (sin, cos) = (rate * time).sin_cos();
                (self.centre + amplitude * (0.5 * (1.0 - cos)), amplitude * (0.5 * rate * sin))
            }
        }
    }

    /// Angular velocity [rad/s].
    pub fn spin(&self) -> DVec3 {
        match self.motion {
            SphereMotion::Still | SphereMotion::Swing { .. } => DVec3::ZERO,
            SphereMotion::Steady { spin, .. } => spin,
        }
    }
}
