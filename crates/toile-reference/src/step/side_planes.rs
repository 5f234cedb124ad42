//! What points see of the surfaces in the maps. W §4.3 and §4.4.

use crate::maps::SideMaps;
use crate::{Lag, Probe};
use glam::{Vec3, vec3};
use toile_model::StepSettings;

/// How far in front of a surface its texels still answer, in texels: on a slope the plane through a texel's centre reaches
/// out of the depth range of the texel.
const REACH: f32 = 4.0;

/// How much deeper than the least deep of four texels another may be and still belong to the same surface, in texels.
const SAME_SURFACE: f32 = 2.0;

/// Most places on the way of a point that are tested; up to so many texels per step none is left out.
const WAY_PLACES: f32 = 16.0;

/// The surface that each point meets in the coming move, or none. All arrays have the shape [point_count].
///
/// A point is inside when it lies between the front and the back of its texel; the nearer side answers, by the tangent plane
/// at the texel's centre. The planes of the four texels around the point are blended bilinearly, so that the
/// surface has no steps. A point that starts outside and enters on its way is answered by the side where it entered.
/// W §4.4, eq. 11 and 12.
///
/// Surfaces with a velocity stand back by it for as long as the step is before the time of the maps. W §4.3.
pub(super) fn look_at_sides(
    positions: &[Vec3],
    velocities: &[Vec3],
    maps: &SideMaps,
    lag: Lag,
    settings: &StepSettings,
) -> Vec<Probe> {
    let view = View { maps, lag, swept: settings.swept };
    positions
        .iter()
        .zip(velocities)
        .map(|(&position, &velocity)| view.look(position, velocity, settings.dt))
        .map(Option::unwrap_or_default)
        .collect()
}

#[derive(Clone, Copy, PartialEq)]
enum Standing {
    InFront,
    Behind,
    Inside,
    Beside,
}

/// The texel that holds a place, if the maps reach so far.
struct Texel {
    index: usize,
    front: f32,
    back: f32,
}

/// A place in the maps.
#[derive(Clone, Copy)]
struct Place {
    /// From their left and upper border, in texels.
    texels: [f32; 2],
    /// [m]
    z: f32,
}

impl Place {
    /// Moved to the centre of its texel. In metres and back it would lie a rounding error beside it, on either side of the border
    /// between the four texels that are blended and the next four.
    fn centred(self) -> Self {
        Self { texels: self.texels.map(|texels| texels.floor() + 0.5), ..self }
    }
}

struct View<'a> {
    maps: &'a SideMaps,
    lag: Lag,
    swept: bool,
}

