//! Bodies that move: from glTF and GLB files with a clip, or from a folder of OBJ files.

use crate::body::gltf_body;
use crate::body::gltf_rig::ClipChoice;
use crate::body::{BodyOptions, size};
use crate::error::{Fault, FileError, Found};
use crate::format::{self, BodyFormat};
use crate::source;
use crate::unread::Unread;
use std::path::Path;
use toile_scene::{Motion, MovingMesh};

/// A moving body as it was read.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct MovingBodyFile {
    /// The body: its mesh is the one that [`read_body`](crate::read_body) gives at time 0 of the clip.
    pub body: MovingMesh,
    /// What is unusual about it or had to be mended; see [`BodyFile::warnings`](crate::BodyFile::warnings).
    pub warnings: Vec<String>,
}

/// Reads a body that moves with a clip of a glTF or GLB file: the named one of the options, else the first.
///
/// The mesh is cleaned as it stands at time 0 of the clip, and the clip starts at time 0; [`BodyOptions::time`] is ignored.
///
/// # Errors
///
/// As [`read_body`](crate::read_body); also when the file is of another format or has no clip.
pub fn read_moving_body(path: &Path, options: &BodyOptions) -> Result<MovingBodyFile, FileError> {
    let bytes = source::read_bytes(path)?;
    read(&bytes, path, path.parent(), options).map_err(|found| found.in_file(path))
}

/// Reads a moving body from bytes; the ending of the name says the format. The file must bring its buffers along.
///
/// # Errors
///
/// As [`read_moving_body`].
pub fn parse_moving_body(bytes: &[u8], name: &str, options: &BodyOptions) -> Result<MovingBodyFile, FileError> {
    read(bytes, Path::new(name), None, options).map_err(|found| found.in_file(name))
}

fn read(bytes: &[u8], name: &Path, folder: Option<&Path>, options: &BodyOptions) -> Result<MovingBodyFile, Found> {
    assert!(options.metres_per_unit > 0.0, "the length of a unit is positive");
    match format::of_body(bytes, name, ".gltf, .glb, .vrm")? {
        BodyFormat::Gltf => {}
        BodyFormat::Obj | BodyFormat::Ply => {
            let ending = name.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
            let what = format!("the motion of a .{ending} file, which has none (a .gltf or .glb file can have clips),");
            return Err(Fault::Unsupported(what).into());
        }
    }
    let choice = options.clip.as_deref().map_or(ClipChoice::First, ClipChoice::Named);
    let mut unread = Unread::default();
    let mut surface = gltf_body::read(bytes, folder, choice, 0.0, options.metres_per_unit, &mut unread)?;
    let mut warnings: Vec<String> = unread.sentences().collect();
    let cleaned = std::mem::take(&mut surface.soup).clean(options.metres_per_unit, &mut warnings)?;
    size::check(&cleaned.mesh, options.metres_per_unit)?;
    let torn = surface.torn_count(&cleaned);
    if torn > 0 {
        warnings.push(format!("vertices that follow another one of the same place, which hangs differently: {torn}"));
    }
    let skin = surface.skin_of(&cleaned);
    let body = MovingMesh { mesh: cleaned.mesh, motion: Motion::Skinned { skin, rig: surface.rig } };
    Ok(MovingBodyFile { body, warnings })
}
