//! Bodies that move: animated glTF and GLB files, and sequences of OBJ files.

use crate::body::{BodyOptions, check_height};
use crate::error::{Fault, FileError, Found, Place};
use crate::gltf_body::{self, Binding, Posed};
use crate::{obj, source};
use glam::{DVec3, Vec3};
use std::path::{Path, PathBuf};
use toile_scene::{MeshSequence, Morphs, Motion, MovingMesh, Skin};

/// A body that moves, as it was read.
#[derive(Clone, Debug)]
pub struct MovingBodyFile {
    /// The body. Its mesh is the one that [`read_body`](crate::read_body) gives at time 0 of the clip.
    pub body: MovingMesh,
    /// Name of the clip; empty for a sequence.
    pub clip: String,
    /// What is unusual about the body or had to be mended, each with its number.
    pub warnings: Vec<String>,
}

/// Reads an animated body from a glTF or GLB file: the clip of the options, or the first one. The time of the options is not
/// used: the motion begins at time 0 of the clip.
///
/// # Errors
///
/// As [`read_body`](crate::read_body), and when the file has no clip.
pub fn read_moving_body(path: &Path, options: &BodyOptions) -> Result<MovingBodyFile, FileError> {
    let bytes = source::read_bytes(path)?;
    read(&bytes, path, path.parent(), options).map_err(|found| found.in_file(path))
}

/// Reads an animated body from the bytes of a GLB file, or of a glTF file that brings its buffers along.
///
/// # Errors
///
/// As [`read_moving_body`].
pub fn parse_moving_body(bytes: &[u8], name: &str, options: &BodyOptions) -> Result<MovingBodyFile, FileError> {
    read(bytes, Path::new(name), None, options).map_err(|found| found.in_file(name))
}

/// Reads OBJ files, all with the same faces, as the frames of a moving body, `frame_rate` per second.
///
/// # Errors
///
/// As [`read_body`](crate::read_body), and when there is no file or one has other faces than the first.
///
/// # Panics
///
/// When the frame rate is not positive.
pub fn read_mesh_sequence(
    paths: &[PathBuf],
    frame_rate: f64,
    options: &BodyOptions,
) -> Result<MovingBodyFile, FileError> {
    assert!(frame_rate > 0.0, "a sequence has a frame rate");
    let mut warnings = Vec::new();
    let mut first: Option<toile_scene::Mesh> = None;
    let mut frames = Vec::new();
    for path in paths {
        let bytes = source::read_bytes(path)?;
        let in_file = |found: Found| found.in_file(path);
        // What the first frame's warnings say holds for all: their faces are the same.
        let mut more = Vec::new();
        let mesh =
            obj::read(&bytes).and_then(|soup| soup.clean(options.metres_per_unit, &mut more)).map_err(in_file)?;
        match &first {
            None => {
                check_height(&mesh, options.metres_per_unit).map_err(in_file)?;
                warnings = more;
                first = Some(mesh.clone());
            }
            Some(first) if first.triangles != mesh.triangles => {
                let message = format!(
                    "it has other faces than the first file of the sequence: {} triangles on {} vertices, not {} on {}",
                    mesh.triangles.len(),
                    mesh.positions.len(),
                    first.triangles.len(),
                    first.positions.len()
                );
                return Err(in_file(Found::malformed(Place::File, message)));
            }
            Some(_) => {}
        }
        frames.push([mesh.positions, mesh.normals]);
    }
    let Some(mesh) = first else {
        return Err(Found::malformed(Place::File, "a sequence needs at least one OBJ file").in_file(""));
    };
    let motion = Motion::Sequence(MeshSequence { frame_rate, frames });
    Ok(MovingBodyFile { body: MovingMesh { mesh, motion }, clip: String::new(), warnings })
}

fn read(bytes: &[u8], name: &Path, folder: Option<&Path>, options: &BodyOptions) -> Result<MovingBodyFile, Found> {
    assert!(options.metres_per_unit > 0.0, "the length of a unit is positive");
    let ending = name.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
    if !["gltf", "glb"].contains(&ending.as_str()) {
        return Err(Fault::UnknownFormat(".gltf, .glb (bodies that move)").into());
    }
    let clip = match &options.clip {
        Some(clip) => clip.clone(),
        None => gltf_body::clip_names(bytes, folder)?
            .into_iter()
            .next()
            .ok_or_else(|| Found::malformed(Place::File, "the body has no clip, so it cannot move"))?,
    };
    let Posed { soup, bindings, mut rig } = gltf_body::read(bytes, folder, Some(&clip), 0.0)?;
    let mut warnings = Vec::new();
    let (mesh, origins) = soup.clean_with_origins(options.metres_per_unit, &mut warnings)?;
    check_height(&mesh, options.metres_per_unit)?;
    rig.metres_per_unit = options.metres_per_unit;
    let kept: Vec<&Binding> = origins.iter().map(|origin| &bindings[*origin as usize]).collect();
    let skin = skin(&kept, &mesh.normals);
    Ok(MovingBodyFile { body: MovingMesh { mesh, motion: Motion::Skinned { skin, rig } }, clip, warnings })
}

