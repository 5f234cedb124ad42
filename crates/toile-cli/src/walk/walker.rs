//! A garment that goes along.

use toile::Worn;

/// What files and metrics need to know of a garment that goes along.
pub struct Walker {
    /// Its name.
    pub name: String,
    /// Number of particles.
    pub particle_count: u32,
    /// Steps of a frame.
    pub steps_per_frame: u32,
    /// Particle indices of its triangles.
    pub triangles: Vec<[u32; 3]>,
}

impl Walker {
    /// A cloth of the walk.
    pub fn of(worn: Worn<'_>) -> Self {
        Self {
            name: worn.name.to_owned(),
            particle_count: worn.model.particle_count(),
            steps_per_frame: worn.cloth.settings().steps_per_frame,
            triangles: worn.model.triangles(),
        }
    }
}
