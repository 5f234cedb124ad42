//! What points see of the bodies in layered maps. D §8, W §7.

use crate::maps::LayerMaps;
use crate::{Lag, Probe};
use glam::Vec3;
use toile_model::StepSettings;

/// How far the nearest layer may be from a point outside of all bodies to be seen, in texels.
const REACH: f32 = 4.0;
/// How deep behind a sheet a point is still drawn out of it [m].
const SHEET_DEPTH: f32 = 0.01;
/// Least part of a normal along the axis of its map that counts.
const SLANT_MIN: f32 = 0.1;
/// Most places on the way of a point that are looked at.
const WAY_PLACES: f32 = 16.0;
/// How often the part of a way in which a point enters is halved.
const HALVINGS: u32 = 4;

/// The surface that each point meets in the coming move, or none. All arrays have the shape [point_count].
///
/// A point sees, along each axis, the layers next below and above it. Each is a plane, whose weight falls with the eighth power of the
/// square of its distance and with its slant: no choice is made among them. A second look from the foot of the point on what it saw removes what the
/// slant of a surface does. A point whose way is longer than a texel is answered at the first place on it where it enters a body.
/// Surfaces with a velocity stand back by it for as long as the step is before the time of the maps. W §4.3.
pub(super) fn look_at_layers(
    positions: &[Vec3],
    velocities: &[Vec3],
    maps: &LayerMaps,
    lag: Lag,
    settings: &StepSettings,
) -> Vec<Probe> {
    let view = View { maps, lag, settings };
    positions.iter().zip(velocities).map(|(&position, &velocity)| view.look(position, velocity)).collect()
}

/// The weighted sum of planes, in weights of the nearest.
#[derive(Clone, Copy)]
struct Planes {
    weight: f32,
    normal: Vec3,
    distance: f32,
    velocity: Vec3,
    /// One more than the square of the distance of the nearest [texel²].
    spread: f32,
}

impl Default for Planes {
    fn default() -> Self {
        Self { weight: 0.0, normal: Vec3::ZERO, distance: 0.0, velocity: Vec3::ZERO, spread: FAR }
    }
}

/// The spread of nothing.
const FAR: f32 = 1e30;

/// What is seen from a place.
#[derive(Clone, Copy, Default)]
struct Sight {
    body: Planes,
    sheet: Planes,
    /// Whether the place lies between two ends of a body along some axis.
    inside: bool,
}

struct View<'a> {
    maps: &'a LayerMaps,
    lag: Lag,
    settings: &'a StepSettings,
}

