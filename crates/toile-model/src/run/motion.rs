//! How cloth moves, as who looks at it sees it.

use glam::Vec3;

/// How cloth moves from frame to frame.
///
/// Cloth that is held between its limits and a body keeps velocities that the next step takes back: it lies still all the same. What moves is told
/// by where particles are, and where they were before.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    step: u64,
    positions: Vec<Vec3>,
    velocities: Vec<Vec3>,
}

impl Motion {
    /// Cloth at a step, of whose motion nothing is known yet. Positions [m], shape [particle_count].
    pub fn begin(step: u64, positions: Vec<Vec3>) -> Self {
        Self { step, positions, velocities: Vec::new() }
    }

    /// Takes where the particles are [m], shape [particle_count], after a later step; steps last `dt` [s].
    pub fn see(&mut self, step: u64, positions: Vec<Vec3>, dt: f32) {
        if step <= self.step || positions.len() != self.positions.len() {
            *self = Self::begin(step, positions);
            return;
        }
        let seconds = (step - self.step) as f32 * dt;
        self.velocities = positions.iter().zip(&self.positions).map(|(now, before)| (now - before) / seconds).collect();
        (self.step, self.positions) = (step, positions);
    }

    /// The step that was seen last.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// Where the particles were then [m], shape [particle_count].
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Mean velocity of each particle between the last two steps that were seen [m/s], shape [particle_count]; empty before.
    pub fn velocities(&self) -> &[Vec3] {
        &self.velocities
    }

    /// Root of the mean square of these velocities [m/s]; `None` before there are any.
    pub fn speed(&self) -> Option<f32> {
        let sum: f32 = self.velocities.iter().map(|velocity| velocity.length_squared()).sum();
        (!self.velocities.is_empty()).then(|| (sum / self.velocities.len() as f32).sqrt())
    }
}
