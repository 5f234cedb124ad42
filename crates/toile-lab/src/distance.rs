//! How far two states of the same cloth are apart.

use glam::DVec3;

/// How far two states of the same cloth are apart [m]. Infinite when either is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// Root of the mean square over the particles.
    pub rms: f64,
    /// The farthest particle.
    pub max: f64,
}

impl Distance {
    /// No answer: a run that diverged.
    pub const INFINITE: Self = Self { rms: f64::INFINITY, max: f64::INFINITY };

    /// Between two states, particle by particle.
    ///
    /// # Panics
    /// When they have different numbers of particles.
    pub fn between(a: &[DVec3], b: &[DVec3]) -> Self {
        assert_eq!(a.len(), b.len(), "states of the same particles");
        let squares: Vec<f64> = a.iter().zip(b).map(|(a, b)| a.distance_squared(*b)).collect();
        if squares.iter().any(|square| !square.is_finite()) {
            return Self::INFINITE;
        }
        let mean = squares.iter().sum::<f64>() / squares.len().max(1) as f64;
        Self { rms: mean.sqrt(), max: squares.iter().copied().fold(0.0, f64::max).sqrt() }
    }

    /// Between the particles of a square sheet of `coarse_n` × `coarse_n` particles and those of one of `fine_n` × `fine_n` that stand at the
    /// same places of the cloth.
    ///
    /// # Panics
    /// When `fine_n − 1` is not a multiple of `coarse_n − 1`, or a state has another number of particles.
    pub fn between_meshes(coarse: &[DVec3], coarse_n: u32, fine: &[DVec3], fine_n: u32) -> Self {
        assert!((fine_n - 1).is_multiple_of(coarse_n - 1), "{fine_n} and {coarse_n} particles share no places");
        let stride = ((fine_n - 1) / (coarse_n - 1)) as usize;
        let [coarse_n, fine_n] = [coarse_n as usize, fine_n as usize];
        let shared: Vec<DVec3> = (0..coarse_n * coarse_n)
            .map(|k| fine[(k / coarse_n) * stride * fine_n + (k % coarse_n) * stride])
            .collect();
        Self::between(coarse, &shared)
    }
}

#[cfg(test)]
mod tests {
    use super::Distance;
    use glam::DVec3;

    #[test]
    fn meshes_are_compared_where_they_share_places() {
        let grid = |n: u32| -> Vec<DVec3> {
            let h = 1.0 / f64::from(n - 1);
            (0..n * n).map(|k| DVec3::new(f64::from(k % n) * h, f64::from(k / n) * h, 0.0)).collect()
        };
        let mut coarse = grid(3);
        assert!(Distance::between_meshes(&coarse, 3, &grid(9), 9).max < 1e-15);
        coarse[4].z = 0.3;
        let moved = Distance::between_meshes(&coarse, 3, &grid(9), 9);
        assert!((moved.max - 0.3).abs() < 1e-12 && (moved.rms - 0.1).abs() < 1e-12, "{moved:?}");
        coarse[0].x = f64::NAN;
        assert_eq!(Distance::between_meshes(&coarse, 3, &grid(9), 9), Distance::INFINITE);
    }
}
