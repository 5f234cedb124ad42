//! The motion of garments as files that Blender and Houdini open: USD text and PC2 point caches.

use crate::error::{Fault, FileError, Found};
use crate::out::write::temporary_beside;
use glam::Vec3;
use std::io::{BufWriter, Write};
use std::path::Path;

/// The faces of a mesh that moves.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct MovingFaces<'a> {
    /// Name, such as that of the garment.
    pub name: &'a str,
    /// Vertex indices of each triangle, counter-clockwise seen from outside.
    pub triangles: &'a [[u32; 3]],
    /// Linear colour, red, green and blue, 0 to 1.
    pub colour: [f32; 3],
}

impl<'a> MovingFaces<'a> {
    /// Faces with a name and a linear colour, 0 to 1.
    pub fn new(name: &'a str, triangles: &'a [[u32; 3]], colour: [f32; 3]) -> Self {
        Self { name, triangles, colour }
    }
}

/// Writes meshes that move as USD text: one mesh each with points at every frame [m], y up, frame k at time code k.
/// `points(mesh, frame)` gives the positions.
///
/// # Errors
///
/// That of `points`, and [`FileError`] when a position is not finite, or the operating system refuses; then no file is left behind.
///
/// # Panics
///
/// When a triangle has a vertex beyond the positions.
pub fn write_usda<E: From<FileError>>(
    path: &Path,
    meshes: &[MovingFaces<'_>],
    frame_count: usize,
    frame_rate: f64,
    points: impl FnMut(usize, usize) -> Result<Vec<Vec3>, E>,
) -> Result<(), E> {
    write_streamed(path, |out| usda(out, meshes, frame_count, frame_rate, points))
}

/// Writes the motion of one mesh as a PC2 point cache [m], y up: in Blender's Mesh Cache modifier choose forward −Z, up Y
/// for a mesh that was imported with these axes. `points(frame)` gives the positions, `point_count` of them.
///
/// # Errors
///
/// As [`write_usda`].
///
/// # Panics
///
/// When a frame has another number of positions.
pub fn write_pc2<E: From<FileError>>(
    path: &Path,
    point_count: usize,
    frame_count: usize,
    mut points: impl FnMut(usize) -> Result<Vec<Vec3>, E>,
) -> Result<(), E> {
    write_streamed(path, |out| {
        let mut header = b"POINTCACHE2\0".to_vec();
        header.extend(1i32.to_le_bytes());
        header.extend((point_count as i32).to_le_bytes());
        // Start frame and frames per sample.
        header.extend(0f32.to_le_bytes());
        header.extend(1f32.to_le_bytes());
        header.extend((frame_count as i32).to_le_bytes());
        out.write_all(&header).map_err(Failure::Io)?;
        for frame in 0..frame_count {
            let points = points(frame).map_err(Failure::Caller)?;
            check(&points, point_count, "the point cache", frame)?;
            let bytes: Vec<u8> = points.iter().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes).collect();
            out.write_all(&bytes).map_err(Failure::Io)?;
        }
        Ok(())
    })
}

/// Why writing ended early.
enum Failure<E> {
    Io(std::io::Error),
    Caller(E),
    Found(Found),
}

fn write_streamed<E: From<FileError>>(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> Result<(), Failure<E>>,
) -> Result<(), E> {
    let refuse = |error| E::from(Found::from(Fault::Unwritable(error)).in_file(path));
    let file = temporary_beside(path).map_err(refuse)?;
    let mut out = BufWriter::new(file);
    write(&mut out).map_err(|failure| match failure {
        Failure::Io(error) => refuse(error),
        Failure::Caller(error) => error,
        Failure::Found(found) => found.in_file(path).into(),
    })?;
    let file = out.into_inner().map_err(|error| refuse(error.into_error()))?;
    file.persist(path).map_err(|error| refuse(error.error))?;
    Ok(())
}

fn check<E>(points: &[Vec3], count: usize, name: &str, frame: usize) -> Result<(), Failure<E>> {
    assert_eq!(points.len(), count, "{name} has as many points in every frame");
    match points.iter().position(|point| !point.is_finite()) {
        None => Ok(()),
        Some(vertex) => {
            Err(Failure::Found(Fault::NotFinite(format!("position {vertex} of {name} in frame {frame}")).into()))
        }
    }
}

