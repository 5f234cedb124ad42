//! A clip: keys over time that move nodes and mix morph targets.

use glam::{DQuat, DVec3, DVec4};
use std::ops::{Add, Mul};

/// Keys over time that move nodes and mix morph targets.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Name; empty where the file gives none.
    pub name: String,
    /// Time of the last key [s].
    pub duration: f64,
    /// What moves. Of two channels that move the same thing the later one counts.
    pub channels: Vec<Channel>,
}

/// The keys of one thing that moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Channel {
    /// Translation of a node relative to its parent.
    Translation {
        /// Index of the node, whose transform has parts.
        node: usize,
        /// In the unit of the rig.
        keys: Keys<DVec3>,
    },
    /// Rotation of a node relative to its parent.
    Rotation {
        /// Index of the node, whose transform has parts.
        node: usize,
        /// Need not be of unit length.
        keys: Keys<DQuat>,
    },
    /// Scale of a node along its own axes.
    Scale {
        /// Index of the node, whose transform has parts.
        node: usize,
        /// Factors [1].
        keys: Keys<DVec3>,
    },
    /// Weight of a morph target.
    MorphWeight {
        /// Index into [`Pose::morph_weights`](crate::Pose::morph_weights).
        target: usize,
        /// Weights [1].
        keys: Keys<f64>,
    },
}

/// Values at times. Before the first and after the last key they stand still.
#[derive(Clone, Debug, PartialEq)]
pub struct Keys<T> {
    /// How values between keys follow.
    pub interpolation: Interpolation,
    /// Times [s], not falling, at least one.
    pub times: Vec<f64>,
    /// One value per key, or three for a cubic spline: change per second [1/s] at arrival, value, change per second at leaving.
    pub values: Vec<T>,
}

/// How values between keys follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The last key's value.
    Step,
    /// Straight; rotations take the shorter way at even speed.
    Linear,
    /// The cubic with the values and the changes per second of both keys.
    CubicSpline,
}

/// A value between two keys of linear interpolation.
pub(crate) trait Between {
    /// The value at a share of the way, 0 to 1.
    fn between(self, next: Self, share: f64) -> Self;
}

impl Between for f64 {
    fn between(self, next: Self, share: f64) -> Self {
        self + (next - self) * share
    }
}

impl Between for DVec3 {
    fn between(self, next: Self, share: f64) -> Self {
        self.lerp(next, share)
    }
}

impl Between for DQuat {
    fn between(self, next: Self, share: f64) -> Self {
        unit(self).slerp(unit(next), share)
    }
}

/// The rotation that a quaternion of any length stands for; a zero quaternion would turn into NaN, and stands for none.
pub(crate) fn unit(rotation: DQuat) -> DQuat {
    DQuat::from_vec4(DVec4::from(rotation).normalize_or(DVec4::W))
}

/// Where a time lies among rising times: at or outside of a key, or between two, with the share of the way.
pub(crate) enum Moment {
    At(usize),
    Between { last: usize, span: f64, share: f64 },
}

impl Moment {
    /// Of a time among at least one.
    pub fn of(times: impl Fn(usize) -> f64, count: usize, time: f64) -> Self {
        let (mut low, mut high) = (0, count);
        while low < high {
            let middle = low.midpoint(high);
            if times(middle) <= time { low = middle + 1 } else { high = middle }
        }
        match low {
            0 => Self::At(0),
            next if next == count => Self::At(count - 1),
            next => {
                let (start, span) = (times(next - 1), times(next) - times(next - 1));
                Self::Between { last: next - 1, span, share: (time - start) / span }
            }
        }
    }
}

impl<T: Copy> Keys<T> {
    /// The value at a time [s].
    pub(crate) fn at(&self, time: f64) -> T
    where
        T: Between + Add<Output = T> + Mul<f64, Output = T>,
    {
        let cubic = self.interpolation == Interpolation::CubicSpline;
        let value = |key: usize| self.values[if cubic { 3 * key + 1 } else { key }];
        let (last, span, t) = match Moment::of(|key| self.times[key], self.times.len(), time) {
            Moment::At(key) => return value(key),
            Moment::Between { last, span, share } => (last, span, share),
        };
        match self.interpolation {
            Interpolation::Step => value(last),
            Interpolation::Linear => value(last).between(value(last + 1), t),
            Interpolation::CubicSpline => {
                let (leaving, arriving) = (self.values[3 * last + 2], self.values[3 * last + 3]);
                let (t2, t3) = (t * t, t * t * t);
                value(last) * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + leaving * (span * (t3 - 2.0 * t2 + t))
                    + value(last + 1) * (3.0 * t2 - 2.0 * t3)
                    + arriving * (span * (t3 - t2))
            }
        }
    }
}

impl<T> Keys<T> {
    /// Whether there is a key, the times do not fall, and the values fit them.
    pub fn is_valid(&self) -> bool {
        let per_key = if self.interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        !self.times.is_empty() && self.times.is_sorted() && self.values.len() == per_key * self.times.len()
    }
}

#[cfg(test)]
mod tests {
    use super::{Interpolation, Keys};
    use glam::DQuat;

    #[test]
    fn keys_are_met_and_hold_outside() {
        for (interpolation, values) in [
            (Interpolation::Step, vec![2.0, 5.0, -1.0]),
            (Interpolation::Linear, vec![2.0, 5.0, -1.0]),
            (Interpolation::CubicSpline, vec![9.0, 2.0, 0.5, 0.0, 5.0, 3.0, -2.0, -1.0, 9.0]),
        ] {
            let keys = Keys { interpolation, times: vec![1.0, 1.5, 4.0], values };
            let met = [0.0, 1.0, 1.5, 4.0, 9.0].map(|time| keys.at(time));
            assert_eq!(met, [2.0, 2.0, 5.0, -1.0, -1.0], "{interpolation:?}");
        }
    }

    #[test]
    fn a_cubic_spline_follows_a_cubic_exactly() {
        // x³ − 2x with its derivative 3x² − 2 at 1 and 3.
        let keys = Keys {
            interpolation: Interpolation::CubicSpline,
            times: vec![1.0, 3.0],
            values: vec![0.0, -1.0, 1.0, 25.0, 21.0, 0.0],
        };
        for time in [1.2, 2.0, 2.9f64] {
            assert!((keys.at(time) - (time.powi(3) - 2.0 * time)).abs() < 1e-13, "{time}");
        }
    }

    #[test]
    fn two_keys_at_one_time_are_a_jump() {
        let keys = Keys {
            interpolation: Interpolation::Linear,
            times: vec![0.0, 1.0, 1.0, 2.0],
            values: vec![0.0, 1.0, 5.0, 6.0],
        };
        assert_eq!([0.5, 1.0, 1.5].map(|time| keys.at(time)), [0.5, 5.0, 5.5]);
    }

    #[test]
    fn rotations_turn_evenly_the_shorter_way() {
        let end = -DQuat::from_rotation_z(1.0) * 3.0;
        let keys =
            Keys { interpolation: Interpolation::Linear, times: vec![0.0, 1.0], values: vec![DQuat::IDENTITY, end] };
        assert!(keys.at(0.25).angle_between(DQuat::from_rotation_z(0.25)) < 1e-7);
    }
}
