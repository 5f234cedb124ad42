//! Bodies from OBJ, PLY, glTF and GLB files.

mod disjoint;
mod fused_floor;
mod gltf_body;
mod gltf_checks;
mod gltf_compressed;
mod gltf_extensions;
mod gltf_file;
mod gltf_json;
pub(crate) mod gltf_rig;
pub(crate) mod mesh_sequence;
pub(crate) mod moving_body;
mod number;
mod obj;
mod obj_lines;
mod pieces;
mod ply;
mod ply_header;
mod ply_values;
mod size;
mod sorting;
mod soup;

use crate::body::gltf_rig::ClipChoice;
use crate::error::{FileError, Found, Place};
use crate::format::{self, BodyFormat};
use crate::source;
use crate::unread::Unread;
use std::path::Path;
use toile_scene::Mesh;

/// The endings that [`read_body`] knows.
const ENDINGS: &str = ".obj, .ply, .gltf, .glb, .vrm";

/// How a body file is read.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BodyOptions {
    /// Length of the file's unit [m], positive: 0.01 for centimetres.
    pub metres_per_unit: f64,
    /// Animation clip of a glTF file whose pose is taken; `None` takes the nodes as they stand (the rest pose), or the first
    /// clip where the body moves.
    pub clip: Option<String>,
    /// Time in the clip [s]; before its first and after its last key the pose stands still. A body that moves starts at 0
    /// whatever this is.
    pub time: f64,
}

impl Default for BodyOptions {
    fn default() -> Self {
        Self { metres_per_unit: 1.0, clip: None, time: 0.0 }
    }
}

/// A body as it was read.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct BodyFile {
    /// The clean mesh [m]: equal positions welded, faces outward, a unit normal at every vertex.
    pub mesh: Mesh,
    /// What is unusual about the body or had to be mended, each with its number. Scans are rarely without.
    pub warnings: Vec<String>,
}

/// Reads a body; the ending of the path says the format.
///
/// # Errors
///
/// [`FileError`] when the file cannot be read, breaks its format, has no triangle, has a coordinate that is not finite or
/// an index without a vertex, lacks the named clip, or is no body's size (0.2 m to 4 m tall, at most 10 m to the sides). A
/// clip or a time is an error where the format or the file has none to choose. Holes, non-manifold edges, repeated or empty triangles and stray
/// vertices are no errors but warnings.
///
/// # Panics
///
/// When `metres_per_unit` is not positive.
pub fn read_body(path: &Path, options: &BodyOptions) -> Result<BodyFile, FileError> {
    let bytes = source::read_bytes(path)?;
    read(&bytes, path, path.parent(), options).map_err(|found| found.in_file(path))
}

/// Reads a body from bytes; the ending of the name says the format. A glTF file must bring its buffers along.
///
/// # Errors
///
/// As [`read_body`].
pub fn parse_body(bytes: &[u8], name: &str, options: &BodyOptions) -> Result<BodyFile, FileError> {
    read(bytes, Path::new(name), None, options).map_err(|found| found.in_file(name))
}

fn read(bytes: &[u8], name: &Path, folder: Option<&Path>, options: &BodyOptions) -> Result<BodyFile, Found> {
    assert!(options.metres_per_unit > 0.0, "the length of a unit is positive");
    if options.clip.is_none() && options.time != 0.0 {
        return Err(Found::malformed(Place::File, "a time is one in a clip: name the clip, or leave the time out"));
    }
    let format = format::of_body(bytes, name, ENDINGS)?;
    let (mut warnings, mut unread) = (Vec::new(), Unread::default());
    let soup = match format {
        BodyFormat::Obj | BodyFormat::Ply if options.clip.is_some() => {
            return Err(Found::malformed(Place::File, "files of its kind have no clips: leave the clip out"));
        }
        BodyFormat::Obj => obj::read(bytes, &mut unread)?,
        BodyFormat::Ply => ply::read(bytes, &mut unread)?,
        BodyFormat::Gltf => {
            let choice = options.clip.as_deref().map_or(ClipChoice::None, ClipChoice::Named);
            gltf_body::read(bytes, folder, choice, options.time, options.metres_per_unit, &mut unread)?.soup
        }
    };
    warnings.extend(unread.sentences());
    let mesh = soup.clean(options.metres_per_unit, &mut warnings)?.mesh;
    size::check(&mesh, options.metres_per_unit)?;
    Ok(BodyFile { mesh, warnings })
}
