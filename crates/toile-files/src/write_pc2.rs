//! The motion of one mesh as a PC2 point cache.

use crate::error::{Fault, FileError, Found, Place};
use crate::write::stream_atomically;
use glam::Vec3;
use std::io::Write;
use std::path::Path;

/// Writes positions as a PC2 point cache, which Blender's modifier Mesh Cache plays on a mesh with the same vertices.
///
/// `frame` gives the positions [m] of a frame, of shape [vertex_count], the same in all frames. It is asked for each of
/// 0..`frame_count` once, in this order, and no frame is kept. A point cache stores no frame rate: cache frame k plays at
/// scene frame k, so set the scene's frame rate to that of the simulation and Frame Start to where it begins.
///
/// The positions are written as they are, y up. In Blender choose Forward −Z and Up Y where the importer turned the vertices
/// to z up, as that of glTF does; leave Forward Y and Up Z where it turned the object instead, as that of OBJ does.
///
/// # Errors
///
/// [`FileError`] when there is no frame or no vertex, more of them than the format counts, when frames differ in their number
/// of vertices, a position is not finite, or the operating system refuses; and any error of `frame`. The path then holds what
/// it held before.
pub fn write_pc2(
    path: &Path,
    frame_count: usize,
    mut frame: impl FnMut(usize) -> Result<Vec<Vec3>, FileError>,
) -> Result<(), FileError> {
    stream_atomically(path, |out| {
        let mut vertex_count = 0;
        for index in 0..frame_count {
            let positions = frame(index)?;
            if index == 0 {
                vertex_count = positions.len();
                out.write_all(&header(vertex_count, frame_count)?)?;
            }
            check(&positions, vertex_count, index)?;
            for coordinate in positions.iter().flat_map(Vec3::to_array) {
                out.write_all(&coordinate.to_le_bytes())?;
            }
        }
        if frame_count == 0 {
            return Err(Found::malformed(Place::File, "there is no frame to write").into());
        }
        Ok(())
    })
}

/// Signature, version, point count, start frame, frames per sample, sample count.
fn header(vertex_count: usize, frame_count: usize) -> Result<Vec<u8>, Found> {
    if vertex_count == 0 {
        return Err(Found::malformed(Place::File, "the mesh has no vertex to write"));
    }
    let counted = |what: &str, count: usize| {
        i32::try_from(count).map_err(|_| {
            let message = format!("a point cache counts up to {} {what}, and there are {count}", i32::MAX);
            Found::malformed(Place::File, message)
        })
    };
    let mut bytes = b"POINTCACHE2\0".to_vec();
    bytes.extend(1i32.to_le_bytes());
    bytes.extend(counted("vertices", vertex_count)?.to_le_bytes());
    bytes.extend(0f32.to_le_bytes());
    bytes.extend(1f32.to_le_bytes());
    bytes.extend(counted("frames", frame_count)?.to_le_bytes());
    Ok(bytes)
}

fn check(positions: &[Vec3], vertex_count: usize, frame: usize) -> Result<(), Found> {
    if positions.len() != vertex_count {
        let count = positions.len();
        let message =
            format!("frame {frame} has {count} vertices, and frame 0 has {vertex_count}: they must be the same");
        return Err(Found::malformed(Place::File, message));
    }
    match positions.iter().position(|position| !position.is_finite()) {
        Some(vertex) => Err(Fault::NotFinite(format!("position {vertex} of frame {frame}")).into()),
        None => Ok(()),
    }
}
