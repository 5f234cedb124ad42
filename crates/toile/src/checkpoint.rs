//! A state on the device that a simulation goes back to.

use crate::clock::Clock;
use crate::control::Control;
use crate::pins::Pins;
use toile_gpu::Mark;

/// The state of a run on the device, to which [`Simulation::reset`](crate::Simulation::reset) goes back. It takes as many bytes as positions, velocities and contacts of all
/// cloths; to keep one in a file there is [`Simulation::save`](crate::Simulation::save).
#[derive(Debug)]
pub struct Checkpoint {
    pub(crate) marks: Vec<Mark>,
    pub(crate) clock: Clock,
    pub(crate) done: u64,
    pub(crate) place: glam::DVec3,
    /// The middle of a body that the host skins.
    pub(crate) middle: Option<glam::Vec3>,
    pub(crate) teleport_count: usize,
    pub(crate) control: Control,
    pub(crate) pins: Vec<Pins>,
}
