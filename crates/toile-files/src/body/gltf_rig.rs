//! The nodes, joints and clips of a glTF file as a rig.

use crate::body::gltf_file::{GltfFile, check_most};
use crate::error::{Fault, Found, Place};
use glam::{DMat4, DQuat, DVec3, Mat4, Quat, Vec3};
use gltf::accessor::Dimensions;
use gltf::animation::Property;
use std::collections::HashMap;
use std::ops::Range;
use toile_scene::{Channel, Clip, Interpolation, Joint, Keys, LocalTransform, Rig, RigNode};

/// Longest motion [s]: its whole way is gone along before the first frame.
pub(crate) const DURATION_MAX: f64 = 3600.0;

/// No clip has more numbers: channels can share accessors, so a small file can ask for any amount.
const MOST_NUMBERS: usize = 1 << 24;

/// No body has more morph targets. Nodes can repeat a mesh.
const MOST_TARGETS: usize = 1 << 20;

/// Which clip moves the nodes.
#[derive(Clone, Copy)]
pub(crate) enum ClipChoice<'a> {
    None,
    First,
    Named(&'a str),
}

/// The nodes with everything that the meshes of a scene hang on.
pub(crate) struct Skeleton {
    nodes: Vec<RigNode>,
    joints: Vec<Joint>,
    morph_weights: Vec<f64>,
    hangings: HashMap<usize, Hanging>,
}

/// What the mesh of a node hangs on.
#[derive(Clone)]
pub(crate) struct Hanging {
    /// Its joints among those of the rig; for a mesh without skin one that stands for the node.
    pub joints: Range<usize>,
    /// Its morph targets among those of the rig.
    pub targets: Range<usize>,
    pub skinned: bool,
}

