//! The surface of a posed glTF file: every mesh of the scene, bent by its joints, and how it hangs on them.

use crate::body::gltf_file::{GltfFile, check_most};
use crate::body::gltf_rig::{ClipChoice, Hanging, Skeleton};
use crate::body::soup::{Cleaned, Soup};
use crate::error::{Fault, Found, Place};
use crate::unread::Unread;
use glam::{DMat4, Vec3};
use gltf::Semantic;
use gltf::accessor::Dimensions;
use gltf::mesh::Mode;
use std::path::Path;
use toile_scene::{Displacement, Influence, Morphs, Rig, Skin, normal_before, turned_normal};

/// No body has more vertices or triangles. Nodes can repeat a mesh, so a small file can ask for any number.
const MOST: usize = 1 << 23;

/// No body has more shares of joints in vertices, or of morph targets. Attributes can share accessors.
const MOST_SHARES: usize = 1 << 24;

/// The surface of a glTF file at one time.
pub(crate) struct Surface {
    /// Its posed triangles, in the file's unit.
    pub soup: Soup,
    /// How the vertices of the soup hang on the joints; a normal is zero where the file gives none.
    pub skin: Skin,
    /// How the joints move.
    pub rig: Rig,
    /// From bind space to the world of the file at that time, for each joint.
    matrices: Vec<DMat4>,
    /// Weight of each morph target at that time.
    morph_weights: Vec<f64>,
}

/// Reads the surface at a time of a clip; after the end of the clip it stands still. Positions stay in the file's unit.
pub(crate) fn read(
    bytes: &[u8],
    folder: Option<&Path>,
    choice: ClipChoice<'_>,
    time: f64,
    metres_per_unit: f64,
    unread: &mut Unread,
) -> Result<Surface, Found> {
    let file = GltfFile::open(bytes, folder, unread)?;
    if let Some(other) =
        file.document.scenes().map(|scene| scene.index()).find(|scene| Some(*scene) != shown(&file.document))
    {
        unread.note("scenes beside the one that is shown", || Place::Key(format!("scenes[{other}]")));
    }
    let mesh_nodes: Vec<_> = scene_nodes(&file).into_iter().filter(|node| node.mesh().is_some()).collect();
    let skeleton = Skeleton::of(&file, &mesh_nodes)?;
    let hangings: Vec<Hanging> = mesh_nodes.iter().map(|node| skeleton.hanging(node.index())).collect();
    let rig = skeleton.rig(&file, choice, metres_per_unit)?;
    let time = time.min(rig.duration());
    let world = rig.node_transforms(time);
    if let Some(node) = world.iter().position(|matrix| !matrix.is_finite()) {
        return Err(Found::at(Place::Node(node), Fault::NotFinite("the transform of the node".into())));
    }
    let mut surface = Surface {
        soup: Soup::default(),
        skin: Skin { influence_offsets: vec![0], ..Skin::default() },
        matrices: rig.joints().iter().map(|joint| world[joint.node] * joint.inverse_bind).collect(),
        morph_weights: rig.morph_weights(time),
        rig,
    };
    let mut morphs = Morphs { offsets: vec![0], displacements: Vec::new() };
    let mut displacement_count = 0;
    for (node, hanging) in mesh_nodes.iter().zip(&hangings) {
        for primitive in node.mesh().iter().flat_map(|mesh| mesh.primitives()) {
            surface.add_primitive(&file, &primitive, hanging, &mut morphs, &mut displacement_count)?;
        }
    }
    surface.skin.morphs = (!morphs.displacements.is_empty()).then_some(morphs);
    Ok(surface)
}

/// The default scene, else the first one.
fn shown(document: &gltf::Document) -> Option<usize> {
    document.default_scene().or_else(|| document.scenes().next()).map(|scene| scene.index())
}

