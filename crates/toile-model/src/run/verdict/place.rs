//! Where on a garment something is.

use crate::Model;
use crate::mesh::geometry::corners;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Where on a garment something is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Place {
    /// The panel that most of it is on.
    pub panel: String,
    /// The middle of what goes around; of what lies here and there the particle that is nearest to it [m].
    pub position: [f32; 3],
}

/// The panels of a model by particle.
#[derive(Debug)]
pub(crate) struct Panels<'a> {
    names: Vec<&'a str>,
    /// Index of the first panel that a particle is on.
    of_particle: Vec<usize>,
}

impl<'a> Panels<'a> {
    pub(crate) fn of(model: &'a Model) -> Self {
        let mut of_particle = vec![usize::MAX; model.positions.len()];
        for (index, panel) in model.panels.iter().enumerate().rev() {
            let quads = &model.quads[panel.quads.start as usize..panel.quads.end as usize];
            quads.iter().flat_map(corners).for_each(|&particle| of_particle[particle as usize] = index);
        }
        Self { names: model.panels.iter().map(|panel| panel.name.as_str()).collect(), of_particle }
    }

    /// Name of the panel of a particle.
    pub(crate) fn name(&self, particle: u32) -> &'a str {
        self.names.get(self.of_particle[particle as usize]).copied().unwrap_or("")
    }

    /// The panels of particles, each once.
    pub(crate) fn all(&self, particles: &[u32]) -> Vec<String> {
        let mut found: Vec<usize> = particles.iter().map(|&particle| self.of_particle[particle as usize]).collect();
        found.sort_unstable();
        found.dedup();
        found.into_iter().filter_map(|index| self.names.get(index)).map(|name| (*name).to_owned()).collect()
    }

    /// The panels along a loop in one word.
    pub(crate) fn along(&self, particles: &[u32]) -> String {
        let names = self.all(particles);
        match names.as_slice() {
            [one, .., last] if names.len() > 2 => format!("{one} to {last}"),
            names => names.join(" and "),
        }
    }

    /// Where some particles are; `None` without any.
    pub(crate) fn place(&self, particles: &[u32], positions: &[Vec3]) -> Option<Place> {
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for &particle in particles {
            *counts.entry(self.name(particle)).or_default() += 1;
        }
        let (panel, _) = counts.into_iter().max_by_key(|(_, count)| *count)?;
        let sum: Vec3 = particles.iter().map(|&particle| positions[particle as usize]).sum();
        Some(Place { panel: panel.to_owned(), position: (sum / particles.len() as f32).to_array() })
    }

    /// The same of particles that lie here and there, on both hands it may be: their middle alone would be in the air.
    pub(crate) fn place_among(&self, particles: &[u32], positions: &[Vec3]) -> Option<Place> {
        let place = self.place(particles, positions)?;
        let middle = Vec3::from_array(place.position);
        let points = particles.iter().map(|&particle| positions[particle as usize]);
        let nearest =
            points.min_by(|a, b| a.distance_squared(middle).total_cmp(&b.distance_squared(middle))).unwrap_or(middle);
        Some(Place { position: nearest.to_array(), ..place })
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.position;
        write!(f, "panel {} at ({x:.2}, {y:.2}, {z:.2}) m", self.panel)
    }
}

#[cfg(test)]
mod tests {
    use super::Panels;
    use glam::{Vec3, vec3};

    #[test]
    fn what_lies_on_both_hands_is_told_on_one_of_them() {
        let panels = Panels { names: vec!["front"], of_particle: vec![0; 5] };
        let positions =
            [vec3(-0.5, 1.1, 0.2), vec3(-0.46, 1.1, 0.2), vec3(0.47, 1.1, 0.2), vec3(0.5, 1.1, 0.2), Vec3::ZERO];
        let place = panels.place_among(&[0, 1, 2, 3], &positions).expect("a place");
        assert_eq!((place.panel.as_str(), place.position), ("front", positions[1].to_array()));
        assert_eq!(panels.place_among(&[], &positions), None);
    }
}
