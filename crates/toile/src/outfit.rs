//! Cloths that go together on bodies, each over the ones before it.

use crate::boxes::{Boxes, MapPlan};
use crate::hosted_body::HostedBody;
use crate::kept_maps::{KeptMaps, maps_of_round};
use crate::layer::{Layer, Seen, raised};
use crate::pins::Pins;
use crate::{Cloth, Colliders, Error};
use glam::{DMat4, DVec3, Vec3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use toile_gpu::{BodyMaps, HostVertices, Kernels, MapsFault, MovingBody, Raised, Surface, Trail};
use toile_model::{MapBox, Model, StepSettings, raised_ways};
use toile_scene::{Lead, Mesh, MovingMesh, Shape};

/// Maps of moving bodies are drawn so often at least [1/s]; in between, surfaces go straight on by the velocity map.
const MAP_RATE: f64 = 60.0;

/// Parts of a jump that begin within this time of its start are one [s]: as long as a jump may last.
const MERGED_SECONDS: f64 = 0.1;

/// What the cloths of an outfit collide with.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies {
    pub(crate) still: Vec<Mesh>,
    pub(crate) moving: Vec<MovingMesh>,
    pub(crate) shapes: Vec<Shape>,
}

/// A cloth of an outfit before it is on the device.
#[derive(Clone, Debug)]
pub(crate) struct Laid<'a> {
    pub(crate) model: &'a Model,
    pub(crate) step: StepSettings,
    /// Whether a body wears it, and takes it along where it jumps; a sheet only lies there.
    pub(crate) is_worn: bool,
    /// What the host holds of it.
    pub(crate) pins: Pins,
}

/// A body that was set elsewhere at once and took its garments along.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Teleport {
    /// When, in the motion of the body [s]: the last time at which it stood where it was.
    pub time: f64,
    /// How far its leading joint went [m].
    pub distance: f64,
    /// How far it turned [rad].
    pub angle: f64,
}

/// Which part of the work is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// Poses of the bodies and their maps.
    Maps,
    /// Everything else.
    Steps,
}

/// Takes what is to be recorded: into the host's encoder, or, to be timed, into one of its own.
pub(crate) type Recorder<'a> = dyn FnMut(Part, &mut dyn FnMut(&mut wgpu::CommandEncoder)) -> Result<(), Error> + 'a;

/// Cloths that go together on bodies: each collides with the bodies and with the cloths before it.
#[derive(Debug)]
pub(crate) struct Outfit {
    moving: Vec<MovingBody>,
    still: Vec<Surface>,
    /// Where the maps stand while anything in them moves.
    boxes: Option<Boxes>,
    /// Where they stand now; `None` without maps.
    shown: Option<MapBox>,
    thickness: f32,
    /// Simulated time of a frame [s].
    frame_seconds: f64,
    maps_per_frame: u32,
    /// Parts done, see [`Outfit::part_seconds`].
    done: u64,
    /// The interval at whose end the bodies stand; `None` before their first pose.
    posed: Option<u64>,
    /// What leads the body that wears the garments; `None` where nobody does, or more than one.
    lead: Option<Lead>,
    teleports: Vec<Teleport>,
    layers: Vec<Layer>,
    kept: Option<KeptMaps>,
    /// How far bodies that move stand from where their motion has them [m].
    place: DVec3,
    hosted: Option<HostedBody>,
}

/// How often the maps are drawn in a frame of so many steps: at least at the map rate, and so that the steps divide evenly.
pub(crate) fn maps_per_frame(steps: u32, frame_rate: f64) -> u32 {
    let wanted = ((MAP_RATE / frame_rate).ceil() as u32).clamp(1, steps);
    (wanted..=steps).find(|count| steps.is_multiple_of(*count)).unwrap_or(steps)
}

