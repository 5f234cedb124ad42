//! Pictures of meshes, drawn on the CPU so that they also exist on machines without any adapter.
//!
//! A fixed studio: one soft key light, a sky and a floor that light everything around, an orthographic camera. The same
//! input gives the same bytes, whatever the number of threads.

mod camera;
mod caption;
mod colour;
mod file;
mod light;
mod raster;
mod shade;
mod soup;
#[cfg(test)]
mod tests;

pub use caption::caption;
pub use file::{save_gif, save_png, stack, strip};

use camera::Camera;
use glam::Vec3;
use image::RgbImage;
use light::{Shadows, Studio};
use shade::Shot;
use soup::Soup;
use std::path::PathBuf;
use std::sync::Mutex;
use std::thread;
use toile::scene::Mesh;

/// A mesh and what it looks like.
#[derive(Clone, Copy, Debug)]
pub struct Drawn<'a> {
    /// What is drawn.
    pub mesh: &'a Mesh,
    /// What it looks like.
    pub material: Material,
    /// How far what is seen of it stands out from its vertices along their normals [m].
    pub thickness: f32,
}

impl<'a> Drawn<'a> {
    /// A body.
    pub fn body(mesh: &'a Mesh) -> Self {
        Self { mesh, material: Material::SKIN, thickness: 0.0 }
    }

    /// The outer face of a cloth by its place in the order of dressing. It is as far from the particles as these keep from a body: what
    /// stands up between particles by less is under the cloth.
    pub fn cloth(mesh: &'a Mesh, index: usize, thickness: f64) -> Self {
        Self { mesh, material: Material::cloth(index), thickness: thickness as f32 }
    }
}

/// What a surface looks like. Both sides of every triangle are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// sRGB colour of the outside, 0 to 1: where the triangle is counter-clockwise.
    pub outside: [f32; 3],
    /// sRGB colour of the inside, 0 to 1. It should differ plainly, so that a garment that is inside out is seen at once.
    pub inside: [f32; 3],
    /// How it reflects light.
    pub look: Look,
}

impl Material {
    /// A body.
    pub const SKIN: Self = Self { outside: [0.86, 0.72, 0.64], inside: [0.55, 0.25, 0.60], look: Look::Skin };

    /// The cloth of a scene's garment by its place in the order of dressing; colours repeat after the fourth.
    pub fn cloth(index: usize) -> Self {
        const BLUE: [f32; 3] = [0.20, 0.43, 0.62];
        const CREAM: [f32; 3] = [0.87, 0.83, 0.74];
        const GREEN: [f32; 3] = [0.33, 0.50, 0.38];
        const RED: [f32; 3] = [0.66, 0.28, 0.28];
        const ORANGE: [f32; 3] = [0.95, 0.55, 0.15];
        const TEAL: [f32; 3] = [0.10, 0.60, 0.60];
        let sides = [(BLUE, ORANGE), (CREAM, ORANGE), (GREEN, ORANGE), (RED, TEAL)];
        let (outside, inside) = sides[index % sides.len()];
        Self { outside, inside, look: Look::Cloth }
    }

    /// Colour of the outside as files of meshes hold it: linear RGB, 0 to 1.
    pub fn linear_outside(&self) -> [f32; 3] {
        colour::linear(self.outside).to_array()
    }
}

/// How a surface reflects light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Matte with a soft sheen where it turns away from the camera.
    Cloth,
    /// Matte.
    Skin,
}

/// From where a picture is taken. All cameras look down a little, so that the floor is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// From +z: a body that faces +z looks at the camera.
    Front,
    /// From −z.
    Back,
    /// From +x, the left hand of a body that faces +z.
    Side,
    /// From between front and side.
    ThreeQuarter,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// Vertices that are nowhere cannot be drawn, and a picture without them would look like success.
    #[error(
        "no picture drawn: {count} vertices have a non-finite position or normal, the first is vertex {vertex} of mesh \
         {mesh}; look for the step at which the simulation diverged"
    )]
    NonFinite {
        /// Number of vertices with a non-finite position or normal, in all meshes.
        count: usize,
        /// Index of the first mesh that has one.
        mesh: usize,
        /// Index of the first such vertex in that mesh.
        vertex: usize,
    },
    /// No triangle, or all vertices in one point.
    #[error("no picture drawn: the scene has no triangle with an extent")]
    Empty,
    /// The file cannot be written.
    #[error("{}: the picture cannot be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system or the encoder said.
        source: image::ImageError,
    },
}

/// Rows of pixels that one thread draws at a time; bounds the memory of the samples.
const BAND_ROWS: usize = 32;

/// Pictures of all meshes from several sides, `height` pixels high and 0.5 to 2 times as wide.
///
/// They show what stands in a box [m], given by its smallest and largest corner, whose floor is theirs: pictures of boxes of one size have
/// the same scale and size from all sides. Without a box the scale depends on the scene and the height only, so the views can stand side
/// by side. Views of one call share the shadows that the surroundings throw.
///
/// # Errors
/// [`PictureError::NonFinite`] when a vertex has a non-finite position or normal; [`PictureError::Empty`] when there is
/// nothing to see.
///
/// # Panics
/// When `height` is 0, a mesh has not one normal per vertex, or a triangle names a vertex that does not exist.
pub fn render(
    drawn: &[Drawn],
    stage: Option<[Vec3; 2]>,
    views: &[View],
    height: u32,
) -> Result<Vec<RgbImage>, PictureError> {
    assert!(height > 0, "a picture has at least one row");
    let soup = Soup::new(drawn, stage)?;
    let cameras: Vec<Camera> = views.iter().map(|view| Camera::new(&soup, *view, height as usize)).collect();
    let shadows = Shadows::new(&soup, &cameras);
    let picture = |(view, camera): (usize, &Camera)| {
        let studio = Studio::new(&soup, camera, &shadows, view);
        let corners: Vec<_> = soup.positions.iter().map(|p| camera.samples.project(*p)).collect();
        let mut image = RgbImage::new(camera.width as u32, height);
        let shot = Shot { soup: &soup, camera, studio: &studio, corners: &corners };
        let triangles = shot.triangles_of_bands(BAND_ROWS);
        let bands = image.as_mut().chunks_mut(3 * camera.width * BAND_ROWS).zip(&triangles).enumerate();
        in_parallel(bands, |(band, (pixels, triangles))| shot.draw(triangles, band * BAND_ROWS, pixels));
        image
    };
    Ok(cameras.iter().enumerate().map(picture).collect())
}

/// Does every job once, on all cores.
fn in_parallel<T: Send>(jobs: impl Iterator<Item = T> + Send, work: impl Fn(T) + Sync) {
    let jobs = Mutex::new(jobs);
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    // A statement of its own: the lock must be free again while the job is done.
                    let job = jobs.lock().expect("a job does not panic while the list is locked").next();
                    let Some(job) = job else { break };
                    work(job);
                }
            });
        }
    });
}
