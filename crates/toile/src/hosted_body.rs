//! The body of an outfit that the host skins: only the device knows where it is, and tells a call later.

use crate::boxes::Boxes;
use toile_gpu::MovingBody;
use toile_model::MapBox;
use toile_scene::{Motion, MovingMesh};

/// Where a body is that the host skins, as far as it has been seen.
#[derive(Debug)]
pub(crate) struct HostedBody {
    /// Which of the bodies that move it is.
    pub(crate) index: usize,
    /// The maps' box and the time [s] when the device was asked; `None` where the answer no longer counts.
    asked: Option<(MapBox, f64)>,
    /// How far it was outside of its maps when it was seen last [m]; 0 inside, and once it was told.
    outside: f32,
}

impl HostedBody {
    /// The one among bodies that move, if there is one.
    pub(crate) fn among(bodies: &[MovingMesh]) -> Option<Self> {
        let index = bodies.iter().position(|body| matches!(body.motion, Motion::Hosted))?;
        Some(Self { index, asked: None, outside: 0.0 })
    }

    /// Asks the device where it is at a time [s], within the maps as they stand.
    pub(crate) fn ask(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        moving: &[MovingBody],
        shown: Option<MapBox>,
        time: f64,
    ) {
        if moving[self.index].record_bounds(encoder) {
            self.asked = shown.map(|shown| (shown, time));
        }
    }

    /// What the device was asked no longer counts: the body or its maps were set elsewhere.
    pub(crate) fn forget(&mut self) {
        self.asked = None;
    }

    /// Has the maps follow it, where the device has answered.
    pub(crate) fn follow(&mut self, moving: &mut [MovingBody], boxes: &mut Boxes) {
        // What has arrived is taken even where it no longer counts: only then can the device be asked anew.
        let Some(bounds) = moving[self.index].take_bounds() else { return };
        let Some((map_box, time)) = self.asked.take() else { return };
        let short = (map_box.corner() - bounds[0]).max(bounds[1] - map_box.far_corner());
        self.outside = short.max_element().max(0.0);
        boxes.follow(bounds, time);
    }

    /// How far it was outside of its maps when it was seen last [m], told once; `None` where it was inside.
    pub(crate) fn take_outside(&mut self) -> Option<f32> {
        let outside = std::mem::take(&mut self.outside);
        (outside > 0.0).then_some(outside)
    }
}
