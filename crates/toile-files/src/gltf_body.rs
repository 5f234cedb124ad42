//! The surface of a posed glTF file: every mesh of the scene, skinned meshes bent by their joints.

use crate::error::{Fault, Found, Place};
use crate::gltf_file::GltfFile;
use crate::gltf_pose::Skeleton;
use crate::soup::Soup;
use glam::{DMat4, DVec3, Mat4, Vec3};
use gltf::Semantic;
use gltf::accessor::Dimensions;
use gltf::mesh::Mode;
use std::path::Path;
use toile_scene::{Displacement, Influence, Rig};

/// No body has more vertices or triangles. Nodes can repeat a mesh, so a small file can ask for any number.
const MOST: usize = 1 << 23;

/// The surface of a file at one time, and how its vertices hang on the joints.
pub(crate) struct Posed {
    /// The surface in the file's unit.
    pub soup: Soup,
    /// Of each vertex of the soup.
    pub bindings: Vec<Binding>,
    /// The joints, in the file's unit.
    pub rig: Rig,
}

/// How a vertex hangs on the joints.
#[derive(Clone, Debug, Default)]
pub(crate) struct Binding {
    pub position: Vec3,
    pub influences: Vec<Influence>,
    pub displacements: Vec<Displacement>,
    /// From bind space to the world, at the time of the surface.
    pub matrix: DMat4,
}

/// Reads the surface at a clip and time. Positions stay in the file's unit.
pub(crate) fn read(bytes: &[u8], folder: Option<&Path>, clip: Option<&str>, time: f64) -> Result<Posed, Found> {
    let file = GltfFile::open(bytes, folder)?;
    let mut skeleton = Skeleton::read(&file, clip)?;
    skeleton.check(time)?;
    let mut unposed = Vec::new();
    for node in scene_nodes(&file.document) {
        let Some(mesh) = node.mesh() else { continue };
        let joints = match node.skin() {
            Some(skin) => add_skin(&file, &skin, &mut skeleton)?,
            // The node's own transform counts for a mesh without skin only.
            None => vec![skeleton.add_joint(&node, DMat4::IDENTITY)],
        };
        let skinned = node.skin().is_some();
        let targets = mesh.primitives().map(|primitive| primitive.morph_targets().count()).max().unwrap_or(0);
        let first_target = skeleton.rig.morph_weights.len() as u32;
        let weights = node.weights().or(mesh.weights()).unwrap_or_default();
        let weight = |target: usize| weights.get(target).copied().map_or(0.0, f64::from);
        skeleton.rig.morph_weights.extend((0..targets).map(weight));
        if let (Some(clip), true) = (clip, targets > 0) {
            skeleton.read_morph_tracks(&file, clip, &node, first_target, targets)?;
        }
        for primitive in mesh.primitives() {
            unposed.push((primitive, joints.clone(), skinned, first_target));
        }
    }
    let pose = skeleton.rig.pose(time);
    let matrices: Vec<DMat4> = pose_matrices(&skeleton.rig, time);
    let mut posed = Posed { soup: Soup::default(), bindings: Vec::new(), rig: skeleton.rig };
    for (primitive, joints, skinned, first_target) in unposed {
        add_primitive(&file, &primitive, &joints, skinned, first_target, &matrices, &pose.morph_weights, &mut posed)?;
    }
    Ok(posed)
}

/// From bind space to the world for each joint, in f64.
fn pose_matrices(rig: &Rig, time: f64) -> Vec<DMat4> {
    let worlds = rig.worlds(time);
    rig.joints.iter().map(|joint| worlds[joint.node as usize] * joint.inverse_bind).collect()
}