impl Outfit {
    /// Cloths at the start of their models, from the inside out, and the bodies before their first pose.
    ///
    /// # Errors
    /// [`Error::Gpu`] when bodies, maps or a cloth do not fit the device.
    pub(crate) fn new(
        kernels: &Kernels,
        bodies: &Bodies,
        cloths: &[Laid<'_>],
        map_plan: MapPlan,
        frame_rate: f64,
    ) -> Result<Self, Error> {
        let device = kernels.device();
        let thickness = cloths.iter().map(|cloth| cloth.step.thickness).fold(0.0, f32::max);
        let maps_per_frame = cloths.first().map_or(1, |cloth| maps_per_frame(cloth.step.steps_per_frame, frame_rate));
        let space = map_plan.space();
        let texel = space.as_ref().map_or(1.0, |space| space.map_box.texel);
        let moving = bodies.moving.iter().map(|body| MovingBody::new(kernels, body, texel));
        let moving = moving.collect::<Result<Vec<_>, _>>()?;
        let at_rest = |mesh| match map_plan.boxes {
            Some(_) => Surface::at_rest(device, mesh, texel),
            None => Surface::new(device, mesh, texel),
        };
        let still: Vec<Surface> = bodies.still.iter().map(at_rest).collect();
        let has_meshes = !(moving.is_empty() && still.is_empty());
        let outermost = cloths.len().saturating_sub(1);
        let mut layers: Vec<Layer> = Vec::new();
        let ways = raised_ways(&cloths.iter().map(|cloth| cloth.step.thickness).collect::<Vec<_>>());
        for (Laid { model, step, is_worn, pins }, way) in cloths.iter().zip(ways) {
            // Where there is no body to see, the innermost cloth sees nothing.
            let space = space.as_ref().filter(|_| has_meshes || !layers.is_empty());
            let maps = space.map(|space| BodyMaps::new(kernels, space)).transpose()?.map(Arc::new);
            let colliders = Colliders::new(maps.clone(), bodies.shapes.clone());
            let cloth = Cloth::new(kernels, model, step, colliders)?;
            let drawn = cloth.frame();
            let seen = (layers.len() < outermost).then(|| {
                let mut surface = drawn.surface(device);
                let raised = raised(kernels, &mut surface, drawn.particle_count, way);
                let trail = Trail::new(kernels, &surface.positions, drawn.particle_count);
                surface.velocities = Some(trail.velocities().clone());
                Seen { surface, trail, raised }
            });
            layers.push(Layer { cloth, is_worn: *is_worn, pins: pins.clone(), maps, seen });
        }
        let lead = match bodies.moving.as_slice() {
            [only] if layers.iter().any(|layer| layer.is_worn) => only.lead(),
            _ => None,
        };
        Ok(Self {
            moving,
            still,
            boxes: map_plan.boxes,
            shown: space.map(|space| space.map_box),
            thickness,
            frame_seconds: 1.0 / frame_rate,
            maps_per_frame,
            done: 0,
            posed: None,
            lead,
            teleports: Vec::new(),
            layers,
            kept: None,
            place: DVec3::ZERO,
            hosted: HostedBody::among(&bodies.moving),
        })
    }

    /// Draws the maps of a whole round of the only body now and keeps them: later they are copied instead of drawn. D §7, W §6.
    ///
    /// # Panics
    /// When [`maps_of_round`] is none.
    pub(crate) fn keep_maps(
        &mut self,
        kernels: &Kernels,
        body: &MovingMesh,
        recorder: &mut Recorder<'_>,
    ) -> Result<(), Error> {
        let device = kernels.device();
        let interval = self.interval_seconds();
        let count = maps_of_round(body, interval).expect("a closed motion of a whole number of intervals");
        let (Some(boxes), Some(first)) = (&self.boxes, self.layers.first().and_then(|layer| layer.maps.clone())) else {
            return Ok(());
        };
        let kept = KeptMaps::new(kernels, first.space(), boxes, count, interval)?;
        recorder(Part::Maps, &mut |encoder| kept.record(device, encoder, &mut self.moving[0], self.thickness))?;
        self.posed = None;
        self.kept = Some(kept);
        Ok(())
    }

    /// Time of the parts in which the outfit goes on [s]: a step; where a cloth lies over another one, an interval of the maps, in which each
    /// cloth in its turn does all its steps.
    pub(crate) fn part_seconds(&self) -> f64 {
        match self.layers.as_slice() {
            [only] => self.frame_seconds / f64::from(only.cloth.settings().steps_per_frame),
            _ => self.interval_seconds(),
        }
    }

    /// Simulated time from one drawing of the maps to the next [s].
    pub(crate) fn interval_seconds(&self) -> f64 {
        self.frame_seconds / f64::from(self.maps_per_frame)
    }

    /// Time at the end of an interval, counted from 1; 0 is the start [s].
    fn time_of(&self, interval: u64) -> f64 {
        let maps = u64::from(self.maps_per_frame);
        let (frames, rest) = (interval / maps, interval % maps);
        frames as f64 * self.frame_seconds + self.interval_seconds() * rest as f64
    }

    /// The interval that the next part belongs to, and where in it the part lies.
    fn place_in_interval(&self, part: u64) -> (u64, u32) {
        match self.layers.as_slice() {
            [only] => {
                let steps = u64::from(only.cloth.settings().steps_per_frame / self.maps_per_frame);
                (part / steps, (part % steps) as u32)
            }
            _ => (part, 0),
        }
    }

    /// Goes on from a state that was written into the cloths: so many parts are done.
    pub(crate) fn resume(&mut self, done: u64) {
        self.done = done;
        self.posed = None;
    }

    /// Records parts, as many as are due; then normals and status.
    pub(crate) fn record(
        &mut self,
        device: &wgpu::Device,
        parts: Range<u64>,
        recorder: &mut Recorder<'_>,
    ) -> Result<u32, Error> {
        assert_eq!(parts.start, self.done, "parts follow one another");
        self.record_pins(device, &parts, recorder)?;
        let mut most = 0;
        while self.done < parts.end {
            let (interval, first) = self.place_in_interval(self.done);
            self.pose(device, interval, recorder)?;
            if first == 0 {
                self.carry_garments(device, interval, recorder)?;
            }
            let steps = match self.layers.as_mut_slice() {
                [only] => {
                    let all = only.cloth.settings().steps_per_frame / self.maps_per_frame;
                    let last = all.min(first + (parts.end - self.done) as u32);
                    recorder(Part::Steps, &mut |encoder| only.cloth.record_steps(device, encoder, first..last, all))?;
                    self.done += u64::from(last - first);
                    last - first
                }
                _ => {
                    recorder(Part::Steps, &mut |encoder| self.record_interval(device, encoder))?;
                    self.done += 1;
                    let steps = self.layers.iter().map(|layer| layer.cloth.settings().steps_per_frame);
                    steps.max().unwrap_or(0) / self.maps_per_frame
                }
            };
            most += steps;
        }
        if most > 0 {
            recorder(Part::Steps, &mut |encoder| {
                for layer in &mut self.layers {
                    layer.cloth.record_outputs(encoder);
                }
            })?;
        }
        Ok(most)
    }

    /// Has what the host holds go where it is wanted by the end of these parts.
    fn record_pins(
        &mut self,
        device: &wgpu::Device,
        parts: &Range<u64>,
        recorder: &mut Recorder<'_>,
    ) -> Result<(), Error> {
        if parts.is_empty() {
            return Ok(());
        }
        let seconds = (parts.end - parts.start) as f64 * self.part_seconds();
        recorder(Part::Steps, &mut |encoder| {
            for layer in &mut self.layers {
                layer.cloth.record_pins(device, encoder, &layer.pins.take(seconds));
            }
        })
    }

    /// Holds these particles of each cloth and no others.
    pub(crate) fn set_pins<'a>(&mut self, pins: impl Iterator<Item = &'a BTreeMap<u32, DVec3>>) {
        for (layer, pins) in self.layers.iter_mut().zip(pins) {
            layer.pins.set(pins);
        }
    }

