//! What colour a pixel gets.

use super::camera::{Camera, SAMPLES};
use super::light::{Facing, Light, Studio};
use super::raster::{Corner, SUBPIXELS, scan, signed_area};
use super::soup::Soup;
use super::{Look, colour};
use glam::{Vec2, Vec3};

/// No triangle.
const NOTHING: u32 = u32::MAX;

/// What is seen at one sample.
#[derive(Clone, Copy)]
struct Sample {
    triangle: u32,
    height: f32,
}

/// Samples of one pixel that show one piece of surface: it is lit once.
#[derive(Clone, Copy)]
struct Piece {
    material: u32,
    outside: bool,
    height: f32,
    point: Vec3,
    normal: Vec3,
    count: f32,
}

/// A view that is drawn.
pub struct Shot<'a> {
    pub soup: &'a Soup,
    pub camera: &'a Camera,
    pub studio: &'a Studio<'a>,
    /// The vertices on the grid of samples.
    pub corners: &'a [Corner],
}

impl Shot<'_> {
    /// The triangles that may be seen in each band of so many rows of pixels.
    pub fn triangles_of_bands(&self, band_rows: usize) -> Vec<Vec<u32>> {
        let mut bands = vec![Vec::new(); self.camera.height.div_ceil(band_rows)];
        let steps = SUBPIXELS * (SAMPLES * band_rows) as i32;
        for (index, t) in (0..).zip(&self.soup.triangles) {
            let [a, b, c] = t.map(|i| self.corners[i as usize].y);
            let [first, last] = [a.min(b).min(c), a.max(b).max(c)].map(|y| y.div_euclid(steps));
            let last = last.min(bands.len() as i32 - 1);
            (first.max(0)..=last).for_each(|band| bands[band as usize].push(index));
        }
        bands
    }

    /// Draws the pixels of some rows, three bytes each, and of all triangles those that may be seen there.
    ///
    /// What is lit is gathered first: each light then looks at all of it together, which asks for one shadow map at a time.
    pub fn draw(&self, triangles: &[u32], first_row: usize, pixels: &mut [u8]) {
        let pieces = self.pieces(triangles, first_row, pixels.len() / 3);
        let faces: Vec<Facing> = pieces.iter().flatten().map(|piece| self.face(piece)).collect();
        let mut lights = self.studio.light(&faces).into_iter().zip(&faces);
        let floor = Floor::new(self, &pieces, first_row);
        for (index, (pixel, pieces)) in pixels.chunks_exact_mut(3).zip(&pieces).enumerate() {
            let mut sum = empty(pieces) * floor.colour(self, index);
            for (piece, (light, face)) in pieces.iter().zip(&mut lights) {
                sum += piece.count * self.surface(piece, face.normal, light);
            }
            pixel.copy_from_slice(&colour::bytes(sum / (SAMPLES * SAMPLES) as f32));
        }
    }

    /// What each of so many pixels shows, from the first of a row on.
    fn pieces(&self, triangles: &[u32], first_row: usize, count: usize) -> Vec<Vec<Piece>> {
        let Self { soup, camera, corners, .. } = *self;
        let columns = SAMPLES * camera.width;
        let top = SAMPLES * first_row;
        let rows = top..top + SAMPLES * count / camera.width;
        let nothing = Sample { triangle: NOTHING, height: f32::NEG_INFINITY };
        let mut samples = vec![nothing; columns * rows.len()];
        for &index in triangles {
            let triangle = soup.triangles[index as usize].map(|i| corners[i as usize]);
            scan(triangle, columns, rows.clone(), |column, row, height| {
                let sample = &mut samples[(row - top) * columns + column];
                if height > sample.height {
                    *sample = Sample { triangle: index, height };
                }
            });
        }
        let pieces = |index: usize| {
            let mut pieces = Vec::new();
            let (column, row) = (index % camera.width, index / camera.width);
            for y in SAMPLES * row..SAMPLES * (row + 1) {
                for x in SAMPLES * column..SAMPLES * (column + 1) {
                    let sample = samples[y * columns + x];
                    if sample.triangle != NOTHING {
                        collect(&mut pieces, self.see(sample, [x, y + top]), camera);
                    }
                }
            }
            pieces
        };
        (0..count).map(pieces).collect()
    }

    /// The surface at one sample.
    fn see(&self, sample: Sample, cell: [usize; 2]) -> Piece {
        let Self { soup, camera, corners, .. } = *self;
        let triangle = soup.triangles[sample.triangle as usize].map(|i| i as usize);
        let centre = (Vec2::new(cell[0] as f32, cell[1] as f32) + 0.5) / SAMPLES as f32;
        let point = camera.unproject(centre) + camera.axes.toward * sample.height;

        let [a, b, c] = triangle.map(|i| soup.positions[i]);
        let face = (b - a).cross(c - a);
        let weight = |from: Vec3, to: Vec3| (to - from).cross(point - from).dot(face).max(0.0);
        let weights = [weight(b, c), weight(c, a), weight(a, b)];
        let [na, nb, nc] = triangle.map(|i| soup.normals[i]);
        let normal = na * weights[0] + nb * weights[1] + nc * weights[2];

        let outside = signed_area(triangle.map(|i| corners[i])) > 0;
        let normal = if outside { normal } else { -normal };
        Piece {
            material: soup.triangle_materials[sample.triangle as usize],
            outside,
            height: sample.height,
            point,
            normal: normal.normalize_or(camera.axes.toward),
            count: 1.0,
        }
    }

    /// Where a piece of surface is lit, and which way it turns there.
    fn face(&self, piece: &Piece) -> Facing {
        let toward = self.camera.axes.toward;
        // Smooth normals near the outline can point away from the camera, though the surface is seen.
        let mean = piece.normal.normalize_or(toward);
        let normal = (mean + toward * (-mean.dot(toward)).max(0.0)).normalize_or(toward);
        Facing { point: piece.point / piece.count, normal }
    }

    /// Light that a piece of surface sends to the camera.
    fn surface(&self, piece: &Piece, normal: Vec3, light: Light) -> Vec3 {
        let material = &self.soup.materials[piece.material as usize];
        let own = colour::linear(if piece.outside { material.outside } else { material.inside });
        // Where light is blocked, what blocks it is lit too and reflects some of it, in about the same colour.
        let reflected = own * 0.35 * (light.open - light.arriving);
        let diffuse = own * (light.arriving + reflected);
        let grazing = 1.0 - normal.dot(self.camera.axes.toward).clamp(0.0, 1.0);
        let sheen = match material.look {
            Look::Cloth => 0.30 * grazing.powi(2),
            Look::Skin => 0.06 * grazing.powi(4),
        };
        shoulder(diffuse + sheen * light.arriving * own.lerp(Vec3::ONE, 0.4))
    }

    /// The middle of a pixel, by its index from the first of a row.
    fn middle(&self, first_row: usize, index: usize) -> Vec2 {
        let (column, row) = (index % self.camera.width, first_row + index / self.camera.width);
        Vec2::new(column as f32, row as f32) + 0.5
    }
}