/// The nodes of the scene that is shown, else of the file; parents first, and none that is hidden.
fn scene_nodes(file: &GltfFile) -> Vec<gltf::Node<'_>> {
    let document = &file.document;
    let is_hidden = |node: &gltf::Node<'_>| file.hidden.get(node.index()) == Some(&true);
    let mut seen = vec![false; document.nodes().count()];
    let mut open: Vec<gltf::Node<'_>> = match shown(document).and_then(|scene| document.scenes().nth(scene)) {
        Some(scene) => scene.nodes().collect(),
        None => {
            let mut is_child = vec![false; seen.len()];
            document.nodes().flat_map(|node| node.children()).for_each(|child| is_child[child.index()] = true);
            document.nodes().filter(|node| !is_child[node.index()]).collect()
        }
    };
    let mut nodes = Vec::new();
    while let Some(node) = open.pop() {
        if !is_hidden(&node) && !std::mem::replace(&mut seen[node.index()], true) {
            open.extend(node.children());
            nodes.push(node);
        }
    }
    nodes
}

impl Surface {
    fn add_primitive(
        &mut self,
        file: &GltfFile,
        primitive: &gltf::Primitive<'_>,
        hanging: &Hanging,
        morphs: &mut Morphs,
        displacement_count: &mut usize,
    ) -> Result<(), Found> {
        // Points and lines have no surface.
        if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            return Ok(());
        }
        let Some(accessor) = primitive.get(&Semantic::Positions) else {
            return Ok(());
        };
        let positions = file.read::<3>(&accessor, Dimensions::Vec3)?;
        let first = self.soup.positions.len();
        check_most("body", "vertices", first + positions.len(), MOST)?;
        let sets = if hanging.skinned { joint_sets(file, primitive, positions.len())? } else { Vec::new() };
        let share_count = self.skin.influences.len() + 4 * sets.len() * positions.len();
        check_most("body", "shares of joints", share_count, MOST_SHARES)?;
        let normals = match primitive.get(&Semantic::Normals) {
            Some(accessor) => file.read::<3>(&accessor, Dimensions::Vec3)?,
            None => Vec::new(),
        };
        *displacement_count += primitive.morph_targets().count() * positions.len();
        check_most("body", "displacements by morph targets", *displacement_count, MOST_SHARES)?;
        let targets = primitive.morph_targets().map(|target| Target::read(file, &target, positions.len()));
        let targets = targets.collect::<Result<Vec<_>, _>>()?;
        let mut mirrored = Vec::with_capacity(positions.len());
        for (vertex, position) in positions.iter().enumerate() {
            for (number, target) in targets.iter().enumerate() {
                morphs.displacements.extend(target.displacement(vertex, (hanging.targets.start + number) as u32));
            }
            morphs.offsets.push(morphs.displacements.len() as u32);
            let displacements = morphs.offsets[first + vertex] as usize..;
            let normal = normals.get(vertex).map_or(Vec3::ZERO, |normal| Vec3::from(*normal));
            let mut posed = [Vec3::from(*position), normal].map(|vector| vector.as_dvec3());
            for displacement in &morphs.displacements[displacements] {
                let weight = self.morph_weights[displacement.target as usize];
                posed[0] += displacement.position.as_dvec3() * weight;
                posed[1] += displacement.normal.as_dvec3() * weight;
            }
            let matrix = if hanging.skinned {
                self.add_influences(&sets, vertex, hanging)?
            } else {
                self.skin.influences.push(Influence { joint: hanging.joints.start as u32, weight: 1.0 });
                self.matrices[hanging.joints.start]
            };
            let is_mirrored = matrix.determinant() < 0.0;
            mirrored.push(is_mirrored);
            self.skin.influence_offsets.push(self.skin.influences.len() as u32);
            self.skin.positions.push(Vec3::from(*position));
            self.skin.normals.push(normal);
            self.soup.push_vertex(matrix.transform_point3(posed[0]), || Place::Accessor(accessor.index()))?;
            // The cofactors turn a normal as the winding goes, which is that of the file no more.
            let side = if is_mirrored { -1.0 } else { 1.0 };
            self.soup.normals[first + vertex] = turned_normal(matrix, posed[1]) * side;
        }
        add_triangles(file, primitive, &mirrored, &mut self.soup)
    }

    /// Adds the shares of a vertex to the skin and gives the mean of its joints' matrices by weight.
    fn add_influences(&mut self, sets: &[JointSet], vertex: usize, hanging: &Hanging) -> Result<DMat4, Found> {
        let first = self.skin.influences.len();
        let (mut matrix, mut sum) = (DMat4::ZERO, 0.0);
        for set in sets {
            for (index, weight) in set.indices[vertex].iter().zip(set.weights[vertex]) {
                if weight == 0.0 {
                    continue;
                }
                if !(weight > 0.0 && weight.is_finite()) {
                    let message = format!("vertex {vertex} hangs on a joint by the weight {weight}");
                    return Err(Found::malformed(Place::Accessor(set.weight_accessor), message));
                }
                let (count, index) = (hanging.joints.len(), *index as usize);
                if index >= count {
                    let fault = Fault::OutOfRange { what: "joint", index: index as i64, count };
                    return Err(Found::at(Place::Accessor(set.joint_accessor), fault));
                }
                let joint = hanging.joints.start + index;
                self.skin.influences.push(Influence { joint: joint as u32, weight });
                matrix += self.matrices[joint] * f64::from(weight);
                sum += f64::from(weight);
            }
        }
        if sum <= 0.0 {
            let place = sets.last().map_or(Place::File, |set| Place::Accessor(set.weight_accessor));
            return Err(Found::malformed(place, format!("vertex {vertex} hangs on no joint")));
        }
        for share in &mut self.skin.influences[first..] {
            share.weight = (f64::from(share.weight) / sum) as f32;
        }
        Ok(matrix * sum.recip())
    }

    /// The skin of the clean mesh that was made of the soup. Its normals are those that pose as the clean ones.
    pub fn skin_of(&self, cleaned: &Cleaned) -> Skin {
        let mut skin = Skin { influence_offsets: vec![0], ..Skin::default() };
        let mut morphs = Morphs { offsets: vec![0], displacements: Vec::new() };
        for (origin, normal) in cleaned.origins.iter().zip(&cleaned.mesh.normals) {
            let vertex = *origin as usize;
            let displacements = self.skin.displacements_of(vertex);
            let matrix = self.skin.blended(vertex, &self.matrices);
            let mut bind = normal_before(matrix, normal.as_dvec3());
            if displacements.iter().any(|displacement| displacement.normal != Vec3::ZERO) {
                // The morphs add to a normal that is not yet of unit length.
                let [_, morphed] = self.skin.morphed(vertex, &self.morph_weights);
                let added = morphed - self.skin.normals[vertex].as_dvec3();
                let length = morphed.length();
                bind = bind * if length > 1e-6 { length } else { 1.0 } - added;
            }
            skin.positions.push(self.skin.positions[vertex]);
            skin.normals.push(bind.as_vec3());
            skin.influences.extend(self.skin.influences_of(vertex));
            skin.influence_offsets.push(skin.influences.len() as u32);
            morphs.displacements.extend(displacements);
            morphs.offsets.push(morphs.displacements.len() as u32);
        }
        skin.morphs = (!morphs.displacements.is_empty()).then_some(morphs);
        skin
    }

    /// Number of vertices that were welded to one that hangs differently, so that one of both moves as it should not.
    pub fn torn_count(&self, cleaned: &Cleaned) -> usize {
        let binding = |vertex: usize| {
            (self.skin.positions[vertex], self.skin.influences_of(vertex), self.skin.displacements_of(vertex))
        };
        let torn = |(vertex, kept): &(usize, &Option<u32>)| {
            kept.is_some_and(|kept| binding(*vertex) != binding(cleaned.origins[kept as usize] as usize))
        };
        cleaned.kept.iter().enumerate().filter(torn).count()
    }
}

