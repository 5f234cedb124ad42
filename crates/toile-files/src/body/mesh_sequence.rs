//! Bodies that move: a folder of OBJ files, one per frame.

use crate::body::moving_body::MovingBodyFile;
use crate::body::obj;
use crate::body::soup::{Cleaned, Soup};
use crate::body::{BodyOptions, size};
use crate::error::{Fault, FileError, Found, Place};
use crate::format;
use crate::source;
use crate::unread::Unread;
use glam::{DVec3, Vec3};
use std::path::{Path, PathBuf};
use toile_scene::{Mesh, MeshSequence, Motion, MovingMesh};

/// Reads a body that moves from the OBJ files of a folder, in the order of their names, so many frames per second [1/s].
///
/// The first file is cleaned as a body at rest is, and the others follow it vertex by vertex. Normals are those of the
/// triangles, weighted by area. Of the options only the unit counts.
///
/// # Errors
///
/// [`FileError`] as of [`read_body`](crate::read_body) for the first file that has a fault; also when the folder has no OBJ
/// file, or a file has other vertices or faces than the first one.
///
/// # Panics
///
/// When the frame rate is not positive.
pub fn read_mesh_sequence(folder: &Path, frame_rate: f64, options: &BodyOptions) -> Result<MovingBodyFile, FileError> {
    assert!(frame_rate > 0.0, "the frame rate is positive");
    assert!(options.metres_per_unit > 0.0, "the length of a unit is positive");
    let paths = obj_paths(folder)?;
    let Some((first, others)) = paths.split_first() else {
        return Err(Found::malformed(Place::File, "the folder has no .obj file").in_file(folder));
    };
    let at_first = |found: Found| found.in_file(first);
    let mut unread = Unread::default();
    let mut soup = read_soup(first, &mut unread)?;
    // The faces as the files give them, which all must share.
    let (faces, vertex_count) = (soup.triangles.clone(), soup.positions.len());
    soup.normals.fill(DVec3::ZERO);
    let mut warnings: Vec<String> = Vec::new();
    let cleaned = soup.clean(options.metres_per_unit, &mut warnings).map_err(at_first)?;
    size::check(&cleaned.mesh, options.metres_per_unit).map_err(at_first)?;
    let mut frames = vec![[cleaned.mesh.positions.clone(), cleaned.mesh.normals.clone()]];
    let mut torn = vec![false; vertex_count];
    for path in others {
        let soup = read_soup(path, &mut unread)?;
        check_same(&soup, &faces, vertex_count, first).map_err(|found| found.in_file(path))?;
        let frame = follow(&soup, &cleaned, options.metres_per_unit, &mut torn).map_err(|found| found.in_file(path))?;
        frames.push(frame);
    }
    warnings.extend(unread.sentences());
    let torn = torn.into_iter().filter(|torn| *torn).count();
    if torn > 0 {
        warnings.push(format!(
            "vertices that start at the place of another one and leave it, which is not followed: {torn}"
        ));
    }
    let motion = Motion::Sequence(MeshSequence { frame_rate, frames });
    Ok(MovingBodyFile { body: MovingMesh { mesh: cleaned.mesh, motion }, warnings })
}

fn read_soup(path: &Path, unread: &mut Unread) -> Result<Soup, FileError> {
    let bytes = source::read_bytes(path)?;
    let soup = format::of_body(&bytes, path, ".obj").and_then(|_| obj::read(&bytes, unread));
    soup.map_err(|found| found.in_file(path))
}

fn check_same(soup: &Soup, faces: &[[u32; 3]], vertex_count: usize, first: &Path) -> Result<(), Found> {
    let name = first.file_name().unwrap_or_default().to_string_lossy();
    let differs = |what: String| Err(Found::malformed(Place::File, format!("{what}; a sequence moves one mesh")));
    if soup.positions.len() != vertex_count {
        return differs(format!("it has {} vertices and {name} has {vertex_count}", soup.positions.len()));
    }
    if soup.triangles != faces {
        return differs(format!("its faces are not those of {name}"));
    }
    Ok(())
}

/// Positions [m] and normals of the clean vertices in a later frame; marks those that leave the vertex they were welded to.
fn follow(soup: &Soup, cleaned: &Cleaned, metres_per_unit: f64, torn: &mut [bool]) -> Result<[Vec<Vec3>; 2], Found> {
    let position = |vertex: usize| (soup.positions[vertex] * metres_per_unit).as_vec3();
    let positions: Vec<Vec3> = cleaned.origins.iter().map(|origin| position(*origin as usize)).collect();
    if let Some(broken) = positions.iter().find(|position| !position.is_finite()) {
        return Err(Fault::NotFinite(format!("the position {broken:?} m")).into());
    }
    for (vertex, kept) in cleaned.kept.iter().enumerate() {
        torn[vertex] |= kept.is_some_and(|kept| position(vertex) != positions[kept as usize]);
    }
    let mesh = Mesh { positions, normals: Vec::new(), triangles: cleaned.mesh.triangles.clone() };
    let normals = mesh.area_weighted_normals();
    Ok([mesh.positions, normals])
}

fn obj_paths(folder: &Path) -> Result<Vec<PathBuf>, FileError> {
    let refuse = |error| Found::from(Fault::Unreadable(error)).in_file(folder);
    let mut paths = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(refuse)? {
        let path = entry.map_err(refuse)?.path();
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj")) {
            paths.push(path);
        }
    }
    paths.sort();
    Ok(paths)
}