impl Skeleton {
    /// Of the meshes of these nodes.
    pub fn of(file: &GltfFile, mesh_nodes: &[gltf::Node<'_>]) -> Result<Self, Found> {
        let mut nodes: Vec<RigNode> =
            file.document.nodes().map(|node| RigNode { parent: None, transform: transform(&node) }).collect();
        for node in file.document.nodes() {
            for child in node.children() {
                nodes[child.index()].parent = Some(node.index());
            }
        }
        let mut skeleton = Self { nodes, joints: Vec::new(), morph_weights: Vec::new(), hangings: HashMap::new() };
        let mut skins = HashMap::new();
        for node in mesh_nodes {
            let joints = match node.skin() {
                Some(skin) => match skins.get(&skin.index()) {
                    Some(known) => Range::clone(known),
                    None => {
                        let added = skeleton.add_joints(skin_joints(file, &skin)?);
                        skins.insert(skin.index(), added.clone());
                        added
                    }
                },
                None => skeleton.add_joints(vec![joint(node, DMat4::IDENTITY)]),
            };
            let targets = skeleton.add_targets(node)?;
            let hanging = Hanging { joints, targets, skinned: node.skin().is_some() };
            skeleton.hangings.insert(node.index(), hanging);
        }
        Ok(skeleton)
    }

    /// What the mesh of a node hangs on; the node is one of those that the skeleton was made of.
    pub fn hanging(&self, node: usize) -> Hanging {
        self.hangings[&node].clone()
    }

    /// The rig, moved by a clip.
    pub fn rig(self, file: &GltfFile, choice: ClipChoice<'_>, metres_per_unit: f64) -> Result<Rig, Found> {
        let clip = self.clip(file, choice)?;
        Rig::new(self.nodes, self.joints, self.morph_weights, clip, metres_per_unit)
            .map_err(|circle| Found::malformed(Place::Node(circle.node), "the node is its own ancestor"))
    }

    fn add_joints(&mut self, joints: Vec<Joint>) -> Range<usize> {
        let first = self.joints.len();
        self.joints.extend(joints);
        first..self.joints.len()
    }

    fn add_targets(&mut self, node: &gltf::Node<'_>) -> Result<Range<usize>, Found> {
        let first = self.morph_weights.len();
        let Some(mesh) = node.mesh() else { return Ok(first..first) };
        let count = mesh.primitives().map(|primitive| primitive.morph_targets().count()).max().unwrap_or(0);
        check_most("body", "morph targets", first + count, MOST_TARGETS)?;
        let weights = node.weights().or_else(|| mesh.weights()).unwrap_or_default();
        if let Some(weight) = weights.iter().find(|weight| !weight.is_finite()) {
            let fault = Fault::NotFinite(format!("the weight {weight} of a morph target"));
            return Err(Found::at(Place::Node(node.index()), fault));
        }
        let weights = weights.iter().map(|weight| f64::from(*weight));
        self.morph_weights.extend(weights.chain(std::iter::repeat(0.0)).take(count));
        Ok(first..first + count)
    }

    fn clip(&self, file: &GltfFile, choice: ClipChoice<'_>) -> Result<Option<Clip>, Found> {
        let animation = match choice {
            ClipChoice::None => return Ok(None),
            ClipChoice::First => file
                .document
                .animations()
                .next()
                .ok_or_else(|| Found::malformed(Place::File, "it has no clip, so the body cannot move"))?,
            ClipChoice::Named(name) => {
                let mut animations = file.document.animations();
                animations.find(|animation| animation.name() == Some(name)).ok_or_else(|| {
                    let names = file.document.animations().filter_map(|animation| animation.name());
                    let known = names.map(String::from).collect();
                    Fault::Unknown { what: "clip", name: name.into(), known }
                })?
            }
        };
        let mut clip = Clip { name: animation.name().unwrap_or_default().into(), duration: 0.0, channels: Vec::new() };
        let mut reader = KeyReader { file, number_count: 0, duration: 0.0 };
        for channel in animation.channels() {
            self.add_channel(&mut reader, &channel, &mut clip.channels)?;
        }
        clip.duration = reader.duration;
        if clip.duration > DURATION_MAX {
            let message = format!(
                "the clip \"{}\" is {} s long, and clips are at most {DURATION_MAX} s: cut it",
                clip.name, clip.duration
            );
            return Err(Found::malformed(Place::File, message));
        }
        Ok(Some(clip))
    }

    fn add_channel(
        &self,
        reader: &mut KeyReader<'_>,
        channel: &gltf::animation::Channel<'_>,
        channels: &mut Vec<Channel>,
    ) -> Result<(), Found> {
        let node = channel.target().node().index();
        let property = channel.target().property();
        let has_matrix = matches!(self.nodes[node].transform, LocalTransform::Matrix(_));
        if has_matrix && property != Property::MorphTargetWeights {
            let message = "the clip moves a node that has a matrix instead of a translation and rotation";
            return Err(Found::malformed(Place::Node(node), message));
        }
        let sampler = channel.sampler();
        match property {
            Property::Translation => {
                let keys = reader.keys(&sampler, DVec3::from_array)?;
                channels.push(Channel::Translation { node, keys });
            }
            Property::Rotation => {
                let keys = reader.keys(&sampler, DQuat::from_array)?;
                channels.push(Channel::Rotation { node, keys });
            }
            Property::Scale => {
                let keys = reader.keys(&sampler, DVec3::from_array)?;
                channels.push(Channel::Scale { node, keys });
            }
            Property::MorphTargetWeights => {
                // A node outside of the scene has no mesh that hangs on the rig, and one without targets nothing to mix.
                let Some(hanging) = self.hangings.get(&node).filter(|hanging| !hanging.targets.is_empty()) else {
                    return Ok(());
                };
                let keys = reader.weights(&sampler, hanging.targets.len())?;
                let moves = |(target, keys)| Channel::MorphWeight { target, keys };
                channels.extend(hanging.targets.clone().zip(keys).map(moves));
            }
        }
        Ok(())
    }
}

fn transform(node: &gltf::Node<'_>) -> LocalTransform {
    match node.transform() {
        gltf::scene::Transform::Matrix { matrix } => {
            LocalTransform::Matrix(Mat4::from_cols_array_2d(&matrix).as_dmat4())
        }
        gltf::scene::Transform::Decomposed { translation, rotation, scale } => LocalTransform::Parts {
            translation: Vec3::from(translation).as_dvec3(),
            rotation: Quat::from_array(rotation).as_dquat(),
            scale: Vec3::from(scale).as_dvec3(),
        },
    }
}

fn joint(node: &gltf::Node<'_>, inverse_bind: DMat4) -> Joint {
    let name = node.name().map_or_else(|| format!("node {}", node.index()), String::from);
    Joint { name, node: node.index(), inverse_bind }
}

fn skin_joints(file: &GltfFile, skin: &gltf::Skin<'_>) -> Result<Vec<Joint>, Found> {
    let Some(accessor) = skin.inverse_bind_matrices() else {
        return Ok(skin.joints().map(|node| joint(&node, DMat4::IDENTITY)).collect());
    };
    let inverse_bind = file.read::<16>(&accessor, Dimensions::Mat4)?;
    let count = skin.joints().count();
    if inverse_bind.len() < count {
        let message = format!("{} matrices for {count} joints", inverse_bind.len());
        return Err(Found::malformed(Place::Accessor(accessor.index()), message));
    }
    if let Some(broken) = inverse_bind.iter().position(|matrix| !matrix.iter().all(|value| value.is_finite())) {
        let fault = Fault::NotFinite(format!("matrix {broken} of the skin"));
        return Err(Found::at(Place::Accessor(accessor.index()), fault));
    }
    let bound = |(node, bind): (gltf::Node<'_>, &[f32; 16])| joint(&node, Mat4::from_cols_array(bind).as_dmat4());
    Ok(skin.joints().zip(&inverse_bind).map(bound).collect())
}

/// Reads the keys of one clip.
struct KeyReader<'a> {
    file: &'a GltfFile,
    number_count: usize,
    /// The latest key so far [s].
    duration: f64,
}

impl KeyReader<'_> {
    fn keys<T, const N: usize>(
        &mut self,
        sampler: &gltf::animation::Sampler<'_>,
        value: fn([f64; N]) -> T,
    ) -> Result<Keys<T>, Found> {
        let (interpolation, times) = self.times(sampler)?;
        let dimensions = if N == 4 { Dimensions::Vec4 } else { Dimensions::Vec3 };
        let values = self.values::<N>(sampler, dimensions, times.len() * per_key(interpolation))?;
        let values = values.into_iter().map(|numbers| value(numbers.map(f64::from))).collect();
        Ok(Keys { interpolation, times, values })
    }

