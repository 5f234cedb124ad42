//! Pictures side by side, and as files.

use super::PictureError;
use image::codecs::png::PngEncoder;
use image::{GenericImage, ImageError, RgbImage};
use std::io::{BufWriter, Write};
use std::path::Path;

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

/// Writes a picture as PNG. The file appears complete or not at all.
///
/// # Errors
/// [`PictureError::Write`] with the path, for example when the directory does not exist.
pub fn save_png(path: &Path, image: &RgbImage) -> Result<(), PictureError> {
    write(path, image).map_err(|source| PictureError::Write { path: path.to_owned(), source })
}

fn write(path: &Path, image: &RgbImage) -> Result<(), ImageError> {
    let directory = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    // Temporary files are private by default; this one is to have the rights of any new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.prefix(".picture").suffix(".png").tempfile_in(directory)?;
    let mut writer = BufWriter::new(&file);
    image.write_with_encoder(PngEncoder::new(&mut writer))?;
    writer.flush()?;
    drop(writer);
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}
