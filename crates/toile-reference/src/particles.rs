//! The state that a step changes, and what it is measured against.

use glam::Vec3;
use toile_model::{Model, NO_CORNER};

/// The state of all particles, with the masses that a step reads. Every array has the shape [particle_count].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Particles {
    /// Positions [m].
    pub positions: Vec<Vec3>,
    /// Velocities [m/s].
    pub velocities: Vec<Vec3>,
    /// Masses [kg], positive also for pinned particles.
    pub masses: Vec<f32>,
    /// Inverse masses [1/kg], 0 for pinned particles.
    pub inverse_masses: Vec<f32>,
}

impl Particles {
    /// The particles of a model at time 0, at rest.
    pub fn new(model: &Model) -> Self {
        Self {
            positions: model.positions.clone(),
            velocities: vec![Vec3::ZERO; model.positions.len()],
            masses: model.masses.clone(),
            inverse_masses: model.inverse_masses.clone(),
        }
    }
}

/// The nodes of all levels in a sweep: particles, then coarse particles. The arrays have the shape [node_count].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nodes {
    /// Where they would be after the coming move [m].
    pub places: Vec<Vec3>,
    /// How far limits have moved those places [m].
    pub shifts: Vec<Vec3>,
    /// Inverse masses [1/kg]; 0 where a pin is.
    pub inverse_masses: Vec<f32>,
}

impl Nodes {
    /// So many, nowhere yet.
    pub fn new(count: usize) -> Self {
        Self { places: vec![Vec3::ZERO; count], shifts: vec![Vec3::ZERO; count], inverse_masses: vec![0.0; count] }
    }

    /// Where one is now [m].
    pub(crate) fn place(&self, index: usize) -> Vec3 {
        self.places[index] + self.shifts[index]
    }
}

/// Means of the corners of each quad or triangle; both arrays have the shape [quad_count].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Midpoints {
    /// Positions [m].
    pub positions: Vec<Vec3>,
    /// Velocities [m/s].
    pub velocities: Vec<Vec3>,
}

/// How long before the time of the maps a step begins and ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lag {
    /// From the start of the step [s].
    pub start: f32,
    /// From its end [s].
    pub end: f32,
}

impl Lag {
    /// That of step `index` of `count` steps at whose end the maps show the bodies.
    pub fn of(index: u32, count: u32, dt: f32) -> Self {
        Self { start: (count - index) as f32 * dt, end: (count - index - 1) as f32 * dt }
    }
}

/// Twice the area vector of a quad or triangle [m²], out of the cloth.
pub(crate) fn doubled_area(positions: &[Vec3], [a, b, c, d]: [u32; 4]) -> Vec3 {
    let corner = |index: u32| positions[index as usize];
    if d == NO_CORNER {
        (corner(b) - corner(a)).cross(corner(c) - corner(a))
    } else {
        (corner(c) - corner(a)).cross(corner(d) - corner(b))
    }
}