    /// What the host holds of each cloth.
    pub(crate) fn pins(&self) -> impl Iterator<Item = &Pins> {
        self.layers.iter().map(|layer| &layer.pins)
    }

    /// What the device knows of the particles that are held: of a state that was written into the cloths.
    pub(crate) fn know_pins(&mut self, known: impl Iterator<Item = Pins>) {
        for (layer, pins) in self.layers.iter_mut().zip(known) {
            layer.pins = pins;
        }
    }

    /// Has the bodies that move stand elsewhere, so far from where their motion has them [m]; they do not move on the way.
    pub(crate) fn set_place(&mut self, place: DVec3) {
        if let Some(boxes) = &mut self.boxes {
            boxes.go_along(place - self.place);
        }
        self.hosted.iter_mut().for_each(HostedBody::forget);
        self.place = place;
        self.moving.iter_mut().for_each(|body| body.set_place(place));
        self.posed = None;
    }

    /// Has the host's vertices be those of the body that it skins, where there is one: they show it at a time [s], some seconds after the positions before.
    pub(crate) fn give(
        &mut self,
        device: &wgpu::Device,
        vertices: &HostVertices,
        time: f64,
        seconds: f64,
    ) -> Result<(), Error> {
        let Some(hosted) = &self.hosted else { return Ok(()) };
        Ok(self.moving[hosted.index].give(device, vertices, time, seconds)?)
    }