impl View<'_> {
    fn look(&self, position: Vec3, velocity: Vec3, dt: f32) -> Option<Probe> {
        let map_box = &self.maps.map_box;
        let coming = velocity * dt;
        let next = position + coming;
        let drift = self.drift(next, velocity);
        let way = coming + drift * (self.lag.end - self.lag.start);
        let (place, side) = self.entry(position + drift * self.lag.start, way, next + drift * self.lag.end);
        let [across, down] = place.texels.map(|texels| texels - 0.5);
        let [left, top] = [across.floor(), down.floor()];
        if !(left >= 0.0 && left + 1.0 < map_box.columns as f32 && top >= 0.0 && top + 1.0 < map_box.rows as f32) {
            return None;
        }
        let [right_share, bottom_share] = [across - left, down - top];
        let corners = [
            (left, top, (1.0 - right_share) * (1.0 - bottom_share)),
            (left + 1.0, top, right_share * (1.0 - bottom_share)),
            (left, top + 1.0, (1.0 - right_share) * bottom_share),
            (left + 1.0, top + 1.0, right_share * bottom_share),
        ];
        let planes = corners.map(|(column, row, _)| self.plane(position, place.z, side, column, row));
        let mut nearest = -1e9;
        for plane in planes.iter().filter(|plane| plane.hit) {
            nearest = plane.distance.max(nearest);
        }
        let mut weight_sum = 0.0;
        let mut normal = Vec3::ZERO;
        let mut distance = 0.0;
        let mut velocity = Vec3::ZERO;
        for (plane, (_, _, weight)) in planes.iter().zip(corners) {
            if plane.hit && plane.distance >= nearest - SAME_SURFACE * map_box.texel {
                weight_sum += weight;
                normal += plane.normal * weight;
                distance += plane.distance * weight;
                velocity += plane.velocity * weight;
            }
        }
        let length = normal.length();
        if !(weight_sum > 0.0 && length > 0.0) {
            return None;
        }
        Some(Probe {
            normal: normal / length,
            distance: distance / weight_sum,
            velocity: velocity / weight_sum,
            hit: true,
        })
    }

    /// Velocity of the surface near a place; that of the point itself where the maps show none.
    fn drift(&self, next: Vec3, velocity: Vec3) -> Vec3 {
        let Some(layers) = &self.maps.velocities else { return Vec3::ZERO };
        match self.texel_under(self.place(next).texels) {
            None => velocity,
            Some(texel) if (next.z - texel.front).abs() <= (next.z - texel.back).abs() => layers[0][texel.index],
            Some(texel) => layers[1][texel.index],
        }
    }

    /// Where a way enters a surface, and from which side; its end and `Inside` when it does not. `way` leads from start to end; a
    /// device may shorten (start + way) - start, so it comes from the caller.
    fn entry(&self, start: Vec3, way: Vec3, end: Vec3) -> (Place, Standing) {
        let last = self.place(end);
        if !self.swept {
            return (last, Standing::Inside);
        }
        let first = self.place(start);
        let mut before = self.standing(first);
        if let (Standing::Inside, Some(texel)) = (before, self.texel_under(first.texels)) {
            // It may lie on the surface: it must not leave by the other side.
            let near_front = texel.front - start.z <= start.z - texel.back;
            return match self.standing(last) {
                Standing::Behind if near_front => (first, Standing::InFront),
                Standing::InFront if !near_front => (first, Standing::Behind),
                _ => (last, Standing::Inside),
            };
        }
        let places = (way.truncate().length() / self.maps.map_box.texel).ceil().clamp(1.0, WAY_PLACES);
        let mut k = 1.0;
        while k <= places {
            let place = if k < places { self.place(start + way * (k / places)).centred() } else { last };
            let now = self.standing(place);
            match (before, now) {
                (Standing::Beside, Standing::Inside) => return (place, Standing::Inside),
                (Standing::InFront, Standing::Inside | Standing::Behind)
                | (Standing::Behind, Standing::Inside | Standing::InFront) => return (place, before),
                _ => before = now,
            }
            k += 1.0;
        }
        (last, Standing::Inside)
    }

    fn place(&self, point: Vec3) -> Place {
        let map_box = &self.maps.map_box;
        let texels = [(point.x - map_box.origin_x) / map_box.texel, (map_box.origin_y - point.y) / map_box.texel];
        Place { texels, z: point.z }
    }

    fn standing(&self, place: Place) -> Standing {
        match self.texel_under(place.texels) {
            None => Standing::Beside,
            Some(texel) if place.z > texel.front => Standing::InFront,
            Some(texel) if place.z < texel.back => Standing::Behind,
            Some(_) => Standing::Inside,
        }
    }

    /// The texel that holds a place, where it shows a surface.
    fn texel_under(&self, texels: [f32; 2]) -> Option<Texel> {
        let map_box = &self.maps.map_box;
        let [column, row] = texels.map(f32::floor);
        if !(column >= 0.0 && column < map_box.columns as f32 && row >= 0.0 && row < map_box.rows as f32) {
            return None;
        }
        self.texel(column, row)
    }

    fn texel(&self, column: f32, row: f32) -> Option<Texel> {
        let map_box = &self.maps.map_box;
        let index = row as usize * map_box.columns as usize + column as usize;
        let [depth_front, depth_back] = [self.maps.depth[0][index], self.maps.depth[1][index]];
        let range = map_box.z_front - map_box.z_back;
        let [front, back] = [map_box.z_front - depth_front * range, map_box.z_back + depth_back * range];
        (depth_front < 1.0 && depth_back < 1.0).then_some(Texel { index, front, back })
    }

    /// What one texel says to a point at `position`: the plane through the texel's centre on the entered or nearer side.
    fn plane(&self, position: Vec3, z: f32, side: Standing, column: f32, row: f32) -> Probe {
        let map_box = &self.maps.map_box;
        let Some(texel) = self.texel(column, row) else { return Probe::default() };
        let reach = REACH * map_box.texel;
        let reaches_front = z < texel.front + reach || side == Standing::Behind;
        let reaches_back = z > texel.back - reach || side == Standing::InFront;
        if !(reaches_front && reaches_back) {
            return Probe::default();
        }
        let x = map_box.origin_x + (column + 0.5) * map_box.texel;
        let y = map_box.origin_y - (row + 0.5) * map_box.texel;
        let seen = [(0, texel.front), (1, texel.back)].map(|(layer, depth)| {
            let normal = self.maps.normals[layer][texel.index];
            let velocity = self.maps.velocities.as_ref().map_or(Vec3::ZERO, |layers| layers[layer][texel.index]);
            let distance = normal.dot((position + velocity * self.lag.start) - vec3(x, y, depth));
            Probe { normal, distance, velocity, hit: true }
        });
        let front = match side {
            Standing::InFront => true,
            Standing::Behind => false,
            Standing::Inside | Standing::Beside => seen[0].distance >= seen[1].distance,
        };
        seen[usize::from(!front)]
    }
}
