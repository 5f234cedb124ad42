//! The nodes of a glTF file and how a clip moves them.

use crate::error::{Fault, Found, Place};
use crate::gltf_file::GltfFile;
use glam::{DMat4, DQuat, Mat4, Quat, Vec3};
use gltf::accessor::Dimensions;
use toile_scene::{Interpolation, Joint, Keys, Node, Property, Rig, Track, Transform};

/// Nodes and tracks of a file, in the unit of the file; joints and morph targets are added by whoever finds them.
pub(crate) struct Skeleton {
    pub rig: Rig,
    /// Index in the rig of each node of the file.
    pub index_of: Vec<u32>,
}

impl Skeleton {
    /// The nodes as they stand, and the tracks of a clip; the first clip when `clip` is `None` and `moving`.
    pub fn read(file: &GltfFile, clip: Option<&str>) -> Result<Self, Found> {
        let mut parents = vec![None; file.document.nodes().count()];
        for node in file.document.nodes() {
            for child in node.children() {
                parents[child.index()] = Some(node.index());
            }
        }
        let order = parents_first(&parents)?;
        let mut index_of = vec![0; parents.len()];
        order.iter().zip(0..).for_each(|(node, index)| index_of[*node] = index);
        let locals: Vec<Transform> = file.document.nodes().map(|node| local_of(&node)).collect();
        let nodes = order
            .iter()
            .map(|node| Node { parent: parents[*node].map(|parent| index_of[parent]), local: locals[*node] })
            .collect();
        let rig = Rig {
            nodes,
            joints: Vec::new(),
            tracks: Vec::new(),
            morph_weights: Vec::new(),
            duration: 0.0,
            metres_per_unit: 1.0,
        };
        let mut skeleton = Self { rig, index_of };
        if let Some(clip) = clip {
            skeleton.read_clip(file, clip)?;
        }
        Ok(skeleton)
    }

    /// Adds a joint that stands where a node of the file does, and gives its index.
    pub fn add_joint(&mut self, node: &gltf::Node<'_>, inverse_bind: DMat4) -> u32 {
        let name = node.name().unwrap_or_default().to_owned();
        self.rig.joints.push(Joint { name, node: self.index_of[node.index()], inverse_bind });
        self.rig.joints.len() as u32 - 1
    }

    /// Refuses transforms that are not finite at a time [s].
    pub fn check(&self, time: f64) -> Result<(), Found> {
        let worlds = self.rig.worlds(time);
        let fault = |node: usize| worlds[self.index_of[node] as usize].is_finite();
        match (0..self.index_of.len()).find(|node| !fault(*node)) {
            None => Ok(()),
            Some(node) => Err(Found::at(Place::Node(node), Fault::NotFinite("the transform of the node".into()))),
        }
    }

    fn read_clip(&mut self, file: &GltfFile, clip: &str) -> Result<(), Found> {
        let Some(animation) = file.document.animations().find(|animation| animation.name() == Some(clip)) else {
            let names = file.document.animations().filter_map(|animation| animation.name());
            let known = names.map(String::from).collect();
            return Err(Fault::Unknown { what: "clip", name: clip.into(), known }.into());
        };
        for channel in animation.channels() {
            let target = channel.target();
            let node = self.index_of[target.node().index()];
            let property = match target.property() {
                gltf::animation::Property::Translation => Property::Translation,
                gltf::animation::Property::Scale => Property::Scale,
                gltf::animation::Property::Rotation => Property::Rotation,
                // They belong to the mesh of the node, which is read with them.
                gltf::animation::Property::MorphTargetWeights => continue,
            };
            if matches!(self.rig.nodes[node as usize].local, Transform::Matrix(_)) {
                let message = "the clip moves a node that has a matrix instead of a translation and rotation";
                return Err(Found::malformed(Place::Node(target.node().index()), message));
            }
            let width = if property == Property::Rotation { 4 } else { 3 };
            let keys = read_keys(file, &channel.sampler(), width)?;
            self.add_track(Track { node, property, keys });
        }
        Ok(())
    }

