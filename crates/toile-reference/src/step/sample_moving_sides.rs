//! Points against the maps of moving bodies. W §4.3 and §4.4.

use super::side_planes::look_at_sides;
use crate::maps::SideMaps;
use crate::{Lag, Probe};
use glam::Vec3;
use toile_model::StepSettings;

/// The moving surface that each point meets in the coming move, or none, in a step that begins and ends `lag` before the time of
/// the maps. All arrays have the shape [point_count].
pub fn sample_moving_sides(
    positions: &[Vec3],
    velocities: &[Vec3],
    maps: &SideMaps,
    lag: Lag,
    settings: &StepSettings,
) -> Vec<Probe> {
    look_at_sides(positions, velocities, maps, lag, settings)
}
