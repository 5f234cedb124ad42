//! The studio: what light reaches a point, and what stands in its way.

use super::camera::{Axes, Camera, Projection};
use super::in_parallel;
use super::raster::{Corner, scan};
use super::soup::Soup;
use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// Directions from which the surroundings shine.
const SKY_LAMPS: usize = 96;
/// Shadow map cells across the scene, for the surroundings.
const SKY_CELLS: f32 = 320.0;
/// Directions that make up the key light.
const KEY_LAMPS: usize = 12;
/// Shadow map cells across the scene, for the key light.
const KEY_CELLS: f32 = 896.0;
/// Half the angle under which the key light is seen, as a tangent: it makes the edges of shadows soft.
const KEY_SPREAD: f32 = 0.11;

/// How far from the middle of the picture cloth and bodies shade others, in radii of the scene.
const SHADE: Vec2 = Vec2::splat(4.0);

/// All lights of a picture. They stand around the camera: each view is lit alike.
pub struct Studio {
    lamps: Vec<Lamp>,
    /// Height of the floor.
    pub floor: f32,
    /// Light on the floor where nothing stands in its way.
    floor_light: Light,
}

/// Light that reaches a point.
#[derive(Clone, Copy, Default)]
pub struct Light {
    /// What arrives.
    pub arriving: Vec3,
    /// What would arrive if nothing stood in its way.
    pub open: Vec3,
}

/// Light from one direction.
struct Lamp {
    toward: Vec3,
    /// Light on a surface that faces it.
    strength: Vec3,
    shadow: ShadowMap,
}

impl Studio {
    pub fn new(soup: &Soup, camera: &Camera) -> Self {
        let ahead = Vec3::new(camera.axes.toward.x, 0.0, camera.axes.toward.z).normalize();
        let stand = |x: f32, y: f32, z: f32| (camera.axes.right * x + Vec3::Y * y + ahead * z).normalize();
        let key = stand(-1.0, 0.95, 0.62);
        let fill = stand(0.9, 0.25, 0.6);
        let rims = [stand(0.85, 0.45, -0.75), stand(-0.85, 0.45, -0.75)];

        let sky = spiral(SKY_LAMPS).map(|(along, angle)| {
            let y = 1.0 - 2.0 * along;
            let ring = (1.0 - y * y).sqrt();
            let toward = Vec3::new(ring * angle.cos(), y, ring * angle.sin());
            let lobe = |centre: Vec3, sharpness: i32| toward.dot(centre).max(0.0).powi(sharpness);
            let floor_to_sky = (0.5 + 0.8 * y).clamp(0.0, 1.0);
            let radiance = Vec3::new(0.15, 0.145, 0.14).lerp(Vec3::new(0.31, 0.33, 0.36), floor_to_sky)
                + Vec3::new(0.16, 0.17, 0.19) * lobe(fill, 3)
                + Vec3::new(0.95, 0.95, 1.0) * (lobe(rims[0], 8) + lobe(rims[1], 8));
            (toward, radiance * (4.0 / SKY_LAMPS as f32), SKY_CELLS)
        });
        let disc = Axes::from(key);
        let keys = spiral(KEY_LAMPS).map(|(along, angle)| {
            let offset = Vec2::from_angle(angle) * (KEY_SPREAD * along.sqrt());
            let toward = (key + disc.right * offset.x + disc.up * offset.y).normalize();
            (toward, Vec3::new(0.90, 0.865, 0.82) / KEY_LAMPS as f32, KEY_CELLS)
        });

        let settings: Vec<_> = sky.chain(keys).collect();
        let mut lamps: Vec<Option<Lamp>> = settings.iter().map(|_| None).collect();
        in_parallel(lamps.iter_mut().zip(settings), |(lamp, (toward, strength, cells))| {
            *lamp = Some(Lamp { toward, strength, shadow: ShadowMap::new(soup, toward, cells) });
        });
        let mut studio =
            Self { lamps: lamps.into_iter().flatten().collect(), floor: -soup.half.y, floor_light: Light::default() };
        // Far from the scene nothing stands in the way.
        studio.floor_light = studio.light(Vec3::splat(1e3), Vec3::Y);
        studio
    }

    /// Light on a surface with a unit normal.
    pub fn light(&self, point: Vec3, normal: Vec3) -> Light {
        let mut light = Light::default();
        for lamp in &self.lamps {
            let cosine = lamp.toward.dot(normal);
            if cosine > 0.0 {
                let full = lamp.strength * cosine;
                light.open += full;
                light.arriving += full * lamp.shadow.visibility(point, normal);
            }
        }
        light
    }

    /// How much of its light a point of the floor gets, 0 to 1.
    pub fn floor_visibility(&self, point: Vec3) -> Vec3 {
        self.light(point, Vec3::Y).arriving / self.floor_light.open
    }
}

/// Points of a Fibonacci spiral: evenly spread part of the way, 0 to 1, and angle [radians].
fn spiral(count: usize) -> impl Iterator<Item = (f32, f32)> {
    let turn = TAU * (1.0 - 1.0 / ((1.0 + 5.0f32.sqrt()) / 2.0));
    (0..count).map(move |i| ((i as f32 + 0.5) / count as f32, (i as f32 * turn) % (2.0 * PI)))
}

/// How near to a light the scene comes, on a grid.
struct ShadowMap {
    projection: Projection,
    width: usize,
    height: usize,
    /// Largest height towards the light in each cell.
    nearest: Vec<f32>,
}

impl ShadowMap {
    fn new(soup: &Soup, toward: Vec3, cells: f32) -> Self {
        let axes = Axes::from(toward);
        let scale = 0.5 * cells;
        // What lies far out of the picture shades nothing in it.
        let [low, high] = axes.bounds(&soup.positions).map(|corner| corner.clamp(-SHADE, SHADE));
        // Two free cells all around, so that a comparison at the rim finds cells without anything in them.
        let origin = Vec2::new(-low.x, high.y) * scale + 2.0;
        let [width, height] = ((high - low) * scale).to_array().map(|v| v.ceil() as usize + 4);
        let projection = Projection::new(axes, origin, scale);
        let corners: Vec<Corner> = soup.positions.iter().map(|p| projection.project(*p)).collect();
        let mut nearest = vec![f32::NEG_INFINITY; width * height];
        for t in &soup.triangles {
            scan(t.map(|i| corners[i as usize]), width, 0..height, |column, row, height| {
                let cell = &mut nearest[row * width + column];
                *cell = cell.max(height);
            });
        }
        Self { projection, width, height, nearest }
    }

    /// Part of the light that reaches a point, from the four cells around it.
    fn visibility(&self, point: Vec3, normal: Vec3) -> f32 {
        // A cell holds one height for all of its surface; a point this far off its own surface is not shaded by it.
        let cell = 1.0 / self.projection.scale;
        let p = self.projection.place(point + normal * (1.5 * cell));
        let height = p.z + 0.5 * cell;
        let (x, y) = (p.x - 0.5, p.y - 0.5);
        let inside = x >= 0.0 && y >= 0.0 && x < (self.width - 1) as f32 && y < (self.height - 1) as f32;
        if !inside {
            return 1.0;
        }
        let (left, top) = (x as usize, y as usize);
        let first = top * self.width + left;
        let open = |index: usize| f32::from(u8::from(self.nearest[index] <= height));
        let (right, down) = (x - left as f32, y - top as f32);
        let upper = open(first) * (1.0 - right) + open(first + 1) * right;
        let lower = open(first + self.width) * (1.0 - right) + open(first + self.width + 1) * right;
        upper * (1.0 - down) + lower * down
    }
}