fn skin(bindings: &[&Binding], normals: &[Vec3]) -> Skin {
    let mut skin = Skin {
        positions: bindings.iter().map(|binding| binding.position).collect(),
        influence_offsets: vec![0],
        ..Skin::default()
    };
    let mut morphs = Morphs { offsets: vec![0], displacements: Vec::new() };
    for (binding, normal) in bindings.iter().zip(normals) {
        // The clean normal is that of the pose; a normal goes to the pose by the inverse transpose, so it goes back by the transpose.
        let matrix = binding.matrix;
        let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
        let back = DVec3::from_array(columns.map(|column| column.dot(normal.as_dvec3())));
        skin.normals.push(back.normalize_or(DVec3::Y).as_vec3());
        skin.influences.extend_from_slice(&binding.influences);
        skin.influence_offsets.push(skin.influences.len() as u32);
        morphs.displacements.extend_from_slice(&binding.displacements);
        morphs.offsets.push(morphs.displacements.len() as u32);
    }
    skin.morphs = (!morphs.displacements.is_empty()).then_some(morphs);
    skin
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse_body;
    use toile_scene::Mesh;

    const WOMAN: &[u8] = include_bytes!("../../../fixtures/bodies/walking_woman.glb");

    fn walking(clip: &str) -> MovingMesh {
        let options = BodyOptions { clip: Some(clip.to_owned()), ..BodyOptions::default() };
        parse_moving_body(WOMAN, "woman.glb", &options).expect("the fixture moves").body
    }

    fn farthest(a: &[Vec3], b: &[Vec3]) -> f32 {
        assert_eq!(a.len(), b.len());
        a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
    }

    #[test]
    fn a_moving_body_is_at_any_time_what_the_still_reader_reads() {
        for (clip, duration) in [("walk_loop", 1.1), ("walk_forward_4cycles", 4.4), ("apose_to_walk", 4.8)] {
            let body = walking(clip);
            assert!((body.duration() - duration).abs() < 1e-6, "{clip}: {} s", body.duration());
            for time in [0.0, 0.013, 0.5, 0.987, 1.05] {
                let options = BodyOptions { clip: Some(clip.to_owned()), time, ..BodyOptions::default() };
                let still: Mesh = parse_body(WOMAN, "woman.glb", &options).expect("the fixture is a body").mesh;
                let moved = body.at(time);
                assert_eq!(moved.triangles, still.triangles);
                let far = farthest(&moved.positions, &still.positions);
                assert!(far < 2e-6, "{clip} at {time} s: {far} m");
                // Normals are welded and mended in the pose at time 0 of one, and at this time of the other.
                let alike = moved.normals.iter().zip(&still.normals).filter(|(a, b)| a.dot(**b) > 0.9).count();
                assert!(alike * 100 > 99 * moved.normals.len(), "{clip} at {time} s: {alike} normals");
            }
        }
    }

    #[test]
    fn only_the_loop_is_closed_and_repeats() {
        let closed = walking("walk_loop");
        assert!(closed.is_closed());
        assert!(farthest(&closed.at(0.3).positions, &closed.at(0.3 + 2.0 * closed.duration()).positions) < 1e-4);
        let forward = walking("walk_forward_4cycles");
        assert!(!forward.is_closed());
        assert!(farthest(&forward.at(9.0).positions, &forward.at(4.4).positions) < 1e-6);
    }

    #[test]
    fn a_body_that_cannot_move_is_an_error() {
        let told = |bytes: &[u8], name: &str, clip: Option<&str>| {
            let options = BodyOptions { clip: clip.map(str::to_owned), ..BodyOptions::default() };
            parse_moving_body(bytes, name, &options).expect_err("no moving body").to_string()
        };
        insta::assert_snapshot!(told(b"v 0 0 0", "woman.obj", None), @"");
        insta::assert_snapshot!(told(WOMAN, "woman.glb", Some("fly")), @"");
    }
}
