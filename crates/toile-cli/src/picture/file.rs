//! Pictures side by side, and as files.

use super::PictureError;
use image::codecs::gif::{GifEncoder, Repeat};
use image::codecs::png::PngEncoder;
use image::{Delay, Frame, GenericImage, ImageError, RgbImage};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// Effort of the palettes, 1 (best) to 30 (fastest).
const GIF_SPEED: i32 = 20;
/// More pictures per second than this a GIF does not show [1/s].
const GIF_RATE_MAX: f64 = 30.0;
/// A GIF counts in hundredths of a second [1/s].
const GIF_CLOCK: f64 = 100.0;

/// All pictures side by side from left to right, upper edges in line. Lower pictures get white below them.
///
/// # Panics
/// When there is no picture.
pub fn strip(images: &[RgbImage]) -> RgbImage {
    let width = images.iter().map(RgbImage::width).sum();
    let height = images.iter().map(RgbImage::height).max().expect("a strip has at least one picture");
    let mut strip = RgbImage::from_pixel(width, height, image::Rgb([255; 3]));
    let mut left = 0;
    for image in images {
        strip.copy_from(image, left, 0).expect("the strip is as wide and high as its pictures need");
        left += image.width();
    }
    strip
}

/// All pictures one below the other, left edges in line. Narrower pictures get white beside them.
///
/// # Panics
/// When there is no picture.
pub fn stack(images: &[RgbImage]) -> RgbImage {
    let width = images.iter().map(RgbImage::width).max().expect("a stack has at least one picture");
    let height = images.iter().map(RgbImage::height).sum();
    let mut stack = RgbImage::from_pixel(width, height, image::Rgb([255; 3]));
    let mut top = 0;
    for image in images {
        stack.copy_from(image, 0, top).expect("the stack is as wide and high as its pictures need");
        top += image.height();
    }
    stack
}

/// Writes a picture as PNG. The file appears complete or not at all.
///
/// # Errors
/// [`PictureError::Write`] with the path, for example when the directory does not exist.
pub fn save_png(path: &Path, image: &RgbImage) -> Result<(), PictureError> {
    write(path, image).map_err(|source| PictureError::Write { path: path.to_owned(), source })
}

/// Joins pictures on disk to a GIF that repeats. The file appears complete or not at all.
///
/// # Errors
/// [`PictureError::Write`] with the path, when a picture cannot be read or the GIF cannot be written.
pub fn save_gif(path: &Path, pictures: impl Iterator<Item = PathBuf>, frame_rate: f64) -> Result<(), PictureError> {
    write_gif(path, pictures, frame_rate).map_err(|source| PictureError::Write { path: path.to_owned(), source })
}

fn write_gif(path: &Path, pictures: impl Iterator<Item = PathBuf>, frame_rate: f64) -> Result<(), ImageError> {
    let directory = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let file = temporary(".gif").tempfile_in(directory)?;
    {
        let mut encoder = GifEncoder::new_with_speed(BufWriter::new(&file), GIF_SPEED);
        encoder.set_repeat(Repeat::Infinite)?;
        // Fewer pictures rather than a slower walk.
        let stride = (GIF_RATE_MAX.recip() * frame_rate).ceil().max(1.0) as usize;
        let mut size = None;
        for (index, picture) in pictures.step_by(stride).enumerate() {
            let delay = Delay::from_numer_denom_ms(10 * hundredths(index, stride as f64 / frame_rate), 1);
            let image = image::open(&picture)?.to_rgba8();
            let (width, height) = *size.get_or_insert(image.dimensions());
            // Every frame of a GIF has the size of the first.
            let mut frame = image::RgbaImage::from_pixel(width, height, image::Rgba([255; 4]));
            image::imageops::overlay(&mut frame, &image, (i64::from(width) - i64::from(image.width())) / 2, 0);
            encoder.encode_frame(Frame::from_parts(frame, 0, 0, delay))?;
        }
    }
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}

/// How long a picture of a GIF stays, when each is due `seconds` after the one before it. The whole keeps its time: what one picture is
/// rounded by, a later one makes good.
fn hundredths(index: usize, seconds: f64) -> u32 {
    let begins = |index: usize| (GIF_CLOCK * seconds * index as f64).round() as u32;
    begins(index + 1) - begins(index)
}

/// A temporary file with the rights of any new file; by default they are private.
fn temporary(suffix: &'static str) -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.prefix(".picture").suffix(suffix);
    builder
}

fn write(path: &Path, image: &RgbImage) -> Result<(), ImageError> {
    let directory = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let file = temporary(".png").tempfile_in(directory)?;
    let mut writer = BufWriter::new(&file);
    image.write_with_encoder(PngEncoder::new(&mut writer))?;
    writer.flush()?;
    drop(writer);
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::hundredths;

    #[test]
    fn a_moving_picture_keeps_its_time() {
        for rate in [30.0, 24.0, 25.0, 12.5] {
            let delays: Vec<u32> = (0..4 * rate as usize).map(|index| hundredths(index, 1.0 / rate)).collect();
            let seconds = delays.len() as f64 / rate;
            assert!((f64::from(delays.iter().sum::<u32>()) / 100.0 - seconds).abs() < 0.006, "{rate} per second");
            assert!(delays.iter().max() <= delays.iter().min().map(|least| least + 1).as_ref(), "{delays:?}");
        }
    }
}
