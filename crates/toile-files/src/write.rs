//! Files out: whole or not at all.

use crate::error::{Fault, FileError, Found};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use toile_scene::Mesh;

/// Writes bytes under a temporary name beside the path and renames it, so that no reader ever sees half a file.
///
/// # Errors
///
/// [`FileError`] when the operating system refuses.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    stream_atomically(path, |out| Ok(out.write_all(bytes)?))
}

/// What keeps a file from being written piece by piece.
pub(crate) enum Refusal {
    /// The operating system refuses to write.
    System(std::io::Error),
    /// The content cannot be written.
    Content(Found),
    /// The content comes from a file that cannot be used.
    Source(FileError),
}

impl From<std::io::Error> for Refusal {
    fn from(error: std::io::Error) -> Self {
        Self::System(error)
    }
}

impl From<Found> for Refusal {
    fn from(found: Found) -> Self {
        Self::Content(found)
    }
}

impl From<FileError> for Refusal {
    fn from(error: FileError) -> Self {
        Self::Source(error)
    }
}

/// [`write_atomically`] for content that need never be in memory as a whole. A refusal leaves nothing behind.
pub(crate) fn stream_atomically(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&File>) -> Result<(), Refusal>,
) -> Result<(), FileError> {
    let refuse = |error| Found::from(Fault::Unwritable(error)).in_file(path);
    let file = tempfile::NamedTempFile::new_in(folder_of(path)).map_err(refuse)?;
    let mut out = BufWriter::new(file.as_file());
    let written = write(&mut out).and_then(|()| Ok(out.flush()?));
    drop(out);
    written.map_err(|refusal| match refusal {
        Refusal::System(error) => refuse(error),
        Refusal::Content(found) => found.in_file(path),
        Refusal::Source(error) => error,
    })?;
    make_readable(file.as_file()).map_err(refuse)?;
    file.persist(path).map_err(|error| refuse(error.error))?;
    Ok(())
}

/// The folder that holds a path.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// Temporary files belong to their owner alone; what is written for others to see must not.
#[cfg(unix)]
fn make_readable(file: &File) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn make_readable(_: &File) -> std::io::Result<()> {
    Ok(())
}

/// Writes a mesh as OBJ [m] with normals.
///
/// # Errors
///
/// [`FileError`] when a position or normal is not finite, or the operating system refuses.
///
/// # Panics
///
/// If the mesh has not one normal per vertex.
pub fn write_obj(path: &Path, mesh: &Mesh) -> Result<(), FileError> {
    check_finite("the mesh", mesh).map_err(|found| found.in_file(path))?;
    let mut text = Vec::new();
    let written = (|| -> std::io::Result<()> {
        for p in &mesh.positions {
            writeln!(text, "v {} {} {}", p.x, p.y, p.z)?;
        }
        for n in &mesh.normals {
            writeln!(text, "vn {} {} {}", n.x, n.y, n.z)?;
        }
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|index| index + 1);
            writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}")?;
        }
        Ok(())
    })();
    written.expect("a vector takes every byte");
    write_atomically(path, &text)
}

/// Refuses a mesh that no program could show. `name` is the subject of the sentence.
pub(crate) fn check_finite(name: &str, mesh: &Mesh) -> Result<(), Found> {
    assert_eq!(mesh.positions.len(), mesh.normals.len(), "a mesh has one normal per vertex");
    for (what, vectors) in [("position", &mesh.positions), ("normal", &mesh.normals)] {
        if let Some(vertex) = vectors.iter().position(|vector| !vector.is_finite()) {
            let what = format!("{what} {vertex} of {name}");
            return Err(Fault::NotFinite(what).into());
        }
    }
    Ok(())
}
