//! The studio: what light reaches a point, and what stands in its way.

use super::camera::{Axes, Camera, Projection};
use super::in_parallel;
use super::raster::{Corner, scan};
use super::soup::Soup;
use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// Pairs of opposite directions from which the surroundings shine: what stands in the way of both is drawn at once.
const SKY_PAIRS: usize = 32;
/// Most shadow map cells along the radius of the scene, for the surroundings.
const SKY_CELLS: f32 = 160.0;
/// Shadow map cells per pixel, for the surroundings: each direction gives little of the light, so that its edges need not be sharp.
const SKY_FINENESS: f32 = 0.5;
/// Directions that make up the key light.
const KEY_LAMPS: usize = 12;
/// Most shadow map cells along the radius of the scene, for the key light.
const KEY_CELLS: f32 = 448.0;
/// Half the angle under which the key light is seen, as a tangent: it makes the edges of shadows soft.
const KEY_SPREAD: f32 = 0.11;

/// How far from the middle of the picture cloth and bodies shade others, in radii of the scene.
const SHADE: Vec2 = Vec2::splat(4.0);

/// What stands in the way of every light. The surroundings shine from the same directions in all views, so their shadows are drawn once.
pub struct Shadows {
    sky: Vec<ShadowMap>,
    /// Of the key light of each view, which stands beside its camera.
    keys: Vec<Vec<ShadowMap>>,
}

impl Shadows {
    pub fn new(soup: &Soup, cameras: &[Camera]) -> Self {
        let pixels = cameras.iter().map(Camera::pixels).fold(0.0, f32::max);
        let sky = sky_directions().map(|toward| (toward, Sides::Both, SKY_CELLS.min(SKY_FINENESS * pixels)));
        let keys = cameras.iter().flat_map(|camera| {
            // No finer than the pixels that show it.
            let cells = KEY_CELLS.min(camera.pixels());
            key_directions(camera).map(move |toward| (toward, Sides::Near, cells))
        });
        let settings: Vec<_> = sky.chain(keys).collect();
        let mut maps: Vec<Option<ShadowMap>> = settings.iter().map(|_| None).collect();
        in_parallel(maps.iter_mut().zip(settings), |(map, (toward, sides, cells))| {
            *map = Some(ShadowMap::new(soup, toward, sides, cells));
        });
        let mut maps = maps.into_iter().flatten();
        let sky = maps.by_ref().take(SKY_PAIRS).collect();
        let keys = cameras.iter().map(|_| maps.by_ref().take(KEY_LAMPS).collect()).collect();
        Self { sky, keys }
    }
}

/// Directions from which the surroundings shine, one of each pair.
fn sky_directions() -> impl Iterator<Item = Vec3> {
    spiral(SKY_PAIRS).map(|(along, angle)| {
        let y = 1.0 - along;
        let ring = (1.0 - y * y).sqrt();
        Vec3::new(ring * angle.cos(), y, ring * angle.sin())
    })
}

/// Directions of the key light, on a disc around its middle.
fn key_directions(camera: &Camera) -> impl Iterator<Item = Vec3> {
    let key = stand(camera, -1.0, 0.95, 0.62);
    let disc = Axes::from(key);
    spiral(KEY_LAMPS).map(move |(along, angle)| {
        let offset = Vec2::from_angle(angle) * (KEY_SPREAD * along.sqrt());
        (key + disc.right * offset.x + disc.up * offset.y).normalize()
    })
}

/// Direction of a light that stands so far to the right, up and before the scene, as the camera sees it.
fn stand(camera: &Camera, x: f32, y: f32, z: f32) -> Vec3 {
    let ahead = Vec3::new(camera.axes.toward.x, 0.0, camera.axes.toward.z).normalize();
    (camera.axes.right * x + Vec3::Y * y + ahead * z).normalize()
}

/// All lights of a picture. They stand around the camera: each view is lit alike.
pub struct Studio<'a> {
    /// Light of the surroundings on a surface that faces it, from each direction of a pair.
    sky: Vec<([Vec3; 2], &'a ShadowMap)>,
    keys: &'a [ShadowMap],
    /// Height of the floor.
    pub floor: f32,
    /// Light on the floor where nothing stands in its way.
    floor_light: Vec3,
}

