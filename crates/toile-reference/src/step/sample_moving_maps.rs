//! Points against the maps of moving bodies. W §4.3 and §4.4.

use super::map_planes::look_at_maps;
use crate::maps::BodyMaps;
use crate::{Lag, Probe};
use glam::Vec3;
use toile_model::StepSettings;

/// The moving surface that each point meets in the coming move, or none, in a step that begins and ends `lag` before the time of
/// the maps. All arrays have the shape [point_count].
pub fn sample_moving_maps(
    positions: &[Vec3],
    velocities: &[Vec3],
    maps: &BodyMaps,
    lag: Lag,
    settings: &StepSettings,
) -> Vec<Probe> {
    look_at_maps(positions, velocities, maps, lag, settings)
}
