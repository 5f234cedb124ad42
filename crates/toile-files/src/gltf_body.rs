//! The surface of a posed glTF file: every mesh of the scene, skinned meshes bent by their joints.

use crate::body::BodyOptions;
use crate::error::{Fault, Found, Place};
use crate::gltf_file::GltfFile;
use crate::gltf_pose::world_transforms;
use crate::soup::Soup;
use glam::{DMat4, DVec3, Mat4, Vec3};
use gltf::Semantic;
use gltf::accessor::Dimensions;
use gltf::mesh::Mode;
use std::path::Path;

/// No body has more vertices or triangles. Nodes can repeat a mesh, so a small file can ask for any number.
const MOST: usize = 1 << 23;

/// Reads the surface at the clip and time of the options. Positions stay in the file's unit.
pub(crate) fn read(
    bytes: &[u8],
    folder: Option<&Path>,
    options: &BodyOptions,
    warnings: &mut Vec<String>,
) -> Result<Soup, Found> {
    let file = GltfFile::open(bytes, folder)?;
    let world = world_transforms(&file, options.clip.as_deref(), options.time)?;
    let mut soup = Soup::default();
    let mut morphs = 0;
    for node in scene_nodes(&file.document) {
        let Some(mesh) = node.mesh() else { continue };
        let joints = node.skin().map(|skin| joint_matrices(&file, &skin, &world)).transpose()?;
        for primitive in mesh.primitives() {
            morphs += primitive.morph_targets().count();
            let placed = Placed { world: world[node.index()], joints: joints.as_deref() };
            add_primitive(&file, &primitive, &placed, &mut soup)?;
        }
    }
    if morphs > 0 {
        warnings.push(format!("morph targets not used: {morphs}"));
    }
    Ok(soup)
}

/// The nodes of the default scene, else of the first one, else of the file; parents first.
fn scene_nodes(document: &gltf::Document) -> Vec<gltf::Node<'_>> {
    let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) else {
        return document.nodes().collect();
    };
    let mut seen = vec![false; document.nodes().count()];
    let mut open: Vec<_> = scene.nodes().collect();
    let mut nodes = Vec::new();
    while let Some(node) = open.pop() {
        if !std::mem::replace(&mut seen[node.index()], true) {
            open.extend(node.children());
            nodes.push(node);
        }
    }
    nodes
}

/// For each joint the matrix from the bind pose of the mesh to the world.
fn joint_matrices(file: &GltfFile, skin: &gltf::Skin<'_>, world: &[DMat4]) -> Result<Vec<DMat4>, Found> {
    let joints: Vec<usize> = skin.joints().map(|joint| joint.index()).collect();
    let Some(accessor) = skin.inverse_bind_matrices() else {
        return Ok(joints.iter().map(|joint| world[*joint]).collect());
    };
    let inverse_bind = file.read::<16>(&accessor, Dimensions::Mat4)?;
    if inverse_bind.len() < joints.len() {
        let message = format!("{} matrices for {} joints", inverse_bind.len(), joints.len());
        return Err(Found::malformed(Place::Accessor(accessor.index()), message));
    }
    let matrix = |(joint, bind): (&usize, &[f32; 16])| world[*joint] * Mat4::from_cols_array(bind).as_dmat4();
    Ok(joints.iter().zip(&inverse_bind).map(matrix).collect())
}

/// How a mesh stands in the world.
struct Placed<'a> {
    world: DMat4,
    /// The node's own transform does not count for a skinned mesh.
    joints: Option<&'a [DMat4]>,
}

fn add_primitive(
    file: &GltfFile,
    primitive: &gltf::Primitive<'_>,
    placed: &Placed<'_>,
    soup: &mut Soup,
) -> Result<(), Found> {
    if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(());
    }
    let Some(accessor) = primitive.get(&Semantic::Positions) else {
        return Ok(());
    };
    let positions = file.read::<3>(&accessor, Dimensions::Vec3)?;
    let first = soup.positions.len();
    check_most("vertices", first + positions.len())?;
    let matrices = match placed.joints {
        Some(joints) => Some(skin_matrices(file, primitive, joints, positions.len())?),
        None => None,
    };
    let matrix = |vertex: usize| matrices.as_ref().map_or(placed.world, |matrices| matrices[vertex]);
    let place = || Place::Accessor(accessor.index());
    for (vertex, position) in positions.iter().enumerate() {
        let position = matrix(vertex).transform_point3(Vec3::from(*position).as_dvec3());
        soup.push_vertex(position, place)?;
    }
    if let Some(accessor) = primitive.get(&Semantic::Normals) {
        let normals = file.read::<3>(&accessor, Dimensions::Vec3)?;
        for (vertex, normal) in normals.iter().enumerate().take(positions.len()) {
            soup.normals[first + vertex] = turned(matrix(vertex), Vec3::from(*normal).as_dvec3());
        }
    }
    add_triangles(file, primitive, positions.len(), soup)
}