/// Names of the clips of a file, in its order.
pub(crate) fn clip_names(bytes: &[u8], folder: Option<&Path>) -> Result<Vec<String>, Found> {
    let file = GltfFile::open(bytes, folder)?;
    Ok(file.document.animations().filter_map(|animation| animation.name()).map(String::from).collect())
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

/// Adds the joints of a skin and gives their indices.
fn add_skin(file: &GltfFile, skin: &gltf::Skin<'_>, skeleton: &mut Skeleton) -> Result<Vec<u32>, Found> {
    let nodes: Vec<gltf::Node<'_>> = skin.joints().collect();
    let Some(accessor) = skin.inverse_bind_matrices() else {
        return Ok(nodes.iter().map(|node| skeleton.add_joint(node, DMat4::IDENTITY)).collect());
    };
    let inverse_bind = file.read::<16>(&accessor, Dimensions::Mat4)?;
    if inverse_bind.len() < nodes.len() {
        let message = format!("{} matrices for {} joints", inverse_bind.len(), nodes.len());
        return Err(Found::malformed(Place::Accessor(accessor.index()), message));
    }
    let joint =
        |(node, bind): (&gltf::Node<'_>, &[f32; 16])| skeleton.add_joint(node, Mat4::from_cols_array(bind).as_dmat4());
    Ok(nodes.iter().zip(&inverse_bind).map(joint).collect())
}

#[expect(
    clippy::too_many_arguments,
    reason = "what a primitive is read with comes from its node, its skin and its mesh"
)]
fn add_primitive(
    file: &GltfFile,
    primitive: &gltf::Primitive<'_>,
    joints: &[u32],
    skinned: bool,
    first_target: u32,
    matrices: &[DMat4],
    morph_weights: &[f32],
    posed: &mut Posed,
) -> Result<(), Found> {
    if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(());
    }
    let Some(accessor) = primitive.get(&Semantic::Positions) else {
        return Ok(());
    };
    let positions = file.read::<3>(&accessor, Dimensions::Vec3)?;
    let soup = &mut posed.soup;
    let first = soup.positions.len();
    check_most("vertices", first + positions.len())?;
    let influences = if skinned {
        skin_influences(file, primitive, joints, positions.len())?
    } else {
        vec![vec![Influence { joint: joints[0], weight: 1.0 }]; positions.len()]
    };
    let displacements = read_displacements(file, primitive, first_target, positions.len())?;
    let place = || Place::Accessor(accessor.index());
    for ((position, influences), displacements) in positions.iter().zip(influences).zip(displacements) {
        let mut matrix = DMat4::ZERO;
        for influence in &influences {
            matrix += matrices[influence.joint as usize] * f64::from(influence.weight);
        }
        let position = Vec3::from(*position);
        let shift = |d: &Displacement| d.position.as_dvec3() * f64::from(morph_weights[d.target as usize]);
        let morphed = position.as_dvec3() + displacements.iter().map(shift).sum::<DVec3>();
        soup.push_vertex(matrix.transform_point3(morphed), place)?;
        posed.bindings.push(Binding { position, influences, displacements, matrix });
    }
    if let Some(accessor) = primitive.get(&Semantic::Normals) {
        let normals = file.read::<3>(&accessor, Dimensions::Vec3)?;
        for (vertex, normal) in normals.iter().enumerate().take(positions.len()) {
            let binding = &posed.bindings[first + vertex];
            let shift = |d: &Displacement| d.normal.as_dvec3() * f64::from(morph_weights[d.target as usize]);
            let morphed = Vec3::from(*normal).as_dvec3() + binding.displacements.iter().map(shift).sum::<DVec3>();
            soup.normals[first + vertex] = turned(binding.matrix, morphed);
        }
    }
    add_triangles(file, primitive, positions.len(), soup)
}

/// What the morph targets of a primitive do to each vertex.
fn read_displacements(
    file: &GltfFile,
    primitive: &gltf::Primitive<'_>,
    first_target: u32,
    vertex_count: usize,
) -> Result<Vec<Vec<Displacement>>, Found> {
    let mut displacements = vec![Vec::new(); vertex_count];
    for (morph, target) in primitive.morph_targets().zip(first_target..) {
        let read = |accessor: Option<gltf::Accessor<'_>>| match accessor {
            Some(accessor) => file.read::<3>(&accessor, Dimensions::Vec3),
            None => Ok(Vec::new()),
        };
        let [positions, normals] = [read(morph.positions())?, read(morph.normals())?];
        for (vertex, displacements) in displacements.iter_mut().enumerate() {
            let at = |values: &[[f32; 3]]| values.get(vertex).copied().map_or(Vec3::ZERO, Vec3::from);
            let (position, normal) = (at(&positions), at(&normals));
            if position != Vec3::ZERO || normal != Vec3::ZERO {
                displacements.push(Displacement { target, position, normal });
            }
        }
    }
    Ok(displacements)
}

/// A normal under a linear map that need not keep angles. The cofactors stand for the inverse transpose, which a flattened
/// limb would not have.
fn turned(matrix: DMat4, normal: DVec3) -> DVec3 {
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|axis| axis.truncate());
    let turned = y.cross(z) * normal.x + z.cross(x) * normal.y + x.cross(y) * normal.z;
    turned.normalize_or_zero()
}

/// For each vertex its joints and their shares.
fn skin_influences(
    file: &GltfFile,
    primitive: &gltf::Primitive<'_>,
    joints: &[u32],
    vertex_count: usize,
) -> Result<Vec<Vec<Influence>>, Found> {
    let mut influences: Vec<Vec<Influence>> = vec![Vec::new(); vertex_count];
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
        for (influences, (indices, weights)) in influences.iter_mut().zip(indices.iter().zip(&weights)) {
            for (index, weight) in indices.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
                let Some(joint) = joints.get(*index as usize) else {
                    let (index, count) = (i64::from(*index), joints.len());
                    let fault = Fault::OutOfRange { what: "joint", index, count };
                    return Err(Found::at(joint_place, fault));
                };
                influences.push(Influence { joint: *joint, weight: *weight });
            }
        }
    }
    for (vertex, influences) in influences.iter_mut().enumerate() {
        let sum: f64 = influences.iter().map(|influence| f64::from(influence.weight)).sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return Err(Found::malformed(place, format!("vertex {vertex} hangs on no joint")));
        }
        influences.iter_mut().for_each(|influence| influence.weight = (f64::from(influence.weight) / sum) as f32);
    }
    Ok(influences)
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
