//! Garments that walk together on a moving body.

use crate::{Cloth, Colliders, Error};
use glam::Vec3;
use std::sync::Arc;
use toile_gpu::{BodyMaps, MovingBody, Surface, Trail};
use toile_model::{MapBox, Model, StepSettings};
use toile_scene::MovingMesh;

/// Bounds of a body are looked up in a table of so many per second [1/s].
const BOUNDS_RATE: f64 = 60.0;
/// What the table adds on every side [m]: a body goes no farther between two of its times, and inner garments hang out of it.
const BOUNDS_MARGIN: f32 = 0.03;
/// What is added around a body for the garments that lie under another one [m].
const GARMENT_MARGIN: f32 = 0.25;

/// Where the maps of a moving body stand: as large as the body ever needs, around where it is.
#[derive(Clone, Debug)]
pub struct MovingFrame {
    bounds: Vec<[Vec3; 2]>,
    /// Length of a round [s], for a motion that repeats.
    round: Option<f64>,
    margin: f32,
    texel: f32,
    size: [u32; 2],
}

impl MovingFrame {
    /// The frames of a body with texels of the edge length `texel` [m], and `thickness` of cloth around it [m]; `layered` when
    /// garments show in the maps too.
    ///
    /// # Errors
    /// [`Error::Body`] when a position of the body is not finite at some time.
    pub fn new(body: &MovingMesh, texel: f32, thickness: f32, layered: bool) -> Result<Self, Error> {
        let count = (body.duration() * BOUNDS_RATE).ceil() as u32 + 1;
        let bounds_at = |index| {
            let time = f64::from(index) / BOUNDS_RATE;
            let posed = body.at(time);
            // Bounds alone do not tell: they pass over what is no number.
            let finite = posed.positions.iter().all(|position| position.is_finite());
            if finite { Ok(posed.bounds().unwrap_or_default()) } else { Err(Error::Body { time }) }
        };
        let bounds = (0..count).map(bounds_at).collect::<Result<_, _>>()?;
        let margin = thickness + BOUNDS_MARGIN + if layered { GARMENT_MARGIN } else { 0.0 };
        let mut frame = Self { bounds, round: body.is_closed().then(|| body.duration()), margin, texel, size: [0; 2] };
        let sizes = (0..count as usize).map(|index| {
            let [low, high] = frame.between(index);
            high - low
        });
        let largest = sizes.fold(Vec3::ZERO, Vec3::max);
        frame.size = MapBox::size_for(largest, texel);
        Ok(frame)
    }

    /// The frame at a time [s].
    pub fn at(&self, time: f64) -> MapBox {
        let time = self.round.map_or(time, |round| time.rem_euclid(round)).max(0.0);
        // A time of the table stays one whatever the rounding: frames of the same pose are then the same.
        MapBox::moving(self.between((time * BOUNDS_RATE + 1e-4) as usize), self.texel, self.size)
    }

    /// The box around the body from one time of the table to the next.
    fn between(&self, index: usize) -> [Vec3; 2] {
        let [a, b] =
            [self.bounds[index.min(self.bounds.len() - 1)], self.bounds[(index + 1).min(self.bounds.len() - 1)]];
        [a[0].min(b[0]) - self.margin, a[1].max(b[1]) + self.margin]
    }
}

/// Garments that walk together on a moving body: each collides with the body and with the garments under it.
#[derive(Debug)]
pub struct Outfit {
    body: MovingBody,
    frame: MovingFrame,
    thickness: f32,
    maps_per_frame: u32,
    time: f64,
    /// Where the maps stand.
    shown: MapBox,
    garments: Vec<Garment>,
    kept: Option<KeptMaps>,
}

/// The maps of a body over one round of its motion.
#[derive(Debug)]
struct KeptMaps {
    /// Time from one to the next [s].
    interval: f64,
    /// The first shows the body one interval after the start, the last at the end.
    maps: Vec<(BodyMaps, MapBox)>,
}

#[derive(Debug)]
struct Garment {
    cloth: Cloth,
    maps: Arc<BodyMaps>,
    /// What the maps of the next garment draw of this one; the outermost has none.
    seen: Option<Seen>,
}