/// Light that reaches a point.
#[derive(Clone, Copy, Default)]
pub struct Light {
    /// What arrives.
    pub arriving: Vec3,
    /// What would arrive if nothing stood in its way.
    pub open: Vec3,
}

impl Light {
    fn add(&mut self, full: Vec3, visibility: f32) {
        self.open += full;
        self.arriving += full * visibility;
    }
}

/// A place on a surface, and which way it turns there.
pub struct Facing {
    pub point: Vec3,
    /// Unit normal.
    pub normal: Vec3,
}

impl<'a> Studio<'a> {
    /// The lights of the view with this number.
    pub fn new(soup: &Soup, camera: &Camera, shadows: &'a Shadows, view: usize) -> Self {
        let fill = stand(camera, 0.9, 0.25, 0.6);
        let rims = [stand(camera, 0.85, 0.45, -0.75), stand(camera, -0.85, 0.45, -0.75)];
        let strength = |toward: Vec3| {
            let lobe = |centre: Vec3, sharpness: i32| toward.dot(centre).max(0.0).powi(sharpness);
            let floor_to_sky = (0.5 + 0.8 * toward.y).clamp(0.0, 1.0);
            let radiance = Vec3::new(0.15, 0.145, 0.14).lerp(Vec3::new(0.31, 0.33, 0.36), floor_to_sky)
                + Vec3::new(0.16, 0.17, 0.19) * lobe(fill, 3)
                + Vec3::new(0.95, 0.95, 1.0) * (lobe(rims[0], 8) + lobe(rims[1], 8));
            radiance * (2.0 / SKY_PAIRS as f32)
        };
        let sky = shadows.sky.iter().map(|shadow| ([shadow.toward, -shadow.toward].map(strength), shadow)).collect();
        let keys = shadows.keys[view].as_slice();
        let mut studio = Self { sky, keys, floor: -soup.half.y, floor_light: Vec3::ONE };
        // Far from the scene nothing stands in the way.
        studio.floor_light = studio.light(&[Facing { point: Vec3::splat(1e3), normal: Vec3::Y }])[0].arriving;
        studio
    }

    /// Light on surfaces.
    pub fn light(&self, faces: &[Facing]) -> Vec<Light> {
        let mut lights = vec![Light::default(); faces.len()];
        self.add_sky(faces, &mut lights);
        self.add_key(faces, &mut lights);
        lights
    }

    /// Adds the light of the surroundings.
    fn add_sky(&self, faces: &[Facing], lights: &mut [Light]) {
        for (strengths, shadow) in &self.sky {
            for (face, light) in faces.iter().zip(&mut *lights) {
                let cosine = shadow.toward.dot(face.normal);
                let away = usize::from(cosine < 0.0);
                light.add(strengths[away] * cosine.abs(), shadow.visibility(face, away));
            }
        }
    }

    /// Adds the key light.
    fn add_key(&self, faces: &[Facing], lights: &mut [Light]) {
        for shadow in self.keys {
            for (face, light) in faces.iter().zip(&mut *lights) {
                let cosine = shadow.toward.dot(face.normal);
                if cosine > 0.0 {
                    light.add(Vec3::new(0.90, 0.865, 0.82) * (cosine / KEY_LAMPS as f32), shadow.visibility(face, 0));
                }
            }
        }
    }

    /// Parts of their light that points of the floor get from the surroundings; with those of the key light, 0 to 1.
    pub fn floor_sky(&self, points: &[Vec3]) -> Vec<Vec3> {
        self.on_floor(points, Self::add_sky)
    }

    /// Parts of their light that points of the floor get from the key light.
    pub fn floor_key(&self, points: &[Vec3]) -> Vec<Vec3> {
        self.on_floor(points, Self::add_key)
    }

    fn on_floor(&self, points: &[Vec3], add: impl Fn(&Self, &[Facing], &mut [Light])) -> Vec<Vec3> {
        let faces: Vec<Facing> = points.iter().map(|point| Facing { point: *point, normal: Vec3::Y }).collect();
        let mut lights = vec![Light::default(); faces.len()];
        add(self, &faces, &mut lights);
        lights.iter().map(|light| light.arriving / self.floor_light).collect()
    }
}