fn usda<E>(
    out: &mut dyn Write,
    meshes: &[MovingFaces<'_>],
    frame_count: usize,
    frame_rate: f64,
    mut points: impl FnMut(usize, usize) -> Result<Vec<Vec3>, E>,
) -> Result<(), Failure<E>> {
    let io = Failure::Io;
    let last = frame_count.saturating_sub(1);
    writeln!(
        out,
        "#usda 1.0\n(\n    defaultPrim = \"World\"\n    doc = \"toile\"\n    endTimeCode = {last}\n    framesPerSecond = {frame_rate}\n    \
         metersPerUnit = 1\n    startTimeCode = 0\n    timeCodesPerSecond = {frame_rate}\n    upAxis = \"Y\"\n)\n\ndef Xform \"World\"\n{{"
    )
    .map_err(io)?;
    for (index, mesh) in meshes.iter().enumerate() {
        let vertex_count = mesh.triangles.iter().flatten().max().map_or(0, |most| *most as usize + 1);
        let counts = vec!["3"; mesh.triangles.len()].join(", ");
        let indices: Vec<String> = mesh.triangles.iter().flatten().map(u32::to_string).collect();
        let [red, green, blue] = mesh.colour;
        writeln!(
            out,
            "    def Mesh \"{}\"\n    {{\n        uniform bool doubleSided = 1\n        int[] faceVertexCounts = [{counts}]\n        \
             int[] faceVertexIndices = [{}]\n        color3f[] primvars:displayColor = [({red}, {green}, {blue})]\n        \
             uniform token subdivisionScheme = \"none\"",
            identifier(mesh.name, index),
            indices.join(", ")
        )
        .map_err(io)?;
        let mut extents = Vec::with_capacity(frame_count);
        writeln!(out, "        point3f[] points.timeSamples = {{").map_err(io)?;
        for frame in 0..frame_count {
            let points = points(index, frame).map_err(Failure::Caller)?;
            check(&points, points.len().max(vertex_count), mesh.name, frame)?;
            let start = [Vec3::INFINITY, Vec3::NEG_INFINITY];
            extents.push(points.iter().fold(start, |[low, high], p| [low.min(*p), high.max(*p)]));
            let text: Vec<String> = points.iter().map(|p| triple(*p)).collect();
            writeln!(out, "            {frame}: [{}],", text.join(", ")).map_err(io)?;
        }
        writeln!(out, "        }}\n        float3[] extent.timeSamples = {{").map_err(io)?;
        for (frame, [low, high]) in extents.into_iter().enumerate() {
            writeln!(out, "            {frame}: [{}, {}],", triple(low), triple(high)).map_err(io)?;
        }
        writeln!(out, "        }}\n    }}").map_err(io)?;
    }
    writeln!(out, "}}").map_err(io)
}

fn triple(p: Vec3) -> String {
    format!("({}, {}, {})", p.x, p.y, p.z)
}

/// A name as USD allows it, unique by its number.
fn identifier(name: &str, index: usize) -> String {
    let clean: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    format!("cloth_{index}_{clean}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(frame: usize) -> Vec<Vec3> {
        vec![Vec3::ZERO, Vec3::X, Vec3::new(0.1, 1.0, frame as f32 * 0.5)]
    }

    fn given(points: Vec<Vec3>) -> Result<Vec<Vec3>, FileError> {
        Ok(points)
    }

    #[test]
    fn a_point_cache_holds_every_frame() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("cloth.pc2");
        write_pc2(&path, 3, 2, |frame| given(points(frame))).expect("written");
        let bytes = std::fs::read(&path).expect("there");
        assert_eq!(&bytes[..12], b"POINTCACHE2\0");
        assert_eq!(bytes.len(), 32 + 2 * 3 * 12);
        let word = |at: usize| <[u8; 4]>::try_from(&bytes[at..at + 4]).expect("four bytes");
        assert_eq!([12, 16, 28].map(|at| i32::from_le_bytes(word(at))), [1, 3, 2]);
        assert_eq!(f32::from_le_bytes(word(32 + 36 + 32)), 0.5, "z of the third point in the second frame");
    }

    #[test]
    fn usd_text_has_points_and_extent_at_every_frame() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("walk.usda");
        let meshes = [MovingFaces { name: "my skirt", triangles: &[[0, 1, 2]], colour: [0.5, 0.25, 1.0] }];
        write_usda(&path, &meshes, 2, 30.0, |_, frame| given(points(frame))).expect("written");
        insta::assert_snapshot!(std::fs::read_to_string(&path).expect("there"));
    }

    #[test]
    fn a_position_that_is_no_number_leaves_nothing_behind() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("walk.usda");
        let meshes = [MovingFaces { name: "skirt", triangles: &[[0, 1, 2]], colour: [0.5; 3] }];
        let broken = |frame: usize| if frame == 1 { vec![Vec3::NAN; 3] } else { points(frame) };
        let error =
            write_usda(&path, &meshes, 2, 30.0, |_, frame| given(broken(frame))).expect_err("not finite").to_string();
        assert!(error.ends_with("position 0 of skirt in frame 1 is not a finite number"), "{error}");
        let error =
            write_pc2(&folder.path().join("a.pc2"), 3, 2, |frame| given(broken(frame))).expect_err("not finite");
        assert!(error.to_string().contains("frame 1"), "{error}");
        assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 0);
    }
}