/// Joints and weights of four shares of every vertex.
struct JointSet {
    indices: Vec<[u32; 4]>,
    weights: Vec<[f32; 4]>,
    joint_accessor: usize,
    weight_accessor: usize,
}

fn joint_sets(file: &GltfFile, primitive: &gltf::Primitive<'_>, vertex_count: usize) -> Result<Vec<JointSet>, Found> {
    let mut sets = Vec::new();
    for set in 0.. {
        let (Some(indices), Some(weights)) =
            (primitive.get(&Semantic::Joints(set)), primitive.get(&Semantic::Weights(set)))
        else {
            break;
        };
        check_most("body", "shares of joints", 4 * (sets.len() + 1) * vertex_count, MOST_SHARES)?;
        for accessor in [&indices, &weights] {
            check_count(accessor, vertex_count)?;
        }
        sets.push(JointSet {
            indices: file.read_indices::<4>(&indices, Dimensions::Vec4)?,
            weights: file.read::<4>(&weights, Dimensions::Vec4)?,
            joint_accessor: indices.index(),
            weight_accessor: weights.index(),
        });
    }
    Ok(sets)
}

/// A morph target of one primitive.
struct Target {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
}

impl Target {
    fn read(file: &GltfFile, target: &gltf::mesh::MorphTarget<'_>, vertex_count: usize) -> Result<Self, Found> {
        let read = |accessor: Option<gltf::Accessor<'_>>| {
            let Some(accessor) = accessor else { return Ok(Vec::new()) };
            check_count(&accessor, vertex_count)?;
            let vectors = file.read::<3>(&accessor, Dimensions::Vec3)?;
            match vectors.iter().position(|vector| !Vec3::from(*vector).is_finite()) {
                Some(broken) => {
                    let fault = Fault::NotFinite(format!("displacement {broken} of a morph target"));
                    Err(Found::at(Place::Accessor(accessor.index()), fault))
                }
                None => Ok(vectors),
            }
        };
        Ok(Self { positions: read(target.positions())?, normals: read(target.normals())? })
    }

    /// What the target does to a vertex; `None` for nothing.
    fn displacement(&self, vertex: usize, target: u32) -> Option<Displacement> {
        let part = |vectors: &[[f32; 3]]| vectors.get(vertex).map_or(Vec3::ZERO, |vector| Vec3::from(*vector));
        let (position, normal) = (part(&self.positions), part(&self.normals));
        (position != Vec3::ZERO || normal != Vec3::ZERO).then_some(Displacement { target, position, normal })
    }
}

