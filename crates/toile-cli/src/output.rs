//! The files of a run: written to a folder of another name first, so that no half-written result is ever seen.

use crate::interrupt;
use crate::metrics::Metrics;
use crate::picture::{self, Drawn, Material, View};
use crate::progress::Progress;
use anyhow::{Context, Result, bail};
use std::fs;
use std::path::Path;
use toile::files::{NamedMesh, write_atomically, write_glb, write_obj};
use toile::scene::Mesh;

/// Height of the pictures [px].
const PICTURE_HEIGHT: u32 = 1000;

/// A mesh of the result and its name.
#[derive(Clone, Copy)]
pub struct Shown<'a> {
    /// Name of its node in the GLB.
    pub name: &'a str,
    /// The mesh.
    pub mesh: &'a Mesh,
}

/// Views of the pictures, by the names of their files.
const VIEWS: [(&str, View); 4] =
    [("front", View::Front), ("three_quarter", View::ThreeQuarter), ("side", View::Side), ("back", View::Back)];

/// An error when the results could not be written to a folder, or would take the place of another program's: better now than after the run.
/// `told` is the file of the results that tells whose they are. Leaves nothing behind.
pub fn check(folder: &Path, told: &str) -> Result<()> {
    if folder.exists() && !folder.is_dir() {
        bail!("--out {}: it is a file; name a folder", folder.display());
    }
    if fs::read(folder.join(told)).is_ok_and(|bytes| !is_own(&bytes)) {
        bail!("--out {}: its {told} is not of toile, and would be overwritten; name another folder", folder.display());
    }
    let existing = existing(folder);
    // A file without a name, gone when it is closed.
    tempfile::tempfile_in(existing)
        .map(|_| ())
        .with_context(|| format!("--out {}: cannot write to {}", folder.display(), existing.display()))
}

/// Whether a JSON file is one that the program writes: each names its adapter, its rules or its sections.
fn is_own(bytes: &[u8]) -> bool {
    let Ok(value) = serde_json::from_slice::<serde_json::Value>(bytes) else { return false };
    let row = value.get(0).unwrap_or(&value);
    ["adapter", "rule", "sections"].iter().any(|key| row.get(key).is_some())
}

/// Writes files to a folder of another name, and moves them to `folder` once all are there.
pub fn write_whole(folder: &Path, write: impl FnOnce(&Path) -> Result<()>) -> Result<()> {
    let beside = existing(folder);
    let mut builder = tempfile::Builder::new();
    // Temporary folders are private by default; this one becomes the result.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
    let unfinished = builder
        .prefix(".toile-unfinished-")
        .tempdir_in(beside)
        .with_context(|| format!("cannot write to {}", beside.display()))?;
    write(unfinished.path())?;
    interrupt::check()?;
    fs::create_dir_all(folder).with_context(|| format!("cannot create {}", folder.display()))?;
    for entry in fs::read_dir(unfinished.path())? {
        let entry = entry?;
        let target = folder.join(entry.file_name());
        fs::rename(entry.path(), &target).with_context(|| format!("cannot write {}", target.display()))?;
    }
    Ok(())
}

/// The folder itself, or the nearest one above it that exists.
fn existing(folder: &Path) -> &Path {
    folder
        .ancestors()
        .map(|above| if above.as_os_str().is_empty() { Path::new(".") } else { above })
        .find(|above| above.exists())
        .unwrap_or(Path::new("."))
}

/// Writes bodies and cloths, each of these with its thickness [m], the cloths alone, pictures of all, and the metrics.
pub fn write(
    folder: &Path,
    bodies: &[Shown<'_>],
    cloths: &[(Shown<'_>, f64)],
    metrics: &Metrics,
    hides_progress: bool,
) -> Result<()> {
    let mut meshes = Vec::new();
    let mut drawn = Vec::new();
    for Shown { name, mesh } in bodies {
        meshes.push(NamedMesh::new(name, mesh, Material::SKIN.linear_outside()));
        drawn.push(Drawn::body(mesh));
    }
    for (index, (Shown { name, mesh }, thickness)) in cloths.iter().enumerate() {
        meshes.push(NamedMesh::new(name, mesh, Material::cloth(index).linear_outside()));
        drawn.push(Drawn::cloth(mesh, index, *thickness));
    }
    write_glb(&folder.join("dressed.glb"), &meshes)?;
    write_obj(&folder.join("garment.obj"), &joined(cloths))?;
    let progress = Progress::new("pictures", hides_progress);
    interrupt::check()?;
    progress.say("drawing".to_owned());
    let pictures = picture::render(&drawn, None, &VIEWS.map(|(_, view)| view), PICTURE_HEIGHT)?;
    for ((name, _), picture) in VIEWS.iter().zip(&pictures) {
        picture::save_png(&folder.join(format!("{name}.png")), picture)?;
    }
    picture::save_png(&folder.join("all_views.png"), &picture::strip(&pictures))?;
    progress.finish("drawn".to_owned());
    write_atomically(&folder.join("metrics.json"), serde_json::to_string_pretty(metrics)?.as_bytes())?;
    Ok(())
}

/// All cloths as one mesh.
fn joined(cloths: &[(Shown<'_>, f64)]) -> Mesh {
    let mut whole = Mesh::default();
    for (Shown { mesh, .. }, _) in cloths {
        let first = whole.positions.len() as u32;
        whole.positions.extend_from_slice(&mesh.positions);
        whole.normals.extend_from_slice(&mesh.normals);
        whole.triangles.extend(mesh.triangles.iter().map(|t| t.map(|i| i + first)));
    }
    whole
}
