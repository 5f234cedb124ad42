//! Where on a garment something is.

use crate::Model;
use crate::mesh::geometry::corners;
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Where on a garment something is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// The panel that most of it is on.
    pub panel: String,
    /// The middle of it [m].
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
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [x, y, z] = self.position;
        write!(f, "panel {} at ({x:.2}, {y:.2}, {z:.2}) m", self.panel)
    }
}