/// Samples of a pixel that show nothing.
fn empty(pieces: &[Piece]) -> f32 {
    (SAMPLES * SAMPLES) as f32 - pieces.iter().map(|piece| piece.count).sum::<f32>()
}

/// Adds a sample to the piece it belongs to, or begins a new one.
fn collect(pieces: &mut Vec<Piece>, seen: Piece, camera: &Camera) {
    let near = (4 * SAMPLES) as f32 / camera.samples.scale;
    let same = |p: &&mut Piece| {
        p.material == seen.material && p.outside == seen.outside && (p.height - seen.height).abs() < near
    };
    match pieces.iter_mut().find(same) {
        Some(piece) => {
            piece.point += seen.point;
            piece.normal += seen.normal;
            piece.count += 1.0;
        }
        None => pieces.push(seen),
    }
}

/// Leaves dark and middle tones and rolls off bright ones, so that lit cloth keeps its folds.
fn shoulder(light: Vec3) -> Vec3 {
    const KNEE: f32 = 0.6;
    Vec3::from(light.to_array().map(|v| {
        let over = (v - KNEE).max(0.0) / (1.0 - KNEE);
        v.min(KNEE) + (1.0 - KNEE) * over / (1.0 + over)
    }))
}

/// Wall and floor behind some rows of pixels, with the shadow that the scene throws on the floor.
struct Floor {
    first_row: usize,
    /// How much of its light each pixel gets, and how much of that is told.
    shade: Vec<(Vec3, f32)>,
}

impl Floor {
    /// Pixels from one value of the surroundings to the next: their light changes so little along a row.
    const STEP: usize = 4;

    fn new(shot: &Shot, pieces: &[Vec<Piece>], first_row: usize) -> Self {
        let (camera, studio) = (shot.camera, shot.studio);
        let floor = |pixel: Vec2| {
            let on_plane = camera.unproject(pixel);
            on_plane + camera.axes.toward * ((studio.floor - on_plane.y) / camera.axes.toward.y)
        };
        // Shadows fade out before the shadow maps end.
        let fade = |point: Vec3| 1.0 - (point.x.hypot(point.z) / 1.6).clamp(0.0, 1.0).powi(2);
        let mut shade = vec![(Vec3::ONE, 0.0); pieces.len()];
        let rows = shade.chunks_exact_mut(camera.width).zip(pieces.chunks_exact(camera.width));
        for (row, (shade, pieces)) in rows.enumerate() {
            let points = (0..camera.width).map(|column| floor(shot.middle(first_row + row, column)));
            let seen: Vec<(usize, Vec3, f32)> = points
                .enumerate()
                .map(|(column, point)| (column, point, fade(point)))
                .filter(|(column, _, fade)| *fade > 0.0 && empty(&pieces[*column]) > 0.0)
                .collect();
            let (Some(first), Some(last)) = (seen.first(), seen.last()) else { continue };
            let first = first.0 / Self::STEP;
            let places = first..=last.0 / Self::STEP + 1;
            let places =
                places.map(|place| floor(shot.middle(first_row + row, 0) + Vec2::X * (place * Self::STEP) as f32));
            let sky = studio.floor_sky(&places.collect::<Vec<_>>());
            let key = studio.floor_key(&seen.iter().map(|(_, point, _)| *point).collect::<Vec<_>>());
            for ((column, _, fade), key) in seen.into_iter().zip(key) {
                let place = column / Self::STEP - first;
                let part = (column % Self::STEP) as f32 / Self::STEP as f32;
                shade[column] = (key + sky[place].lerp(sky[place + 1], part), fade);
            }
        }
        Self { first_row, shade }
    }

    fn colour(&self, shot: &Shot, index: usize) -> Vec3 {
        let pixel = shot.middle(self.first_row, index);
        let down = pixel.y / shot.camera.height as f32;
        let aside = (pixel.x / shot.camera.width as f32 - 0.5).abs();
        let paper = Vec3::new(0.80, 0.81, 0.83).lerp(Vec3::new(0.90, 0.90, 0.90), down) * (1.0 - 0.12 * aside * aside);
        let (visibility, fade) = self.shade[index];
        paper * Vec3::ONE.lerp(visibility, 0.75 * fade)
    }
}