    /// The middle of a body that the host skins, as it was seen last.
    pub(crate) fn middle(&self) -> Option<Vec3> {
        self.boxes.as_ref()?.middle()
    }

    /// Has the maps stand around a place where the body is that the host skins.
    pub(crate) fn stand_around(&mut self, middle: Vec3) {
        if let Some(boxes) = &mut self.boxes {
            boxes.stand_around(middle);
        }
        self.hosted.iter_mut().for_each(HostedBody::forget);
    }

    /// How far a body that the host skins was outside of its maps when it was seen last [m], told once; `None` where it was inside.
    pub(crate) fn take_outside(&mut self) -> Option<f32> {
        self.hosted.as_mut()?.take_outside()
    }

    /// How far bodies that move stand from where their motion has them [m].
    pub(crate) fn place(&self) -> DVec3 {
        self.place
    }

    /// Has what bodies wear go along by a way [m].
    pub(crate) fn carry_by(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, way: DVec3) {
        for layer in self.layers.iter_mut().filter(|layer| layer.is_worn) {
            layer.cloth.record_carry(device, encoder, DMat4::from_translation(way));
        }
    }

    /// Whether anything stands still beside what moves, or the maps of a round are kept: then bodies cannot be set elsewhere.
    pub(crate) fn is_bound_to_its_place(&self) -> bool {
        !self.still.is_empty() || self.kept.is_some()
    }

    /// Takes a cloth away; those over it lie on what is below.
    pub(crate) fn take_off(&mut self, index: usize) {
        let before = self.part_seconds();
        self.layers.remove(index);
        // Two cloths go on by intervals of the maps, one by steps.
        self.done *= (before / self.part_seconds()).round() as u64;
    }

    /// Records that it goes on where another outfit of the same cloths and bodies is, which has other passes.
    pub(crate) fn go_on_from(&mut self, encoder: &mut wgpu::CommandEncoder, before: &Outfit) -> Result<(), Error> {
        self.know_pins(before.pins().cloned());
        self.set_place(before.place);
        if let Some(middle) = before.middle() {
            self.stand_around(middle);
        }
        self.teleports.clone_from(&before.teleports);
        self.resume(before.done * self.parts_of_interval() / before.parts_of_interval());
        for (layer, from) in self.layers.iter_mut().zip(before.cloths()) {
            from.record_state(encoder, &layer.cloth);
            layer.cloth.resume(from.step(), from.status()?);
            // A renderer may draw it before the next step.
            layer.cloth.record_normals(encoder);
        }
        Ok(())
    }

    /// Parts that are still to do of the interval that has begun; none where cloths go on by whole intervals.
    pub(crate) fn rest_of_interval(&self) -> u64 {
        self.done.next_multiple_of(self.parts_of_interval()) - self.done
    }

    /// Parts of an interval of the maps.
    pub(crate) fn parts_of_interval(&self) -> u64 {
        (self.interval_seconds() / self.part_seconds()).round() as u64
    }

