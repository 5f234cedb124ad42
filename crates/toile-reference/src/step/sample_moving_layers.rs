//! Points against the layered maps of moving bodies. D §8, W §4.3 and §7.

use super::layer_planes::look_at_layers;
use crate::maps::LayerMaps;
use crate::{Lag, Probe};
use glam::Vec3;
use toile_model::StepSettings;

/// The moving surface that each point meets in the coming move, or none, in a step that begins and ends `lag` before the time of
/// the maps. All arrays have the shape [point_count].
pub fn sample_moving_layers(
    positions: &[Vec3],
    velocities: &[Vec3],
    maps: &LayerMaps,
    lag: Lag,
    settings: &StepSettings,
) -> Vec<Probe> {
    look_at_layers(positions, velocities, maps, lag, settings)
}
