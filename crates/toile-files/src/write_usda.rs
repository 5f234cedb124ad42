//! The motion of meshes as one USD text file.

use crate::error::{Fault, FileError, Found, Place};
use crate::write::{Refusal, folder_of, stream_atomically};
use glam::Vec3;
use std::collections::HashSet;
use std::io::{BufWriter, Seek, Write};
use std::path::Path;

/// What stays the same of a mesh that moves.
#[derive(Clone, Copy, Debug)]
pub struct NamedMotion<'a> {
    /// Name of the mesh. What a USD name cannot hold becomes `_`, and a name that is taken gets a number.
    pub name: &'a str,
    /// Vertex indices of each triangle, counter-clockwise seen from outside, shape [triangle_count].
    pub triangles: &'a [[u32; 3]],
    /// Colour, linear RGB, 0 to 1.
    pub colour: [f32; 3],
}

/// Writes the motion of meshes as USD text: y up, metres, one time code per frame from 0, `frame_rate` of them per second [1/s];
/// for each mesh points, normals and extent of each frame.
///
/// `frame` gives positions [m] and unit normals, each of shape [vertex_count], of mesh `.0` in frame `.1`. It is asked for each
/// once: mesh by mesh, because so the format wants it, and in each the frames 0..`frame_count` in order. No frame is kept.
///
/// # Errors
///
/// [`FileError`] when there is no frame, the frame rate is not above 0, a mesh has no triangle or one with a vertex that does
/// not exist, frames differ in their number of vertices, a number is not finite, or the operating system refuses; and any error
/// of `frame`. The path then holds what it held before.
pub fn write_usda(
    path: &Path,
    meshes: &[NamedMotion<'_>],
    frame_count: usize,
    frame_rate: f64,
    mut frame: impl FnMut(usize, usize) -> Result<[Vec<Vec3>; 2], FileError>,
) -> Result<(), FileError> {
    stream_atomically(path, |out| {
        write_stage(out, frame_count, frame_rate)?;
        let mut names = HashSet::new();
        for (index, mesh) in meshes.iter().enumerate() {
            let identifier = unique_identifier(mesh.name, &mut names);
            let scratch = tempfile::tempfile_in(folder_of(path))?;
            let motion = MeshMotion { mesh, identifier, frame_count };
            motion.write(out, BufWriter::new(scratch), |time| frame(index, time))?;
        }
        writeln!(out, "}}")?;
        Ok(())
    })
}

fn write_stage(out: &mut impl Write, frame_count: usize, frame_rate: f64) -> Result<(), Refusal> {
    if frame_count == 0 {
        return Err(Found::malformed(Place::File, "there is no frame to write").into());
    }
    if !(frame_rate.is_finite() && frame_rate > 0.0) {
        let message = format!("the frame rate is {frame_rate} and must be above 0");
        return Err(Found::malformed(Place::File, message).into());
    }
    writeln!(out, "#usda 1.0")?;
    writeln!(out, "(")?;
    writeln!(out, "    defaultPrim = \"World\"")?;
    writeln!(out, "    endTimeCode = {}", frame_count - 1)?;
    writeln!(out, "    framesPerSecond = {frame_rate}")?;
    writeln!(out, "    metersPerUnit = 1")?;
    writeln!(out, "    startTimeCode = 0")?;
    writeln!(out, "    timeCodesPerSecond = {frame_rate}")?;
    writeln!(out, "    upAxis = \"Y\"")?;
    writeln!(out, ")")?;
    writeln!(out)?;
    writeln!(out, "def Xform \"World\"")?;
    writeln!(out, "{{")?;
    Ok(())
}

/// A name that USD allows and that is not taken: letters, digits and `_`, no digit first.
fn unique_identifier(name: &str, taken: &mut HashSet<String>) -> String {
    let mut identifier: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if !identifier.starts_with(|first: char| !first.is_ascii_digit()) {
        identifier.insert(0, '_');
    }
    let numbered = (2..).map(|number| format!("{identifier}_{number}"));
    let mut candidates = std::iter::once(identifier.clone()).chain(numbered);
    let free = candidates.find(|candidate| !taken.contains(candidate)).expect("numbers never end");
    taken.insert(free.clone());
    free
}

/// One mesh on its way into the file.
struct MeshMotion<'a> {
    mesh: &'a NamedMotion<'a>,
    identifier: String,
    frame_count: usize,
}

