//! How far the seams are open.

use glam::Vec3;
use toile_model::SeamPair;

/// Largest gap of any seam pair [m]; 0 without pairs. `positions` [m] has the shape [particle_count].
pub fn seam_status(positions: &[Vec3], pairs: &[SeamPair]) -> f32 {
    let mut widest = 0.0;
    for pair in pairs {
        let [a, b] = pair.ends.map(|end| positions[end as usize]);
        let gap = (b - a).length();
        if gap > widest {
            widest = gap;
        }
    }
    widest
}
