//! Points against the layered maps of bodies at rest. D §8, W §7.

use super::layer_planes::look_at_layers;
use crate::maps::LayerMaps;
use crate::{Lag, Probe};
use glam::Vec3;
use toile_model::StepSettings;

/// The surface at rest that each point meets in the coming move, or none. All arrays have the shape [point_count].
pub fn sample_layers(positions: &[Vec3], velocities: &[Vec3], maps: &LayerMaps, settings: &StepSettings) -> Vec<Probe> {
    look_at_layers(positions, velocities, maps, Lag::default(), settings)
}