    /// Intervals done, with the one that has begun.
    pub(crate) fn intervals(&self) -> u64 {
        self.done.div_ceil(self.parts_of_interval())
    }

    /// Has its outer cloths, from this one on, be as they are in another outfit, which is at the same time where bodies stand at `place`.
    pub(crate) fn take_over(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        first: usize,
        from: &Outfit,
    ) -> Result<(), Error> {
        let way = self.place - from.place;
        for (layer, from) in self.layers.iter_mut().zip(&from.layers).skip(first) {
            from.cloth.record_state(encoder, &layer.cloth);
            layer.cloth.resume(from.cloth.step(), from.cloth.status()?);
            layer.pins = from.pins.clone();
            if layer.is_worn && way != DVec3::ZERO {
                layer.cloth.record_carry(device, encoder, DMat4::from_translation(way));
            }
            layer.cloth.record_normals(encoder);
        }
        Ok(())
    }

    /// Parts done.
    pub(crate) fn done(&self) -> u64 {
        self.done
    }

    /// Goes back to where so many parts were done, and the body had jumped so often.
    pub(crate) fn go_back(&mut self, done: u64, teleport_count: usize) {
        self.teleports.truncate(teleport_count);
        self.resume(done);
    }

    /// Has the bodies stand as they do at the end of an interval, and the innermost maps show them.
    fn pose(&mut self, device: &wgpu::Device, interval: u64, recorder: &mut Recorder<'_>) -> Result<(), Error> {
        if self.posed == Some(interval + 1) {
            return Ok(());
        }
        if self.posed != Some(interval) {
            let time = self.time_of(interval);
            recorder(Part::Maps, &mut |encoder| {
                self.moving.iter_mut().for_each(|body| body.record_pose(device, encoder, time));
            })?;
        }
        let time = self.time_of(interval + 1);
        let begins = self.posed.is_none();
        self.posed = Some(interval + 1);
        if self.boxes.is_none() && !begins {
            return Ok(());
        }
        recorder(Part::Maps, &mut |encoder| self.record_maps(device, encoder, time))
    }

    /// Has the garments go along with a body that jumps in an interval: at its start, because the maps already show where the body ends.
    fn carry_garments(
        &mut self,
        device: &wgpu::Device,
        interval: u64,
        recorder: &mut Recorder<'_>,
    ) -> Result<(), Error> {
        let [from, to] = [interval, interval + 1].map(|interval| self.time_of(interval));
        let Some(jump) = self.lead.as_ref().and_then(|lead| lead.jump(from, to)) else { return Ok(()) };
        match self.teleports.last_mut().filter(|last| from - last.time < MERGED_SECONDS) {
            // Between two keys of a clip a jump has several parts.
            Some(last) => {
                last.distance += jump.distance;
                last.angle += jump.angle;
            }
            None => self.teleports.push(Teleport { time: from, distance: jump.distance, angle: jump.angle }),
        }
        // A jump is told where the motion has the body.
        let [there, back] = [self.place, -self.place].map(DMat4::from_translation);
        let carry = there * jump.matrix() * back;
        recorder(Part::Steps, &mut |encoder| {
            for layer in self.layers.iter_mut().filter(|layer| layer.is_worn) {
                layer.cloth.record_carry(device, encoder, carry);
            }
        })
    }

    /// How often the body took the garments along, since the outfit goes.
    pub(crate) fn teleports(&self) -> &[Teleport] {
        &self.teleports
    }