    /// The tracks by which a clip moves the weights of the morph targets of a node, `width` of them, which begin at `first`.
    pub fn read_morph_tracks(
        &mut self,
        file: &GltfFile,
        clip: &str,
        node: &gltf::Node<'_>,
        first: u32,
        width: usize,
    ) -> Result<(), Found> {
        let animations = file.document.animations().filter(|animation| animation.name() == Some(clip)).take(1);
        for channel in animations.flat_map(|animation| animation.channels().collect::<Vec<_>>()) {
            let target = channel.target();
            if target.node().index() == node.index()
                && target.property() == gltf::animation::Property::MorphTargetWeights
            {
                let keys = read_keys(file, &channel.sampler(), width)?;
                self.add_track(Track {
                    node: self.index_of[node.index()],
                    property: Property::MorphWeights(first),
                    keys,
                });
            }
        }
        Ok(())
    }

    fn add_track(&mut self, track: Track) {
        let end = *track.keys.times.last().expect("keys were checked");
        self.rig.duration = self.rig.duration.max(end);
        self.rig.tracks.push(track);
    }
}

/// The nodes so that each comes after its parent.
fn parents_first(parents: &[Option<usize>]) -> Result<Vec<usize>, Found> {
    let mut placed = vec![false; parents.len()];
    let mut order = Vec::with_capacity(parents.len());
    for node in 0..parents.len() {
        let mut path = Vec::new();
        let mut next = Some(node);
        while let Some(open) = next.filter(|open| !placed[*open]) {
            if path.len() == parents.len() {
                return Err(Found::malformed(Place::Node(node), "the node is its own ancestor"));
            }
            path.push(open);
            next = parents[open];
        }
        for open in path.into_iter().rev() {
            placed[open] = true;
            order.push(open);
        }
    }
    Ok(order)
}

fn local_of(node: &gltf::Node<'_>) -> Transform {
    match node.transform() {
        gltf::scene::Transform::Matrix { matrix } => Transform::Matrix(Mat4::from_cols_array_2d(&matrix).as_dmat4()),
        gltf::scene::Transform::Decomposed { translation, rotation, scale } => Transform::Parts {
            translation: Vec3::from(translation).as_dvec3(),
            rotation: DQuat::from(Quat::from_array(rotation).as_dquat()),
            scale: Vec3::from(scale).as_dvec3(),
        },
    }
}

/// The keys of a channel with `width` values each.
fn read_keys(file: &GltfFile, sampler: &gltf::animation::Sampler<'_>, width: usize) -> Result<Keys, Found> {
    let times = file.read::<1>(&sampler.input(), Dimensions::Scalar)?;
    let output = sampler.output();
    let values: Vec<f64> = match output.dimensions() {
        Dimensions::Scalar => {
            file.read::<1>(&output, Dimensions::Scalar)?.iter().flatten().map(|v| f64::from(*v)).collect()
        }
        Dimensions::Vec4 if width == 4 => {
            file.read::<4>(&output, Dimensions::Vec4)?.iter().flatten().map(|v| f64::from(*v)).collect()
        }
        _ => file.read::<3>(&output, Dimensions::Vec3)?.iter().flatten().map(|v| f64::from(*v)).collect(),
    };
    let (interpolation, parts) = match sampler.interpolation() {
        gltf::animation::Interpolation::Step => (Interpolation::Step, 1),
        gltf::animation::Interpolation::Linear => (Interpolation::Linear, 1),
        gltf::animation::Interpolation::CubicSpline => (Interpolation::Cubic, 3),
    };
    let place = || Place::Accessor(output.index());
    if times.is_empty() || values.len() != times.len() * parts * width {
        let message = format!("{} values do not fit {} keys", values.len(), times.len());
        return Err(Found::malformed(place(), message));
    }
    let times: Vec<f64> = times.iter().map(|[time]| f64::from(*time)).collect();
    if !times.is_sorted() {
        return Err(Found::malformed(Place::Accessor(sampler.input().index()), "the times of the keys do not ascend"));
    }
    if !values.iter().chain(&times).all(|value| value.is_finite()) {
        return Err(Found::at(place(), Fault::NotFinite("a value of the clip".into())));
    }
    Ok(Keys { times, values, width, interpolation })
}
