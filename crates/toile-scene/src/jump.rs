//! Jumps: a body that is set elsewhere at once, as where a film cuts or a game sets its hero at the next door.

use crate::{Motion, MovingMesh, Rig};
use glam::{DMat4, DQuat, DVec3};
use std::f64::consts::TAU;

/// No body goes faster for so short a time [m/s]: the fastest person runs 12.4 m/s.
const SPEED: f64 = 13.0;

/// No body turns faster [rad/s]: skaters reach six turns in a second.
const TURN_RATE: f64 = 7.0 * TAU;

/// What lasts longer is a motion, however fast [s]. Clips have their keys at least ten times in a second.
const SECONDS_MAX: f64 = 0.1;

/// A motion is looked at in parts of at least that length, however short the time that is asked for [s].
const PART_MIN: f64 = 1e-3;

/// What goes less far in all is left to the cloth, which follows it by itself [m].
const DISTANCE_MIN: f64 = 0.5;

/// What turns less in all is left to the cloth, too [rad].
const ANGLE_MIN: f64 = 1.0;

/// The joint that leads a body has at least this share in its vertices [1]: what drags along a vertex or two leads nothing.
const SHARE_MIN: f64 = 0.01;

/// The joint that leads a body: of those that have a share of at least a hundredth in its vertices the one nearest to the root of the
/// skeleton, as a rule the pelvis.
#[derive(Clone, Debug)]
pub struct Lead {
    rig: Rig,
    joint: usize,
}

/// How a body is set elsewhere from one time to another: a point x of it goes to rotation·x + translation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Jump {
    /// Of unit length.
    pub rotation: DQuat,
    /// Translation [m].
    pub translation: DVec3,
    /// How far the leading joint goes [m].
    pub distance: f64,
    /// How far it turns [rad].
    pub angle: f64,
}

impl MovingMesh {
    /// The joint that leads the body; `None` for a sequence, and where no joint has so large a share.
    pub fn lead(&self) -> Option<Lead> {
        let Motion::Skinned { skin, rig } = &self.motion else { return None };
        let mut shares = vec![0.0; rig.joints().len()];
        for influence in &skin.influences {
            shares[influence.joint as usize] += f64::from(influence.weight);
        }
        let least = SHARE_MIN * skin.positions.len() as f64;
        let joints = (0..shares.len()).filter(|joint| shares[*joint] >= least && shares[*joint] > 0.0);
        let joint = joints.min_by_key(|joint| rig.depth(*joint))?;
        Some(Lead { rig: rig.clone(), joint })
    }
}

impl Lead {
    /// The jump of the body from one time to a later one [s]; `None` while it moves as bodies do. It jumps when its leading joint goes faster
    /// than 13 m/s or turns faster than seven times in a second, for at most 0.1 s around these times, and by more than 0.5 m or 1 rad in
    /// all.
    pub fn jump(&self, from: f64, to: f64) -> Option<Jump> {
        let seconds = to - from;
        // Who goes back in time, as a host that poses a body anew does, tells of no motion.
        let jump = self.fast(from, seconds).filter(|_| seconds > 0.0)?;
        let (mut distance, mut angle, mut lasts) = (jump.distance, jump.angle, seconds);
        let part = seconds.max(PART_MIN);
        for (mut start, direction) in [(from - part, -1.0), (to, 1.0)] {
            // A part of a motion is none that lasts too long; so this ends.
            while let Some(next) = self.fast(start, part).filter(|_| lasts <= SECONDS_MAX) {
                distance += next.distance;
                angle += next.angle;
                lasts += part;
                start += direction * part;
            }
        }
        (lasts <= SECONDS_MAX.max(seconds) && (distance > DISTANCE_MIN || angle > ANGLE_MIN)).then_some(jump)
    }

    /// How the body goes on in some seconds, where that is faster than bodies do.
    fn fast(&self, start: f64, seconds: f64) -> Option<Jump> {
        let [(from, before), (to, after)] = [start, start + seconds].map(|time| self.place(time));
        let rotation = after * before.conjugate();
        let (distance, angle) = (from.distance(to), 2.0 * rotation.w.abs().min(1.0).acos());
        let fast = distance > SPEED * seconds || angle > TURN_RATE * seconds;
        fast.then(|| Jump { rotation, translation: to - rotation * from, distance, angle })
    }

    /// Where the joint stands [m], and how.
    fn place(&self, time: f64) -> (DVec3, DQuat) {
        let (_, rotation, place) = self.rig.joint_place(self.joint, time).to_scale_rotation_translation();
        (place, rotation.normalize())
    }
}

