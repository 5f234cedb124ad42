//! Meshes as one GLB file.

use crate::error::{FileError, Found, Place};
use crate::out::write::{check_finite, write_atomically};
use glam::Vec3;
use serde_json::{Value, json};
use std::path::Path;
use toile_scene::Mesh;

/// A mesh with the name and colour that a viewer shows.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct NamedMesh<'a> {
    /// Name of node and mesh.
    pub name: &'a str,
    /// The mesh [m], with one normal per vertex and at least one triangle.
    pub mesh: &'a Mesh,
    /// Base colour, linear RGB, 0 to 1.
    pub colour: [f32; 3],
}

impl<'a> NamedMesh<'a> {
    /// A mesh with a name and a linear colour, 0 to 1.
    pub fn new(name: &'a str, mesh: &'a Mesh, colour: [f32; 3]) -> Self {
        Self { name, mesh, colour }
    }
}

// Numbers of the glTF 2.0 specification.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Writes meshes as GLB: for each one node, one mesh with positions, normals and indices, and one material, seen from both
/// sides because cloth has two.
///
/// # Errors
///
/// [`FileError`] when a position or normal is not finite, a mesh has no triangle, all meshes exceed the 4 GB of a GLB, or the
/// operating system refuses.
///
/// # Panics
///
/// If a mesh has not one normal per vertex.
pub fn write_glb(path: &Path, meshes: &[NamedMesh<'_>]) -> Result<(), FileError> {
    let bytes = glb(meshes).map_err(|found| found.in_file(path))?;
    write_atomically(path, &bytes)
}

fn glb(meshes: &[NamedMesh<'_>]) -> Result<Vec<u8>, Found> {
    let mut content = Content::default();
    for named in meshes {
        let subject = format!("mesh \"{}\"", named.name);
        check_finite(&subject, named.mesh)?;
        if named.mesh.triangles.is_empty() {
            return Err(Found::malformed(Place::File, format!("{subject} has no triangle to write")));
        }
        content.add(named);
    }
    let count = meshes.len();
    let mut root = json!({
        "asset": { "version": "2.0", "generator": "toile" },
    });
    if count > 0 {
        root["scene"] = 0.into();
        root["scenes"] = json!([{ "nodes": (0..count).collect::<Vec<_>>() }]);
        root["nodes"] = content.nodes.into();
        root["meshes"] = content.meshes.into();
        root["materials"] = content.materials.into();
        root["accessors"] = content.accessors.into();
        root["bufferViews"] = content.views.into();
        root["buffers"] = json!([{ "byteLength": content.binary.len() }]);
    }
    let mut text = root.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let binary_length = if count > 0 { 8 + content.binary.len() } else { 0 };
    let total = 12 + 8 + text.len() + binary_length;
    let Ok(total) = u32::try_from(total) else {
        let message = format!("a GLB holds 4 GB, and the meshes need {total} bytes");
        return Err(Found::malformed(Place::File, message));
    };
    let mut bytes = Vec::with_capacity(total as usize);
    bytes.extend(b"glTF");
    bytes.extend(2u32.to_le_bytes());
    bytes.extend(total.to_le_bytes());
    bytes.extend((text.len() as u32).to_le_bytes());
    bytes.extend(b"JSON");
    bytes.extend(text);
    if count > 0 {
        bytes.extend((content.binary.len() as u32).to_le_bytes());
        bytes.extend(b"BIN\0");
        bytes.extend(content.binary);
    }
    Ok(bytes)
}

/// The lists of the glTF and the binary chunk. Every value is four bytes, so every view is aligned.
#[derive(Default)]
struct Content {
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    accessors: Vec<Value>,
    views: Vec<Value>,
    binary: Vec<u8>,
}

impl Content {
    fn add(&mut self, named: &NamedMesh<'_>) {
        let index = self.nodes.len();
        let [low, high] = named.mesh.bounds().expect("a mesh with a triangle has vertices");
        let positions = self.add_vectors(&named.mesh.positions, Some([low, high]));
        let normals = self.add_vectors(&named.mesh.normals, None);
        let indices = self.add_indices(&named.mesh.triangles);
        let [red, green, blue] = named.colour;
        self.nodes.push(json!({ "name": named.name, "mesh": index }));
        self.meshes.push(json!({
            "name": named.name,
            "primitives": [{
                "attributes": { "POSITION": positions, "NORMAL": normals },
                "indices": indices,
                "material": index,
                "mode": 4,
            }],
        }));
        self.materials.push(json!({
            "name": named.name,
            "doubleSided": true,
            "pbrMetallicRoughness": {
                "baseColorFactor": [red, green, blue, 1.0],
                "metallicFactor": 0.0,
                "roughnessFactor": 0.9,
            },
        }));
    }

    fn add_vectors(&mut self, vectors: &[Vec3], bounds: Option<[Vec3; 2]>) -> usize {
        let bytes = vectors.iter().flat_map(|vector| vector.to_array()).flat_map(f32::to_le_bytes);
        let view = self.add_view(bytes, ARRAY_BUFFER);
        let mut accessor = json!({
            "bufferView": view, "componentType": FLOAT, "count": vectors.len(), "type": "VEC3",
        });
        if let Some([low, high]) = bounds {
            accessor["min"] = json!(low.to_array());
            accessor["max"] = json!(high.to_array());
        }
        self.add_accessor(accessor)
    }

    fn add_indices(&mut self, triangles: &[[u32; 3]]) -> usize {
        let bytes = triangles.iter().flatten().flat_map(|index| index.to_le_bytes());
        let view = self.add_view(bytes, ELEMENT_ARRAY_BUFFER);
        self.add_accessor(json!({
            "bufferView": view, "componentType": UNSIGNED_INT, "count": 3 * triangles.len(), "type": "SCALAR",
        }))
    }

    fn add_view(&mut self, bytes: impl Iterator<Item = u8>, target: u32) -> usize {
        let start = self.binary.len();
        self.binary.extend(bytes);
        let length = self.binary.len() - start;
        self.views.push(json!({
            "buffer": 0, "byteOffset": start, "byteLength": length, "target": target,
        }));
        self.views.len() - 1
    }

    fn add_accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}