/// A garment as the one over it sees it.
#[derive(Debug)]
struct Seen {
    surface: Surface,
    trail: Trail,
}

impl Outfit {
    /// An outfit at the first pose of a body, whose garments begin at rest where their models have them; to begin elsewhere,
    /// write into the buffers of [`Outfit::garments`]. Garments come from the inside out, and all have the same settings of
    /// frame, step and thickness. The maps are drawn `maps_per_frame` times in each frame.
    ///
    /// # Errors
    /// [`Error::Gpu`] when body, maps or a garment do not fit the device, [`Error::Body`] when the body is not finite at some time.
    ///
    /// # Panics
    /// When the steps of a frame are not a multiple of `maps_per_frame`, and as [`Cloth::new`].
    pub fn new(
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        body: &MovingMesh,
        garments: &[(&Model, StepSettings)],
        texel: f32,
        maps_per_frame: u32,
    ) -> Result<Self, Error> {
        let thickness = garments.iter().map(|(_, settings)| settings.thickness).fold(0.0, f32::max);
        let frame = MovingFrame::new(body, texel, thickness, garments.len() > 1)?;
        let shown = frame.at(0.0);
        let mut moving = MovingBody::new(device, body)?;
        moving.record_pose(device, encoder, 0.0);
        let outermost = garments.len().saturating_sub(1);
        let mut dressed: Vec<Garment> = Vec::new();
        for (model, settings) in garments {
            let steps = settings.steps_per_frame;
            assert!(maps_per_frame > 0 && steps % maps_per_frame == 0, "{steps} steps, {maps_per_frame} maps");
            let maps = Arc::new(match dressed.last() {
                None => BodyMaps::new(device, shown, true)?,
                Some(inner) => inner.maps.new_alike(device),
            });
            let colliders = Colliders { maps: Some(maps.clone()), sphere: None };
            let cloth = match dressed.last() {
                None => Cloth::new(device, model, settings, colliders)?,
                Some(inner) => inner.cloth.new_alike(device, model, settings, colliders)?,
            };
            let drawn = cloth.frame();
            let seen = (dressed.len() < outermost).then(|| {
                let trail = Trail::new(device, &drawn.positions, drawn.particle_count);
                let surface = Surface { velocities: Some(trail.velocities().clone()), ..Surface::from(drawn) };
                Seen { surface, trail }
            });
            dressed.push(Garment { cloth, maps, seen });
        }
        Ok(Self { body: moving, frame, thickness, maps_per_frame, time: 0.0, shown, garments: dressed, kept: None })
    }

    /// Draws the maps of a whole round of the body now and keeps them, one every `interval` seconds: frames then copy them instead
    /// of posing and drawing the body. Gives the bytes that they take. D §7, W §6.
    ///
    /// # Panics
    /// When the outfit has no garment, or the motion is not closed or not a whole number of intervals long; see [`Outfit::can_keep_maps`].
    pub fn keep_maps(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        body: &MovingMesh,
        interval: f64,
    ) -> u64 {
        let count = Self::can_keep_maps(body, interval).expect("a closed motion of a whole number of intervals");
        let first = self.garments.first().expect("an outfit has a garment").maps.clone();
        self.body.record_pose(device, encoder, 0.0);
        let mut maps = Vec::with_capacity(count as usize);
        for index in 1..=count {
            let time = f64::from(index) * interval;
            self.body.record_pose(device, encoder, time);
            let frame = self.frame.at(time);
            let drawn = first.new_alike(device);
            drawn.record(device, encoder, frame, &[(self.body.surface(), self.thickness)]);
            maps.push((drawn, frame));
        }
        let bytes = maps.iter().map(|(maps, _)| maps.bytes()).sum();
        self.kept = Some(KeptMaps { interval, maps });
        bytes
    }

    /// How many maps a round of a body has, one every `interval` seconds; `None` when its motion is not closed or not a whole
    /// number of intervals long.
    pub fn can_keep_maps(body: &MovingMesh, interval: f64) -> Option<u32> {
        let count = body.duration() / interval;
        (body.is_closed() && (count - count.round()).abs() < 1e-3 && count >= 1.0).then(|| count.round() as u32)
    }

