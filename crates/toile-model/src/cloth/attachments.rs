//! Limits of the distance from pins.

use crate::cloth::assemble::{aim, stretched};
use crate::{Arrays, Attachment, Csr};
use glam::DVec2;

/// Most pins, or groups of neighbouring pins, that one particle is attached to.
const ATTACHMENT_COUNT: usize = 4;

impl Arrays {
    /// For each particle of a convex panel the pins that hold it: of each group of neighbouring pins the nearest one, and of the groups
    /// the nearest ones. Kim, Chentanez and Müller, Long Range Attachments, 2012.
    pub(crate) fn attachments(&self, flat: &[DVec2], groups: &[Vec<u32>]) -> Csr<Attachment> {
        let aim = aim(self.rule);
        let rows = flat.iter().zip(&self.inverse_masses).map(|(here, inverse_mass)| {
            let nearest = |group: &Vec<u32>| {
                let distances = group.iter().map(|&pin| (flat[pin as usize].distance(*here), pin));
                distances.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            };
            let mut pins: Vec<(f64, u32)> = groups.iter().filter_map(nearest).collect();
            pins.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let count = if *inverse_mass > 0.0 { pins.len().min(ATTACHMENT_COUNT) } else { 0 };
            pins.truncate(count);
            pins.into_iter().map(move |(distance, pin)| {
                let threshold = self.threshold.along(*here - flat[pin as usize]) as f32;
                Attachment { pin, max_length: stretched(distance as f32, aim * threshold) }
            })
        });
        Csr::from_rows(rows)
    }
}