    /// The keys of each morph target. The file holds the weights of all targets key by key.
    fn weights(
        &mut self,
        sampler: &gltf::animation::Sampler<'_>,
        target_count: usize,
    ) -> Result<Vec<Keys<f64>>, Found> {
        let (interpolation, times) = self.times(sampler)?;
        self.count(times.len().saturating_mul(target_count))?;
        let row_count = times.len() * per_key(interpolation);
        let values = self.values::<1>(sampler, Dimensions::Scalar, row_count * target_count)?;
        let of_target = |target: usize| {
            let values = (0..row_count).map(|row| f64::from(values[row * target_count + target][0])).collect();
            Keys { interpolation, times: times.clone(), values }
        };
        Ok((0..target_count).map(of_target).collect())
    }

    fn times(&mut self, sampler: &gltf::animation::Sampler<'_>) -> Result<(Interpolation, Vec<f64>), Found> {
        let place = || Place::Accessor(sampler.input().index());
        let times = self.file.read::<1>(&sampler.input(), Dimensions::Scalar)?;
        self.count(times.len())?;
        let times: Vec<f64> = times.into_iter().map(|[time]| f64::from(time)).collect();
        if let Some(time) = times.iter().find(|time| !time.is_finite()) {
            return Err(Found::at(place(), Fault::NotFinite(format!("the time {time} of a key"))));
        }
        if !times.is_sorted() {
            return Err(Found::malformed(place(), "the times of the keys do not rise"));
        }
        self.duration = times.last().map_or(self.duration, |last| self.duration.max(*last));
        let interpolation = match sampler.interpolation() {
            gltf::animation::Interpolation::Step => Interpolation::Step,
            gltf::animation::Interpolation::Linear => Interpolation::Linear,
            gltf::animation::Interpolation::CubicSpline => Interpolation::CubicSpline,
        };
        Ok((interpolation, times))
    }

    fn values<const N: usize>(
        &mut self,
        sampler: &gltf::animation::Sampler<'_>,
        dimensions: Dimensions,
        count: usize,
    ) -> Result<Vec<[f32; N]>, Found> {
        let place = || Place::Accessor(sampler.output().index());
        let values = self.file.read::<N>(&sampler.output(), dimensions)?;
        if count == 0 || values.len() != count {
            let key_count = sampler.input().count();
            return Err(Found::malformed(place(), format!("{} values do not fit {key_count} keys", values.len())));
        }
        self.count(N * count)?;
        if let Some(key) = values.iter().position(|numbers| !numbers.iter().all(|number| number.is_finite())) {
            return Err(Found::at(place(), Fault::NotFinite(format!("value {key} of the clip"))));
        }
        Ok(values)
    }

    fn count(&mut self, added: usize) -> Result<(), Found> {
        self.number_count = self.number_count.saturating_add(added);
        check_most("clip", "numbers", self.number_count, MOST_NUMBERS)
    }
}

/// Values per key: a cubic key has the changes at arrival and at leaving beside its value.
fn per_key(interpolation: Interpolation) -> usize {
    if interpolation == Interpolation::CubicSpline { 3 } else { 1 }
}