/// A normal under a linear map that need not keep angles. The cofactors stand for the inverse transpose, which a flattened
/// limb would not have.
fn turned(matrix: DMat4, normal: DVec3) -> DVec3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
    let turned = y.cross(z) * normal.x + z.cross(x) * normal.y + x.cross(y) * normal.z;
    turned.normalize_or_zero()
}

/// For each vertex the mean of its joints' matrices by weight.
fn skin_matrices(
    file: &GltfFile,
    primitive: &gltf::Primitive<'_>,
    joints: &[DMat4],
    vertex_count: usize,
) -> Result<Vec<DMat4>, Found> {
    let mut sums = vec![(DMat4::ZERO, 0.0); vertex_count];
    let mut place = Place::File;
    for set in 0.. {
        let (Some(indices), Some(weights)) =
            (primitive.get(&Semantic::Joints(set)), primitive.get(&Semantic::Weights(set)))
        else {
            break;
        };
        place = Place::Accessor(weights.index());
        let joint_place = Place::Accessor(indices.index());
        let indices = file.read_indices::<4>(&indices, Dimensions::Vec4)?;
        let weights = file.read::<4>(&weights, Dimensions::Vec4)?;
        for (sum, (indices, weights)) in sums.iter_mut().zip(indices.iter().zip(&weights)) {
            for (index, weight) in indices.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
                let Some(joint) = joints.get(*index as usize) else {
                    let (index, count) = (i64::from(*index), joints.len());
                    let fault = Fault::OutOfRange { what: "joint", index, count };
                    return Err(Found::at(joint_place, fault));
                };
                sum.0 += *joint * f64::from(*weight);
                sum.1 += f64::from(*weight);
            }
        }
    }
    if let Some(vertex) = sums.iter().position(|(_, weight)| !(*weight > 0.0 && weight.is_finite())) {
        return Err(Found::malformed(place, format!("vertex {vertex} hangs on no joint")));
    }
    Ok(sums.into_iter().map(|(matrix, weight)| matrix * weight.recip()).collect())
}

fn add_triangles(
    file: &GltfFile,
    primitive: &gltf::Primitive<'_>,
    vertex_count: usize,
    soup: &mut Soup,
) -> Result<(), Found> {
    let first = (soup.positions.len() - vertex_count) as u32;
    let (indices, place) = match primitive.indices() {
        Some(accessor) => {
            let indices = file.read_indices::<1>(&accessor, Dimensions::Scalar)?;
            (indices, Place::Accessor(accessor.index()))
        }
        None => ((0..vertex_count as u32).map(|index| [index]).collect(), Place::File),
    };
    if let Some([index]) = indices.iter().find(|[index]| *index as usize >= vertex_count) {
        let (index, count) = (i64::from(*index), vertex_count);
        return Err(Found::at(place, Fault::OutOfRange { what: "vertex", index, count }));
    }
    check_most("triangles", soup.triangles.len() + indices.len() / 3)?;
    let corner = |at: usize| first + indices[at][0];
    let mut push = |a, b, c| soup.triangles.push([corner(a), corner(b), corner(c)]);
    match primitive.mode() {
        Mode::TriangleStrip => {
            (2..indices.len()).for_each(|i| if i % 2 == 0 { push(i - 2, i - 1, i) } else { push(i - 1, i - 2, i) });
        }
        Mode::TriangleFan => (2..indices.len()).for_each(|i| push(0, i - 1, i)),
        _ => (0..indices.len() / 3).for_each(|i| push(3 * i, 3 * i + 1, 3 * i + 2)),
    }
    Ok(())
}

fn check_most(what: &str, count: usize) -> Result<(), Found> {
    if count <= MOST {
        return Ok(());
    }
    Err(Fault::Unsupported(format!("a body of more than {MOST} {what}")).into())
}
