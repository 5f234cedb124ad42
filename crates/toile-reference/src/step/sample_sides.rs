//! Points against the maps of bodies at rest. W §4.4.

use super::side_planes::look_at_sides;
use crate::maps::SideMaps;
use crate::{Lag, Probe};
use glam::Vec3;
use toile_model::StepSettings;

/// The surface at rest that each point meets in the coming move, or none. All arrays have the shape [point_count].
pub fn sample_sides(positions: &[Vec3], velocities: &[Vec3], maps: &SideMaps, settings: &StepSettings) -> Vec<Probe> {
    look_at_sides(positions, velocities, maps, Lag::default(), settings)
}