    /// Records the pose of the bodies at a time [s], and what the innermost cloth sees of them.
    fn record_maps(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, time: f64) {
        if let Some(kept) = &self.kept {
            let innermost = self.layers.first().and_then(|layer| layer.maps.as_ref());
            let (maps, map_box) = kept.at(time);
            self.shown = Some(map_box);
            if let Some(innermost) = innermost {
                innermost.record_copy(device, encoder, maps, map_box);
            }
            return;
        }
        if let (Some(hosted), Some(boxes)) = (&mut self.hosted, &mut self.boxes) {
            hosted.follow(&mut self.moving, boxes);
        }
        let innermost = self.layers.first().and_then(|layer| layer.maps.as_ref());
        self.moving.iter_mut().for_each(|body| body.record_pose(device, encoder, time));
        if let Some(boxes) = &self.boxes {
            self.shown = Some(boxes.at(time, self.place));
        }
        if let Some(hosted) = &mut self.hosted {
            hosted.ask(encoder, &self.moving, self.shown, time);
        }
        if let (Some(innermost), Some(shown)) = (innermost, self.shown) {
            let surfaces = self.still.iter().chain(self.moving.iter().map(MovingBody::surface));
            let drawn: Vec<_> = surfaces.map(|surface| (surface, self.thickness)).collect();
            innermost.record(device, encoder, shown, &drawn);
        }
    }

    /// Records the steps of all cloths up to the pose of the bodies.
    fn record_interval(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) {
        let interval = self.interval_seconds();
        for index in 0..self.layers.len() {
            let (inner, outer) = self.layers.split_at_mut(index);
            let layer = &mut outer[0];
            if let (Some(below), Some(maps), Some(shown)) = (inner.last(), &layer.maps, self.shown) {
                let seen = below.seen.as_ref().expect("a cloth below another one is seen");
                // What the cloth below sees, and that cloth, which has gone to the same time already.
                match &below.maps {
                    Some(seen_below) => {
                        maps.record_copy(device, encoder, seen_below, shown);
                        maps.record_over(device, encoder, &[(&seen.surface, self.thickness)]);
                    }
                    None => maps.record(device, encoder, shown, &[(&seen.surface, self.thickness)]),
                }
            }
            let steps = layer.cloth.settings().steps_per_frame / self.maps_per_frame;
            if let Some(seen) = &mut layer.seen {
                if let Some(raised) = &seen.raised {
                    layer.cloth.record_normals(encoder);
                    raised.record(encoder);
                }
                seen.trail.record_leaving(encoder);
            }
            layer.cloth.record_steps(device, encoder, 0..steps, steps);
            if let Some(seen) = &mut layer.seen {
                // The cloth over this one sees it as it is now.
                layer.cloth.record_normals(encoder);
                seen.raised.iter().for_each(|raised| raised.record(encoder));
                seen.trail.record_arrival(device, encoder, interval);
            }
        }
    }

    /// The cloths, from the inside out.
    pub(crate) fn cloths(&self) -> impl ExactSizeIterator<Item = &Cloth> {
        self.layers.iter().map(|layer| &layer.cloth)
    }

    /// The cloths, from the inside out.
    pub(crate) fn cloths_mut(&mut self) -> impl ExactSizeIterator<Item = &mut Cloth> {
        self.layers.iter_mut().map(|layer| &mut layer.cloth)
    }

    /// The bodies on the device, as the maps draw them: those at rest, then those that move.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = &Surface> {
        self.still.iter().chain(self.moving.iter().map(MovingBody::surface))
    }

    /// What did not fit into the maps, as far as they have reported.
    pub(crate) fn maps_fault(&self) -> Option<MapsFault> {
        self.layers.iter().filter_map(|layer| layer.maps.as_ref()).find_map(|maps| maps.fault())
    }

    /// Where the maps stand.
    pub(crate) fn shown(&self) -> Option<MapBox> {
        self.shown
    }

    /// Time in the motion of the bodies that their surfaces and maps show [s].
    pub(crate) fn body_time(&self) -> f64 {
        self.posed.map_or(0.0, |interval| self.time_of(interval))
    }

    /// Bytes on the device beside those of the cloths.
    pub(crate) fn bytes(&self) -> u64 {
        let seen = self.layers.iter().flat_map(|layer| &layer.seen);
        let trails = seen.map(|seen| seen.trail.bytes() + seen.raised.as_ref().map_or(0, Raised::bytes));
        let kept = self.kept.as_ref().map_or(0, KeptMaps::bytes);
        self.moving.iter().map(MovingBody::bytes).sum::<u64>() + trails.sum::<u64>() + kept
    }
}
