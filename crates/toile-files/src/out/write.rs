//! Files out: whole or not at all.

use crate::error::{Fault, FileError, Found};
use std::io::Write;
use std::path::Path;
use toile_scene::Mesh;

/// Writes bytes under a temporary name beside the path and renames it, so that no reader ever sees half a file.
///
/// # Errors
///
/// [`FileError`] when the operating system refuses.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let refuse = |error| Found::from(Fault::Unwritable(error)).in_file(path);
    let mut file = temporary_beside(path).map_err(refuse)?;
    file.write_all(bytes).map_err(refuse)?;
    file.persist(path).map_err(|error| refuse(error.error))?;
    Ok(())
}

/// A temporary file beside a path, with the rights of any new file; by default they are private.
pub(crate) fn temporary_beside(path: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    give_usual_rights(&mut builder);
    builder.tempfile_in(folder)
}

#[cfg(unix)]
fn give_usual_rights(builder: &mut tempfile::Builder) {
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
}

/// Other systems know no such rights.
#[cfg(not(unix))]
fn give_usual_rights(_: &mut tempfile::Builder) {}

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