impl View<'_> {
    fn look(&self, position: Vec3, velocity: Vec3) -> Probe {
        let texel = self.maps.map_box.texel;
        let dt = self.settings.dt;
        let moving = self.maps.velocities.is_some();
        // A cloth that is carried along goes the way of its surface.
        let guess = if moving { velocity } else { Vec3::ZERO };
        let mut place = position + guess * self.lag.start;
        let mut sight = self.sight(place, position, self.lag.start);
        let mut drift = guess;
        if moving && sight.seen() {
            drift = sight.drift();
            place = position + drift * self.lag.start;
            if ((drift - guess) * self.lag.start).length() > texel {
                // The surface goes another way than the point: from where it stands to it, it may see something else.
                sight = self.sight(place, position, self.lag.start);
            }
        }
        let way = velocity * dt + drift * (self.lag.end - self.lag.start);
        let length = way.length();
        if self.settings.swept && !sight.inside && length > texel {
            let places = (length / texel).ceil().min(WAY_PLACES);
            let start = place;
            let mut k = 1.0;
            while k <= places {
                let next = start + way * (k / places);
                let there = self.sight(next, next, 0.0);
                if there.inside {
                    (place, sight) = (next, there);
                    // Deeper, another side than that of the entry may be nearer.
                    let mut outside = (k - 1.0) / places;
                    let mut inside = k / places;
                    for _ in 0..HALVINGS {
                        let part = 0.5 * (outside + inside);
                        let middle = start + way * part;
                        let there = self.sight(middle, middle, 0.0);
                        if there.inside {
                            (inside, place, sight) = (part, middle, there);
                        } else {
                            outside = part;
                        }
                    }
                    break;
                }
                k += 1.0;
            }
        }
        let body = self.answer(position, place, length, sight.body, |sight| sight.body);
        let body = body.filter(|_| sight.inside || sight.body.spread < SPREAD_MAX);
        let sheet = self.answer(position, place, length, sight.sheet, |sight| sight.sheet);
        let sheet = sheet.filter(|probe| sight.sheet.spread < SPREAD_MAX && probe.distance > -SHEET_DEPTH);
        match (body, sheet) {
            (Some(body), Some(sheet)) if sheet.distance < body.distance => sheet,
            (Some(body), _) => body,
            (None, Some(sheet)) => sheet,
            (None, None) => Probe::default(),
        }
    }

    /// The second look, from the foot of a place on what was seen from there; a point that stays clear on a way of this length needs none.
    fn answer(
        &self,
        position: Vec3,
        place: Vec3,
        length: f32,
        first: Planes,
        of: fn(&Sight) -> Planes,
    ) -> Option<Probe> {
        let mut seen = first.mean()?;
        if seen.distance - length <= self.maps.map_box.texel {
            let foot = place - seen.normal * seen.distance;
            seen = of(&self.sight(foot, position, self.lag.start)).mean()?;
        }
        Some(Probe { distance: seen.distance - self.settings.thickness, ..seen })
    }

    /// What is seen from a place, with the distances of `point` when the surfaces stand back by `lag` [s].
    fn sight(&self, place: Vec3, point: Vec3, lag: f32) -> Sight {
        let mut sight = Sight::default();
        for axis in 0..3 {
            let Some(column) = self.maps.column_under(axis, place) else { continue };
            let ends = column.first..column.first + column.end_count;
            let sheets = ends.end..ends.end + column.sheet_count;
            let next = |layers: std::ops::Range<u32>| {
                let above = layers.clone().find(|k| self.maps.depths[*k as usize] > place[axis]).unwrap_or(layers.end);
                [(above > layers.start).then(|| above - 1), (above < layers.end).then_some(above)]
            };
            let [below, above] = next(ends.clone());
            sight.inside |= below.is_some_and(|k| (k - ends.start).is_multiple_of(2));
            for layer in [below, above].into_iter().flatten() {
                self.add(&mut sight.body, axis, layer, place, point, lag);
            }
            for layer in next(sheets).into_iter().flatten() {
                self.add(&mut sight.sheet, axis, layer, place, point, lag);
            }
        }
        sight
    }

    fn add(&self, planes: &mut Planes, axis: usize, layer: u32, place: Vec3, point: Vec3, lag: f32) {
        let map_box = &self.maps.map_box;
        let scale = 1.0 / map_box.texel;
        let mut centre = ((place * scale).floor() + 0.5) * map_box.texel;
        centre[axis] = self.maps.depths[layer as usize];
        let apart = (place - centre) * scale;
        let spread = apart.dot(apart) + 1.0;
        let normal = self.maps.normals[layer as usize];
        let velocity = self.maps.velocities.as_ref().map_or(Vec3::ZERO, |all| all[layer as usize]);
        let nearer = spread < planes.spread;
        let part = if nearer { spread / planes.spread } else { planes.spread / spread };
        let part2 = part * part;
        let part4 = part2 * part2;
        let part8 = part4 * part4;
        if nearer {
            planes.weight *= part8;
            planes.normal *= part8;
            planes.distance *= part8;
            planes.velocity *= part8;
            planes.spread = spread;
        }
        let slant = normal[axis].abs().max(SLANT_MIN);
        let slant2 = slant * slant;
        let weight = if nearer { slant2 * slant2 } else { part8 * (slant2 * slant2) };
        planes.weight += weight;
        planes.normal += normal * weight;
        planes.distance += normal.dot((point + velocity * lag) - centre) * weight;
        planes.velocity += velocity * weight;
    }
}

/// The spread of a layer at the end of the reach.
const SPREAD_MAX: f32 = REACH * REACH + 1.0;

impl Sight {
    fn seen(&self) -> bool {
        self.body.weight > 0.0 || self.sheet.weight > 0.0
    }

    /// Velocity of the nearer of body and sheet [m/s].
    fn drift(&self) -> Vec3 {
        let nearer = if self.sheet.spread < self.body.spread { &self.sheet } else { &self.body };
        nearer.velocity / nearer.weight
    }
}

impl Planes {
    fn mean(&self) -> Option<Probe> {
        let length = self.normal.length();
        if !(self.weight > 0.0 && length > 0.0) {
            return None;
        }
        Some(Probe {
            normal: self.normal / length,
            distance: self.distance / self.weight,
            velocity: self.velocity / self.weight,
            hit: true,
        })
    }
}