/// Points of a Fibonacci spiral: evenly spread part of the way, 0 to 1, and angle [radians].
fn spiral(count: usize) -> impl Iterator<Item = (f32, f32)> {
    let turn = TAU * (1.0 - 1.0 / ((1.0 + 5.0f32.sqrt()) / 2.0));
    (0..count).map(move |i| ((i as f32 + 0.5) / count as f32, (i as f32 * turn) % (2.0 * PI)))
}

/// From which directions a shadow map is asked.
#[derive(Clone, Copy, PartialEq)]
enum Sides {
    /// Its own.
    Near,
    /// Its own and the opposite one.
    Both,
}

/// How near to a light the scene comes, on a grid.
struct ShadowMap {
    /// Direction of the light.
    toward: Vec3,
    projection: Projection,
    width: usize,
    height: usize,
    /// Largest height towards the light in each cell, and towards an opposite one.
    nearest: [Vec<f32>; 2],
}

impl ShadowMap {
    /// `cells` is their number per unit of length.
    fn new(soup: &Soup, toward: Vec3, sides: Sides, cells: f32) -> Self {
        let axes = Axes::from(toward);
        // What lies far out of the picture shades nothing in it.
        let [low, high] = axes.bounds(&soup.positions).map(|corner| corner.clamp(-SHADE, SHADE));
        // Two free cells all around, so that a comparison at the rim finds cells without anything in them. The cells lie where they lay in the
        // picture before, whatever has moved: shadows of what stands still do not flicker.
        let origin = (Vec2::new(-low.x, high.y) * cells).ceil() + 2.0;
        let [width, height] = ((high - low) * cells).to_array().map(|v| v.ceil() as usize + 5);
        let projection = Projection::new(axes, origin, cells);
        let corners: Vec<Corner> = soup.positions.iter().map(|p| projection.project(*p)).collect();
        let mut near = vec![f32::NEG_INFINITY; width * height];
        let far = if sides == Sides::Both {
            let mut far = near.clone();
            for t in &soup.triangles {
                scan(t.map(|i| corners[i as usize]), width, 0..height, |column, row, height| {
                    let cell = row * width + column;
                    near[cell] = near[cell].max(height);
                    far[cell] = far[cell].max(-height);
                });
            }
            far
        } else {
            for t in &soup.triangles {
                scan(t.map(|i| corners[i as usize]), width, 0..height, |column, row, height| {
                    let cell = row * width + column;
                    near[cell] = near[cell].max(height);
                });
            }
            Vec::new()
        };
        Self { toward, projection, width, height, nearest: [near, far] }
    }

    /// Part of the light that reaches a point, from the four cells around it; `away` is 1 for the light of the opposite direction.
    #[inline]
    fn visibility(&self, face: &Facing, away: usize) -> f32 {
        // A cell holds one height for all of its surface; a point this far off its own surface is not shaded by it.
        let cell = 1.0 / self.projection.scale;
        let p = self.projection.place(face.point + face.normal * (1.5 * cell));
        let height = if away == 0 { p.z } else { -p.z } + 0.5 * cell;
        let (x, y) = (p.x - 0.5, p.y - 0.5);
        let inside = x >= 0.0 && y >= 0.0 && x < (self.width - 1) as f32 && y < (self.height - 1) as f32;
        if !inside {
            return 1.0;
        }
        let (left, top) = (x as u32 as usize, y as u32 as usize);
        let first = top * self.width + left;
        let nearest = &self.nearest[away];
        let (upper, lower) = (&nearest[first..first + 2], &nearest[first + self.width..first + self.width + 2]);
        let open = |nearest: f32| if nearest <= height { 1.0 } else { 0.0 };
        let (right, down) = (x - left as f32, y - top as f32);
        let upper = open(upper[0]) * (1.0 - right) + open(upper[1]) * right;
        let lower = open(lower[0]) * (1.0 - right) + open(lower[1]) * right;
        upper * (1.0 - down) + lower * down
    }
}
