//! The maps of a body over one round of its motion, drawn once: later they are copied. D §7, W §6.

use crate::Error;
use crate::boxes::Boxes;
use glam::DVec3;
use toile_gpu::{BodyMaps, Kernels, MapSpace, MovingBody};
use toile_model::MapBox;
use toile_scene::MovingMesh;

/// The maps of a body over one round of its motion.
#[derive(Debug)]
pub(crate) struct KeptMaps {
    /// Time from one to the next [s].
    interval: f64,
    /// The first shows the body one interval after the start, the last at the end; with where each stands.
    maps: Vec<(BodyMaps, MapBox)>,
}

impl KeptMaps {
    /// So many, not drawn yet.
    ///
    /// # Errors
    /// [`Error::Gpu`] when they do not fit the device.
    pub(crate) fn new(
        kernels: &Kernels,
        space: &MapSpace,
        boxes: &Boxes,
        count: u32,
        interval: f64,
    ) -> Result<Self, Error> {
        let made =
            |index: u32| Ok((BodyMaps::new(kernels, space)?, boxes.at(f64::from(index) * interval, DVec3::ZERO)));
        Ok(Self { interval, maps: (1..=count).map(made).collect::<Result<_, Error>>()? })
    }

    /// Draws all of them, around a body that is this much thicker [m].
    pub(crate) fn record(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        body: &mut MovingBody,
        thickness: f32,
    ) {
        // Velocities are those since the pose before.
        body.record_pose(device, encoder, 0.0);
        for (index, (maps, map_box)) in (1_u32..).zip(&self.maps) {
            body.record_pose(device, encoder, f64::from(index) * self.interval);
            maps.record(device, encoder, *map_box, &[(body.surface(), thickness)]);
        }
    }

    /// Those that show the body at a time [s] of any round, and where they stand.
    pub(crate) fn at(&self, time: f64) -> (&BodyMaps, MapBox) {
        let index = (time / self.interval).round() as usize + self.maps.len() - 1;
        let (maps, map_box) = &self.maps[index % self.maps.len()];
        (maps, *map_box)
    }

    /// Bytes on the device.
    pub(crate) fn bytes(&self) -> u64 {
        self.maps.iter().map(|(maps, _)| maps.bytes()).sum()
    }
}

/// How many maps a round of a body has, one every `interval` seconds; `None` when its motion is not closed or not a whole number of
/// intervals long.
pub(crate) fn maps_of_round(body: &MovingMesh, interval: f64) -> Option<u32> {
    let count = body.duration() / interval;
    (body.is_closed() && (count - count.round()).abs() < 1e-3 && count >= 1.0).then(|| count.round() as u32)
}
