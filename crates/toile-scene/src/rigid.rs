//! The motion of a rigid body by keys.

use crate::clip::{Between, Moment};
use glam::{DQuat, DVec3};

/// The motion of a rigid body by keys: straight and turning evenly the shorter way between them, still outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RigidMotion {
    /// Keys at rising times. Without any the body stays where it is.
    pub keys: Vec<RigidKey>,
}

/// Where a rigid body stands at a time: a point x goes to rotation·x + translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidKey {
    /// Time [s].
    pub time: f64,
    /// Translation [m].
    pub translation: DVec3,
    /// Rotation about the origin, of unit length; less than half a turn from key to key.
    pub rotation: DQuat,
}

impl RigidMotion {
    /// Translation [m] and rotation at a time [s].
    pub fn at(&self, time: f64) -> (DVec3, DQuat) {
        match self.moment(time) {
            None => (DVec3::ZERO, DQuat::IDENTITY),
            Some(Moment::At(key)) => (self.keys[key].translation, self.keys[key].rotation),
            Some(Moment::Between { last, share, .. }) => {
                let [a, b] = [&self.keys[last], &self.keys[last + 1]];
                (a.translation.between(b.translation, share), a.rotation.between(b.rotation, share))
            }
        }
    }

    /// Velocity of the translation [m/s] and angular velocity [rad/s] at a time [s]; at a key those that follow it.
    pub fn velocity(&self, time: f64) -> (DVec3, DVec3) {
        let Some(Moment::Between { last, span, .. }) = self.moment(time) else { return (DVec3::ZERO, DVec3::ZERO) };
        let [a, b] = [&self.keys[last], &self.keys[last + 1]];
        let turn = b.rotation * a.rotation.conjugate();
        let turn = if turn.w < 0.0 { -turn } else { turn };
        ((b.translation - a.translation) / span, turn.to_scaled_axis() / span)
    }

    fn moment(&self, time: f64) -> Option<Moment> {
        (!self.keys.is_empty()).then(|| Moment::of(|key| self.keys[key].time, self.keys.len(), time))
    }
}

#[cfg(test)]
mod tests {
    use super::{RigidKey, RigidMotion};
    use glam::{DQuat, DVec3, dvec3};

    fn motion() -> RigidMotion {
        let key = |time, translation, rotation| RigidKey { time, translation, rotation };
        let tilt = DQuat::from_axis_angle(dvec3(1.0, 2.0, -2.0) / 3.0, 2.0);
        let further = DQuat::from_axis_angle(dvec3(0.6, 0.0, 0.8), 1.5) * tilt;
        RigidMotion {
            keys: vec![
                key(1.0, DVec3::ZERO, tilt),
                key(3.0, dvec3(0.4, 0.0, -1.0), -further),
                key(3.5, dvec3(0.4, 1.0, -1.0), further),
            ],
        }
    }

    #[test]
    fn velocities_are_the_derivatives() {
        let motion = motion();
        for time in [1.0, 1.7, 2.9, 3.0, 3.2] {
            let (velocity, spin) = motion.velocity(time);
            let step = 1e-6;
            let ((start, turned), (end, turned_on)) = (motion.at(time), motion.at(time + step));
            assert!(((end - start) / step).distance(velocity) < 1e-8, "{time}");
            let measured = (turned_on * turned.conjugate()).to_scaled_axis() / step;
            assert!(measured.distance(spin) < 1e-5, "{time}: {measured} {spin}");
        }
        assert!((motion.velocity(2.0).1.length() - 0.75).abs() < 1e-12);
        assert_eq!(motion.velocity(3.2).0, dvec3(0.0, 2.0, 0.0));
    }

    #[test]
    fn it_stands_still_outside_of_its_keys() {
        let motion = motion();
        for (time, key) in [(-1.0, 0), (0.9, 0), (3.5, 2), (9.0, 2)] {
            assert_eq!(motion.at(time), (motion.keys[key].translation, motion.keys[key].rotation));
            assert_eq!(motion.velocity(time), (DVec3::ZERO, DVec3::ZERO));
        }
        assert_eq!(RigidMotion::default().at(1.0), (DVec3::ZERO, DQuat::IDENTITY));
    }
}