impl Jump {
    /// The transform as a matrix.
    pub fn matrix(&self) -> DMat4 {
        DMat4::from_rotation_translation(self.rotation, self.translation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mesh, RigidKey};
    use glam::Vec3;

    /// A ball that goes along x by keys of time [s], place [m] and turn about y [rad].
    fn ball(keys: &[(f64, f64, f64)]) -> Lead {
        let key = |&(time, x, angle): &(f64, f64, f64)| RigidKey {
            time,
            translation: DVec3::X * x,
            rotation: DQuat::from_rotation_y(angle),
        };
        let mesh = Mesh::sphere(Vec3::ZERO, 0.25, 8);
        MovingMesh::rigid(mesh, keys.iter().map(key).collect()).lead().expect("a ball has one joint")
    }

    /// Jumps of the first second, in steps of 1/60 s.
    fn jumps(lead: &Lead) -> Vec<(u32, Jump)> {
        let jump = |k: u32| Some((k, lead.jump(f64::from(k) / 60.0, f64::from(k + 1) / 60.0)?));
        (0..60).filter_map(jump).collect()
    }

    #[test]
    fn a_jump_is_what_no_body_does_and_the_cloth_would_not_follow() {
        let at_once = |x, angle| jumps(&ball(&[(0.0, 0.0, 0.0), (0.51, 0.0, 0.0), (0.51, x, angle), (1.0, x, angle)]));
        let [(at, jump)] = at_once(2.0, 0.0)[..] else { panic!("one jump") };
        assert_eq!(at, 30);
        assert!((jump.distance - 2.0).abs() < 1e-12 && jump.angle < 1e-6, "{jump:?}");
        assert!(jump.matrix().transform_point3(DVec3::Y).distance(DVec3::new(2.0, 1.0, 0.0)) < 1e-12);
        let [(_, turn)] = at_once(0.0, 3.0)[..] else { panic!("one jump") };
        assert!((turn.angle - 3.0).abs() < 1e-6 && turn.distance < 1e-12, "{turn:?}");
        assert_eq!(at_once(0.3, 0.0), [], "the cloth follows");
        assert_eq!(at_once(0.0, 0.8), [], "the cloth follows");
    }

    #[test]
    fn a_jump_between_two_keys_is_carried_part_by_part() {
        for rate in [24.0, 30.0] {
            let way = 0.51 + 1.0 / rate;
            let parts = jumps(&ball(&[(0.0, 0.0, 0.0), (0.51, 0.0, 0.0), (way, 2.0, 3.0), (1.0, 2.0, 3.0)]));
            let carried: f64 = parts.iter().map(|(_, jump)| jump.distance).sum();
            // What is left of a part is slower than 13 m/s over 1/60 s, at both ends.
            assert!(parts.len() >= 2 && carried > 2.0 - 2.0 * 13.0 / 60.0, "{rate}: {parts:?}");
        }
    }

    #[test]
    fn what_moves_as_bodies_do_never_jumps() {
        assert_eq!(jumps(&ball(&[(0.0, 0.0, 0.0), (1.0, 12.0, 2.0)])), [], "a sprinter");
        let turns: Vec<_> = (0..=24).map(|k| (f64::from(k) / 24.0, 0.0, 1.5 * f64::from(k))).collect();
        assert_eq!(jumps(&ball(&turns)), [], "nearly six turns in a second");
        assert_eq!(jumps(&ball(&[(0.0, 0.0, 0.0), (1.0, 40.0, 0.0)])), [], "who flies does so for long");
        let still = Lead { rig: Rig::rigid(Vec::new()), joint: 0 };
        assert_eq!(jumps(&still), []);
    }

    #[test]
    fn who_goes_back_in_time_or_hardly_on_is_answered_too() {
        let lead = ball(&[(0.0, 0.0, 0.0), (0.51, 0.0, 0.0), (0.51, 2.0, 0.0), (1.0, 2.0, 0.0)]);
        assert_eq!(lead.jump(0.9, 0.1), None);
        assert_eq!(lead.jump(0.2, 0.2), None);
        assert_eq!(lead.jump(0.2, 0.2 + 1e-12), None);
        let jump = lead.jump(0.51 - 1e-9, 0.51 + 1e-9).expect("it jumps between the two");
        assert!((jump.distance - 2.0).abs() < 1e-12, "{jump:?}");
    }
}