fn check_count(accessor: &gltf::Accessor<'_>, vertex_count: usize) -> Result<(), Found> {
    if accessor.count() == vertex_count {
        return Ok(());
    }
    let message = format!("it has {} elements for {vertex_count} vertices", accessor.count());
    Err(Found::malformed(Place::Accessor(accessor.index()), message))
}

/// A triangle that its transform mirrors is wound the other way, as the format says.
fn add_triangles(
    file: &GltfFile,
    primitive: &gltf::Primitive<'_>,
    mirrored: &[bool],
    soup: &mut Soup,
) -> Result<(), Found> {
    let vertex_count = mirrored.len();
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
    check_most("body", "triangles", soup.triangles.len() + indices.len() / 3, MOST)?;
    let mut push = |a: usize, b: usize, c: usize| {
        let corners = [a, b, c].map(|at| indices[at][0]);
        let is_mirrored = corners.iter().filter(|corner| mirrored[**corner as usize]).count() > 1;
        let [a, b, c] = corners.map(|corner| first + corner);
        soup.triangles.push(if is_mirrored { [a, c, b] } else { [a, b, c] });
    };
    match primitive.mode() {
        Mode::TriangleStrip => {
            (2..indices.len()).for_each(|i| if i % 2 == 0 { push(i - 2, i - 1, i) } else { push(i - 1, i - 2, i) });
        }
        Mode::TriangleFan => (2..indices.len()).for_each(|i| push(0, i - 1, i)),
        _ => (0..indices.len() / 3).for_each(|i| push(3 * i, 3 * i + 1, 3 * i + 2)),
    }
    Ok(())
}