    /// Goes to a time without simulating: the body takes the pose of then [s].
    pub fn record_start(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, time: f64) {
        self.body.record_pose(device, encoder, time);
        self.time = time;
    }

    /// Records one frame of `seconds`: the body moves on, and every garment after it.
    pub fn record(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, seconds: f64) {
        let interval = seconds / f64::from(self.maps_per_frame);
        let start = self.time;
        for index in 0..self.maps_per_frame {
            self.record_pose(device, encoder, start + interval * f64::from(index + 1));
            self.record_steps(device, encoder, interval);
        }
        self.record_outputs(encoder);
    }

    /// Records the next pose of the body [s], and what the innermost garment sees of it.
    pub fn record_pose(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, time: f64) {
        self.time = time;
        if let Some(kept) = &self.kept {
            let index = (time / kept.interval).round() as usize + kept.maps.len() - 1;
            let (maps, frame) = &kept.maps[index % kept.maps.len()];
            self.shown = *frame;
            if let Some(innermost) = self.garments.first() {
                innermost.maps.record_copy(device, encoder, maps, *frame);
            }
            return;
        }
        self.body.record_pose(device, encoder, time);
        self.shown = self.frame.at(time);
        if let Some(innermost) = self.garments.first() {
            innermost.maps.record(device, encoder, self.shown, &[(self.body.surface(), self.thickness)]);
        }
    }

    /// Records the steps of all garments up to the pose of the body, which it took `interval` after the pose before [s].
    pub fn record_steps(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, interval: f64) {
        for index in 0..self.garments.len() {
            let (inner, outer) = self.garments.split_at_mut(index);
            let garment = &mut outer[0];
            if let Some(Garment { maps, seen: Some(seen), .. }) = inner.last() {
                // What the garment below sees, and that garment, which has gone to the same time already.
                garment.maps.record_copy(device, encoder, maps, self.shown);
                garment.maps.record_over(device, encoder, &[(&seen.surface, self.thickness)]);
            }
            let steps = garment.cloth.settings().steps_per_frame / self.maps_per_frame;
            let trail = garment.seen.as_ref().map(|seen| &seen.trail);
            if let Some(trail) = trail {
                trail.record_leaving(encoder);
            }
            garment.cloth.record_steps(device, encoder, steps);
            if let Some(trail) = trail {
                // The garment over this one sees it as it is now.
                trail.record_arrival(device, encoder, interval);
                garment.cloth.record_normals(encoder);
            }
        }
    }

    /// Records normals and status of all garments.
    pub fn record_outputs(&mut self, encoder: &mut wgpu::CommandEncoder) {
        for garment in &mut self.garments {
            garment.cloth.record_outputs(encoder);
        }
    }

    /// The garments, from the inside out.
    pub fn garments(&self) -> impl ExactSizeIterator<Item = &Cloth> {
        self.garments.iter().map(|garment| &garment.cloth)
    }

    /// The garments, from the inside out.
    pub fn garments_mut(&mut self) -> impl ExactSizeIterator<Item = &mut Cloth> {
        self.garments.iter_mut().map(|garment| &mut garment.cloth)
    }

    /// The body on the device, as the maps draw it.
    pub fn body(&self) -> &Surface {
        self.body.surface()
    }

    /// The maps that a garment collides with, from the inside out.
    pub fn maps(&self) -> impl ExactSizeIterator<Item = &BodyMaps> {
        self.garments.iter().map(|garment| garment.maps.as_ref())
    }

    /// Time in the motion of the body [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Bytes on the device.
    pub fn bytes(&self) -> u64 {
        let trails = |garment: &Garment| garment.seen.as_ref().map_or(0, |seen| seen.trail.bytes());
        let garments = self.garments.iter().map(|garment| garment.cloth.bytes() + trails(garment));
        let kept = self.kept.iter().flat_map(|kept| &kept.maps).map(|(maps, _)| maps.bytes());
        self.body.bytes() + garments.sum::<u64>() + kept.sum::<u64>()
    }
}
