//! What the cloth collides with.

use crate::{Mesh, MovingMesh, RigidMotion};
use glam::DVec3;

/// Something the cloth collides with.
#[derive(Clone, Debug)]
pub enum Body {
    /// A mesh at rest, sampled through its depth and normal maps.
    Mesh(Mesh),
    /// A mesh that moves, sampled through its depth, normal and velocity maps.
    Moving(MovingMesh),
    /// An analytic sphere, tested exactly and without maps.
    Sphere(Sphere),
}

/// An analytic sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    /// Centre [m] before it moves.
    pub centre: DVec3,
    /// Radius [m], positive.
    pub radius: f64,
    /// How it moves.
    pub motion: SphereMotion,
}

/// How a sphere moves.
#[derive(Clone, Debug, PartialEq)]
pub enum SphereMotion {
    /// Not at all.
    Still,
    /// There and back: centre + amplitude·(1 − cos(2π·time/period))/2, which starts at rest.
    Swing {
        /// Farthest displacement from the centre at time 0 [m].
        amplitude: DVec3,
        /// Time of one swing there and back [s], positive.
        period: f64,
    },
    /// By keys: the centre is displaced by their translation, and the sphere turns about its centre by their rotation.
    Keys(RigidMotion),
}

impl Sphere {
    /// Centre [m] and velocity [m/s] at a time [s].
    pub fn at(&self, time: f64) -> (DVec3, DVec3) {
        match &self.motion {
            SphereMotion::Still => (self.centre, DVec3::ZERO),
            SphereMotion::Swing { amplitude, period } => {
                let rate = std::f64::consts::TAU / period;
                let (sin, cos) = (rate * time).sin_cos();
                (self.centre + *amplitude * (0.5 * (1.0 - cos)), *amplitude * (0.5 * rate * sin))
            }
            SphereMotion::Keys(keys) => (self.centre + keys.at(time).0, keys.velocity(time).0),
        }
    }
    /// Angular velocity [rad/s] at a time [s].
    pub fn spin(&self, time: f64) -> DVec3 {
        match &self.motion {
            SphereMotion::Still | SphereMotion::Swing { .. } => DVec3::ZERO,
            SphereMotion::Keys(keys) => keys.velocity(time).1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Sphere, SphereMotion};
    use crate::{RigidKey, RigidMotion};
    use glam::{DQuat, DVec3, dvec3};

    #[test]
    fn every_motion_has_its_derivative() {
        let key = |time, x, angle| RigidKey {
            time,
            translation: dvec3(x, 0.5, 0.0),
            rotation: DQuat::from_rotation_z(angle),
        };
        let keys = RigidMotion { keys: vec![key(0.0, 0.0, 0.0), key(2.0, 1.0, -3.0)] };
        for motion in [
            SphereMotion::Still,
            SphereMotion::Swing { amplitude: dvec3(0.3, -0.1, 0.0), period: 1.3 },
            SphereMotion::Keys(keys),
        ] {
            let turns = matches!(motion, SphereMotion::Keys(_));
            let sphere = Sphere { centre: dvec3(1.0, 2.0, 3.0), radius: 0.1, motion };
            let step = 1e-6;
            let [(before, _), (_, velocity), (after, _)] = [0.7 - step, 0.7, 0.7 + step].map(|time| sphere.at(time));
            assert!(((after - before) / (2.0 * step)).distance(velocity) < 1e-7, "{sphere:?}");
            let spin = if turns { dvec3(0.0, 0.0, -1.5) } else { DVec3::ZERO };
            assert!(sphere.spin(0.7).distance(spin) < 1e-12);
        }
    }
}
