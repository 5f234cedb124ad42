//! What a simulation is doing.

/// What a simulation is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Stage {
    /// The seams of a garment are being closed, without gravity.
    Sewing,
    /// A garment is sewn and falls without friction to where it stretches least, its labelled edges still held.
    Easing,
    /// A garment comes to rest.
    Draping,
    /// Every garment is at rest, or had its time to come to rest. The next advance goes on to what comes then.
    Dressed,
    /// The body goes over from the pose that its garments were sewn in to the start of its motion, and they along with it.
    Posing,
    /// Everything goes on together: bodies, their maps, garments and sheets.
    Running,
}