impl MeshMotion<'_> {
    /// Points go straight into the file and normals by way of `scratch`, because an attribute's samples stand together and no
    /// frame is asked for twice.
    fn write(
        &self,
        out: &mut impl Write,
        mut scratch: BufWriter<std::fs::File>,
        mut frame: impl FnMut(usize) -> Result<[Vec<Vec3>; 2], FileError>,
    ) -> Result<(), Refusal> {
        self.write_fixed(out)?;
        let mut extents = Vec::with_capacity(self.frame_count);
        let mut vertex_count = 0;
        writeln!(out, "        point3f[] points.timeSamples = {{")?;
        for time in 0..self.frame_count {
            let [positions, normals] = frame(time)?;
            if time == 0 {
                vertex_count = positions.len();
                self.check_triangles(vertex_count)?;
            }
            self.check_frame(&positions, "positions", "position", vertex_count, time)?;
            self.check_frame(&normals, "normals", "normal", vertex_count, time)?;
            write_sample(out, time, &positions)?;
            write_sample(&mut scratch, time, &normals)?;
            let low = positions.iter().copied().fold(Vec3::INFINITY, Vec3::min);
            let high = positions.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
            extents.push([low, high]);
        }
        writeln!(out, "        }}")?;
        writeln!(out, "        normal3f[] normals (")?;
        writeln!(out, "            interpolation = \"vertex\"")?;
        writeln!(out, "        )")?;
        writeln!(out, "        normal3f[] normals.timeSamples = {{")?;
        let mut scratch = scratch.into_inner().map_err(|error| error.into_error())?;
        scratch.rewind()?;
        std::io::copy(&mut scratch, out)?;
        writeln!(out, "        }}")?;
        writeln!(out, "        float3[] extent.timeSamples = {{")?;
        for (time, extent) in extents.iter().enumerate() {
            write_sample(out, time, extent)?;
        }
        writeln!(out, "        }}")?;
        writeln!(out, "    }}")?;
        Ok(())
    }

    fn write_fixed(&self, out: &mut impl Write) -> Result<(), Refusal> {
        let NamedMotion { triangles, colour: [red, green, blue], .. } = *self.mesh;
        if triangles.is_empty() {
            return Err(Found::malformed(Place::File, format!("{} has no triangle to write", self.subject())).into());
        }
        if ![red, green, blue].iter().all(|value| value.is_finite()) {
            return Err(Found::from(Fault::NotFinite(format!("the colour of {}", self.subject()))).into());
        }
        writeln!(out, "    def Mesh \"{}\"", self.identifier)?;
        writeln!(out, "    {{")?;
        writeln!(out, "        uniform token subdivisionScheme = \"none\"")?;
        writeln!(out, "        uniform bool doubleSided = 1")?;
        writeln!(out, "        color3f[] primvars:displayColor = [({red:?}, {green:?}, {blue:?})] (")?;
        writeln!(out, "            interpolation = \"constant\"")?;
        writeln!(out, "        )")?;
        write!(out, "        int[] faceVertexCounts = [3")?;
        for _ in 1..triangles.len() {
            write!(out, ", 3")?;
        }
        writeln!(out, "]")?;
        write!(out, "        int[] faceVertexIndices = [")?;
        for (number, index) in triangles.iter().flatten().enumerate() {
            write!(out, "{}{index}", if number == 0 { "" } else { ", " })?;
        }
        writeln!(out, "]")?;
        Ok(())
    }

    fn check_triangles(&self, vertex_count: usize) -> Result<(), Found> {
        // USD counts and points with signed 32 bits.
        let count = vertex_count.min(i32::MAX as usize);
        match self.mesh.triangles.iter().flatten().find(|index| **index as usize >= count) {
            Some(index) => Err(Fault::OutOfRange { what: "vertex", index: i64::from(*index), count }.into()),
            None => Ok(()),
        }
    }

    fn check_frame(
        &self,
        vectors: &[Vec3],
        plural: &str,
        singular: &str,
        vertex_count: usize,
        time: usize,
    ) -> Result<(), Found> {
        let subject = self.subject();
        if vectors.len() != vertex_count {
            let count = vectors.len();
            let message = format!(
                "frame {time} of {subject} has {count} {plural}, and its frame 0 has {vertex_count} positions: they must be the same"
            );
            return Err(Found::malformed(Place::File, message));
        }
        match vectors.iter().position(|vector| !vector.is_finite()) {
            Some(vertex) => Err(Fault::NotFinite(format!("{singular} {vertex} of {subject} in frame {time}")).into()),
            None => Ok(()),
        }
    }

    fn subject(&self) -> String {
        format!("mesh \"{}\"", self.mesh.name)
    }
}

/// One time sample. `{:?}` is the shortest text that reads back the same, and short for very large and small numbers too.
fn write_sample(out: &mut impl Write, time: usize, vectors: &[Vec3]) -> std::io::Result<()> {
    write!(out, "            {time}: [")?;
    for (index, v) in vectors.iter().enumerate() {
        write!(out, "{}({:?}, {:?}, {:?})", if index == 0 { "" } else { ", " }, v.x, v.y, v.z)?;
    }
    writeln!(out, "],")
}
