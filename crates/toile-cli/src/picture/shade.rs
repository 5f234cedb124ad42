//! What colour a pixel gets.

use super::camera::{Camera, SAMPLES};
use super::light::Studio;
use super::raster::{Corner, scan, signed_area};
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

/// Draws the pixels of some rows, three bytes each.
pub fn band(soup: &Soup, camera: &Camera, studio: &Studio, corners: &[Corner], first_row: usize, pixels: &mut [u8]) {
    let columns = SAMPLES * camera.width;
    let top = SAMPLES * first_row;
    let rows = top..top + SAMPLES * pixels.len() / (3 * camera.width);
    let nothing = Sample { triangle: NOTHING, height: f32::NEG_INFINITY };
    let mut samples = vec![nothing; columns * rows.len()];
    for (index, t) in soup.triangles.iter().enumerate() {
        scan(t.map(|i| corners[i as usize]), columns, rows.clone(), |column, row, height| {
            let sample = &mut samples[(row - top) * columns + column];
            if height > sample.height {
                *sample = Sample { triangle: index as u32, height };
            }
        });
    }

    let mut pieces = Vec::with_capacity(SAMPLES * SAMPLES);
    for (index, pixel) in pixels.chunks_exact_mut(3).enumerate() {
        let (column, row) = (index % camera.width, index / camera.width);
        pieces.clear();
        for y in SAMPLES * row..SAMPLES * (row + 1) {
            for x in SAMPLES * column..SAMPLES * (column + 1) {
                let sample = samples[y * columns + x];
                if sample.triangle != NOTHING {
                    collect(&mut pieces, see(soup, camera, corners, sample, [x, y + top]), camera);
                }
            }
        }
        let covered: f32 = pieces.iter().map(|p| p.count).sum();
        let empty = (SAMPLES * SAMPLES) as f32 - covered;
        let mut sum = Vec3::ZERO;
        for piece in &pieces {
            sum += piece.count * surface(soup, camera, studio, piece);
        }
        if empty > 0.0 {
            let at = Vec2::new(column as f32 + 0.5, (first_row + row) as f32 + 0.5);
            sum += empty * background(camera, studio, at);
        }
        pixel.copy_from_slice(&colour::bytes(sum / (SAMPLES * SAMPLES) as f32));
    }
}

/// The surface at one sample.
fn see(soup: &Soup, camera: &Camera, corners: &[Corner], sample: Sample, cell: [usize; 2]) -> Piece {
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

/// Light that a piece of surface sends to the camera.
fn surface(soup: &Soup, camera: &Camera, studio: &Studio, piece: &Piece) -> Vec3 {
    let material = &soup.materials[piece.material as usize];
    let own = colour::linear(if piece.outside { material.outside } else { material.inside });
    let toward = camera.axes.toward;
    // Smooth normals near the outline can point away from the camera, though the surface is seen.
    let mean = piece.normal.normalize_or(toward);
    let normal = (mean + toward * (-mean.dot(toward)).max(0.0)).normalize_or(toward);
    let light = studio.light(piece.point / piece.count, normal);

    // Where light is blocked, what blocks it is lit too and reflects some of it, in about the same colour.
    let reflected = own * 0.35 * (light.open - light.arriving);
    let diffuse = own * (light.arriving + reflected);
    let grazing = 1.0 - normal.dot(toward).clamp(0.0, 1.0);
    let sheen = match material.look {
        Look::Cloth => 0.30 * grazing.powi(2),
        Look::Skin => 0.06 * grazing.powi(4),
    };
    shoulder(diffuse + sheen * light.arriving * own.lerp(Vec3::ONE, 0.4))
}

/// Leaves dark and middle tones and rolls off bright ones, so that lit cloth keeps its folds.
fn shoulder(light: Vec3) -> Vec3 {
    const KNEE: f32 = 0.6;
    Vec3::from(light.to_array().map(|v| {
        let over = (v - KNEE).max(0.0) / (1.0 - KNEE);
        v.min(KNEE) + (1.0 - KNEE) * over / (1.0 + over)
    }))
}

/// Wall and floor at a pixel, with the shadow that the scene throws on the floor.
fn background(camera: &Camera, studio: &Studio, pixel: Vec2) -> Vec3 {
    let down = pixel.y / camera.height as f32;
    let aside = (pixel.x / camera.width as f32 - 0.5).abs();
    let paper = Vec3::new(0.80, 0.81, 0.83).lerp(Vec3::new(0.90, 0.90, 0.90), down) * (1.0 - 0.12 * aside * aside);

    let toward = camera.axes.toward;
    let on_plane = camera.unproject(pixel);
    let floor = on_plane + toward * ((studio.floor - on_plane.y) / toward.y);
    // Shadows fade out before the shadow maps end.
    let fade = 1.0 - (floor.x.hypot(floor.z) / 1.6).clamp(0.0, 1.0).powi(2);
    if fade == 0.0 {
        return paper;
    }
    paper * Vec3::ONE.lerp(studio.floor_visibility(floor), 0.75 * fade)
}
