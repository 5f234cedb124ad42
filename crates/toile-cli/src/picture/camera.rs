//! Orthographic projections, and the camera that frames a scene.

use super::View;
use super::raster::{Corner, SUBPIXELS};
use super::soup::Soup;
use glam::{Mat3, Vec2, Vec3};

/// Samples per pixel along one direction.
pub const SAMPLES: usize = 3;

/// How far all cameras look down [degrees]: enough to see the floor, too little to foreshorten the scene (0.7 %).
const PITCH: f32 = 7.0;

/// Part of the width and of the height that stays free on each side.
const MARGIN: f32 = 0.03;

/// Farthest coordinate of the raster [steps of a cell]: differences and their products stay whole numbers.
const FARTHEST: f32 = (1 << 29) as f32;

/// An orthographic projection onto a grid of cells, the first one at the upper left.
pub struct Projection {
    /// Unit vectors to the right, up and towards the eye as rows.
    axes: Mat3,
    /// Grid position of the scene's centre.
    origin: Vec2,
    /// Cells per unit of length.
    pub scale: f32,
}

impl Projection {
    pub fn new(axes: Axes, origin: Vec2, scale: f32) -> Self {
        Self { axes: axes.rows(), origin, scale }
    }

    /// Grid position (x to the right, y down, cell centres at halves) and height towards the eye.
    pub fn place(&self, point: Vec3) -> Vec3 {
        let p = self.axes * point;
        Vec3::new(self.origin.x + self.scale * p.x, self.origin.y - self.scale * p.y, p.z)
    }

    /// The same as the raster reads it.
    pub fn project(&self, point: Vec3) -> Corner {
        let p = self.place(point);
        let fixed = |v: f32| (v * SUBPIXELS as f32).clamp(-FARTHEST, FARTHEST) as i32;
        Corner { x: fixed(p.x), y: fixed(p.y), height: p.z }
    }
}

/// Three perpendicular unit vectors.
#[derive(Clone, Copy)]
pub struct Axes {
    pub right: Vec3,
    pub up: Vec3,
    /// Towards the eye or the light.
    pub toward: Vec3,
}

impl Axes {
    /// Axes of an eye that looks at the scene from a direction.
    pub fn from(toward: Vec3) -> Self {
        let [right, up] = <[Vec3; 2]>::from(toward.any_orthonormal_pair());
        Self { right, up, toward }
    }

    fn rows(&self) -> Mat3 {
        Mat3::from_cols(self.right, self.up, self.toward).transpose()
    }

    /// Size of the box around all positions, seen along these axes: lowest and highest coordinate to the right and up.
    pub fn bounds(&self, positions: &[Vec3]) -> [Vec2; 2] {
        let seen = positions.iter().map(|p| Vec2::new(self.right.dot(*p), self.up.dot(*p)));
        seen.fold([Vec2::INFINITY, Vec2::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
    }
}

/// The camera of a picture.
pub struct Camera {
    /// Width of the picture [pixels].
    pub width: usize,
    /// Height of the picture [pixels].
    pub height: usize,
    pub axes: Axes,
    /// Onto the grid of samples, [`SAMPLES`] times as fine as the pixels.
    pub samples: Projection,
}

impl Camera {
    pub fn new(soup: &Soup, view: View, height: usize) -> Self {
        let yaw = match view {
            View::Front => 0.0,
            View::ThreeQuarter => 35.0,
            View::Side => 90.0,
            View::Back => 180.0f32,
        };
        let (sin, cos) = yaw.to_radians().sin_cos();
        let (pitch_sin, pitch_cos) = PITCH.to_radians().sin_cos();
        let right = Vec3::new(cos, 0.0, -sin);
        let toward = Vec3::new(sin * pitch_cos, pitch_sin, cos * pitch_cos);
        let axes = Axes { right, up: toward.cross(right), toward };

        // The upright cylinder around the scene has the same size from all sides, and so all views have one scale.
        let radius = soup.framed.iter().map(|p| p.x.hypot(p.z)).fold(0.0, f32::max);
        let tallness = 2.0 * (soup.half.y * pitch_cos + radius * pitch_sin);
        let free = 1.0 - 2.0 * MARGIN;
        let pixels = height as f32 * free * (1.0 / tallness).min(2.0 / (2.0 * radius));

        let [low, high] = axes.bounds(&soup.framed);
        let wanted = (pixels * (high.x - low.x) / free).ceil() as usize;
        let width = wanted.clamp(height.div_ceil(2), 2 * height);
        let middle = Vec2::new(-0.5 * pixels * (low.x + high.x), 0.0);
        let origin = 0.5 * Vec2::new(width as f32, height as f32) + middle;
        let samples = Projection::new(axes, SAMPLES as f32 * origin, SAMPLES as f32 * pixels);
        Self { width, height, axes, samples }
    }

    /// Pixels per unit of length.
    pub fn pixels(&self) -> f32 {
        self.samples.scale / SAMPLES as f32
    }

    /// Where the line of sight through a pixel meets the plane through the origin that faces the camera.
    pub fn unproject(&self, pixel: Vec2) -> Vec3 {
        let cell = (SAMPLES as f32 * pixel - self.samples.origin) / self.samples.scale;
        self.axes.right * cell.x - self.axes.up * cell.y
    }
}
