//! Joints and how they move.

use crate::Pose;

/// Joints and how they move.
#[derive(Clone, Debug)]
pub struct Rig {}

impl Rig {
    /// Where the joints stand at a time [s].
    pub fn pose(&self, _time: f64) -> Pose {
        Pose::default()
    }
}
