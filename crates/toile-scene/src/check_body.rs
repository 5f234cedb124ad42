//! What the bodies of a scene must be like: vertices that are numbers, triangles of vertices that exist.

use crate::check::{COMPONENTS, UNIT, check_vector};
use crate::{Body, Mesh, Motion, MovingMesh, OutOfRange, RigidMotion, Skin};
use glam::Vec3;
use std::ops::RangeInclusive;

/// Frames of a sequence in a second.
const SEQUENCE_RATES: RangeInclusive<f64> = 1e-3..=1e4;

impl Body {
    /// An error where a number is one that no body has. `name` stands before its name.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number.
    pub fn check(&self, name: &str) -> Result<(), OutOfRange> {
        match self {
            Self::Shape(shape) => shape.check(),
            Self::Mesh(mesh) => mesh.check(name),
            Self::Moving(moving) => moving.check(name),
        }
    }
}

impl Mesh {
    /// An error where a vertex is no place, a triangle has a vertex that does not exist, or normals are not as many as vertices. `name` stands before
    /// its name.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number.
    pub fn check(&self, name: &str) -> Result<(), OutOfRange> {
        check_vertices(&format!("{name}: vertex"), &self.positions)?;
        check_count(&format!("{name}: normals"), self.normals.len(), self.positions.len())?;
        check_vertices(&format!("{name}: normal"), &self.normals)?;
        let count = self.positions.len();
        let corners = self.triangles.iter().enumerate().flat_map(|(at, corners)| corners.map(|corner| (at, corner)));
        check_index(&format!("{name}: vertex of triangle"), corners, count)
    }
}

impl MovingMesh {
    /// As [`Mesh::check`], of the mesh and of what moves it.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number.
    pub fn check(&self, name: &str) -> Result<(), OutOfRange> {
        self.mesh.check(name)?;
        let count = self.mesh.positions.len();
        match &self.motion {
            Motion::Hosted => Ok(()),
            Motion::Skinned { skin, rig } => check_skin(name, skin, [count, rig.joints().len()]),
            Motion::Sequence(sequence) => {
                OutOfRange::check(format!("{name}: frame rate"), sequence.frame_rate, &SEQUENCE_RATES, "1/s")?;
                for (at, [positions, normals]) in sequence.frames.iter().enumerate() {
                    check_count(&format!("{name}: vertices of frame {at}"), positions.len(), count)?;
                    check_count(&format!("{name}: normals of frame {at}"), normals.len(), count)?;
                    check_vertices(&format!("{name}: frame {at}: vertex"), positions)?;
                    check_vertices(&format!("{name}: frame {at}: normal"), normals)?;
                }
                Ok(())
            }
        }
    }
}

impl RigidMotion {
    /// An error where a key is no place or no turn, or comes before the one before it. `name` stands before its name.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first such number.
    pub fn check(&self, name: &str) -> Result<(), OutOfRange> {
        let mut before = *COMPONENTS.start();
        for (at, key) in self.keys.iter().enumerate() {
            OutOfRange::check(format!("{name}: time of key {at}"), key.time, &(before..=*COMPONENTS.end()), "s")?;
            check_vector(&format!("{name}: translation of key {at}"), key.translation, &COMPONENTS, "m")?;
            OutOfRange::check(format!("{name}: rotation of key {at}"), key.rotation.length(), &UNIT, "")?;
            before = key.time;
        }
        Ok(())
    }
}

fn check_skin(name: &str, skin: &Skin, [vertex_count, joint_count]: [usize; 2]) -> Result<(), OutOfRange> {
    check_count(&format!("{name}: vertices of its skin"), skin.positions.len(), vertex_count)?;
    check_count(&format!("{name}: normals of its skin"), skin.normals.len(), vertex_count)?;
    check_vertices(&format!("{name}: bind position"), &skin.positions)?;
    check_vertices(&format!("{name}: bind normal"), &skin.normals)?;
    check_offsets(&format!("{name}: influences"), &skin.influence_offsets, [vertex_count, skin.influences.len()])?;
    let joints = skin.influences.iter().enumerate().map(|(at, influence)| (at, influence.joint));
    check_index(&format!("{name}: joint of influence"), joints, joint_count)?;
    match &skin.morphs {
        None => Ok(()),
        Some(morphs) => {
            let counts = [vertex_count, morphs.displacements.len()];
            check_offsets(&format!("{name}: displacements"), &morphs.offsets, counts)
        }
    }
}

/// Vertices that are places.
fn check_vertices(name: &str, vertices: &[Vec3]) -> Result<(), OutOfRange> {
    let is_place = |vertex: &Vec3| f64::from(vertex.abs().max_element()) <= *COMPONENTS.end() && !vertex.is_nan();
    match vertices.iter().position(|vertex| !is_place(vertex)) {
        Some(at) => check_vector(&format!("{name} {at}"), vertices[at].as_dvec3(), &COMPONENTS, "m"),
        None => Ok(()),
    }
}

/// Rows of vertices, which follow one another to the end of what they have.
fn check_offsets(name: &str, offsets: &[u32], [row_count, value_count]: [usize; 2]) -> Result<(), OutOfRange> {
    check_count(&format!("{name}: offsets"), offsets.len(), row_count + 1)?;
    let mut before = 0;
    for (at, offset) in offsets.iter().enumerate() {
        let range = f64::from(before)..=value_count as f64;
        OutOfRange::check(format!("{name}: offset {at}"), f64::from(*offset), &range, "")?;
        before = *offset;
    }
    Ok(())
}

fn check_count(name: &str, count: usize, expected: usize) -> Result<(), OutOfRange> {
    let expected = expected as f64;
    OutOfRange::check(name, count as f64, &(expected..=expected), "")
}

/// Indices, each with what has it, below a count.
fn check_index(name: &str, mut indices: impl Iterator<Item = (usize, u32)>, count: usize) -> Result<(), OutOfRange> {
    match indices.find(|(_, index)| *index as usize >= count) {
        Some((at, index)) => {
            OutOfRange::check(format!("{name} {at}"), f64::from(index), &(0.0..=count as f64 - 1.0), "")
        }
        None => Ok(()),
    }
}
