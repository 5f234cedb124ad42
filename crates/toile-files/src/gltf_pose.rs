//! Where the nodes of a glTF file stand: at rest, or at a time of a clip.

use crate::error::{Fault, Found, Place};
use crate::gltf_file::GltfFile;
use glam::{DMat4, DQuat, DVec3, DVec4, Mat4, Quat, Vec3};
use gltf::accessor::Dimensions;
use gltf::animation::{Interpolation, Property};

/// World transform of every node, at a time [s] of a clip or as the nodes stand.
pub(crate) fn world_transforms(file: &GltfFile, clip: Option<&str>, time: f64) -> Result<Vec<DMat4>, Found> {
    let mut local: Vec<Local> = file.document.nodes().map(|node| Local::of(&node)).collect();
    if let Some(clip) = clip {
        pose(file, clip, time, &mut local)?;
    }
    let mut parents = vec![None; local.len()];
    for node in file.document.nodes() {
        for child in node.children() {
            parents[child.index()] = Some(node.index());
        }
    }
    worlds(&local, &parents)
}

/// Transforms multiplied down from the roots, each once.
fn worlds(local: &[Local], parents: &[Option<usize>]) -> Result<Vec<DMat4>, Found> {
    let mut world: Vec<Option<DMat4>> = vec![None; local.len()];
    for node in 0..local.len() {
        let mut path = Vec::new();
        let mut next = Some(node);
        while let Some(open) = next.filter(|open| world[*open].is_none()) {
            if path.len() == local.len() {
                return Err(Found::malformed(Place::Node(node), "the node is its own ancestor"));
            }
            path.push(open);
            next = parents[open];
        }
        let mut matrix = next.and_then(|known| world[known]).unwrap_or(DMat4::IDENTITY);
        for open in path.into_iter().rev() {
            matrix *= local[open].matrix();
            if !matrix.is_finite() {
                let fault = Fault::NotFinite("the transform of the node".into());
                return Err(Found::at(Place::Node(open), fault));
            }
            world[open] = Some(matrix);
        }
    }
    Ok(world.into_iter().flatten().collect())
}

/// Transform of a node relative to its parent.
#[derive(Clone, Copy)]
enum Local {
    Matrix(DMat4),
    Parts { translation: DVec3, rotation: DQuat, scale: DVec3 },
}

impl Local {
    fn of(node: &gltf::Node<'_>) -> Self {
        match node.transform() {
            gltf::scene::Transform::Matrix { matrix } => Self::Matrix(Mat4::from_cols_array_2d(&matrix).as_dmat4()),
            gltf::scene::Transform::Decomposed { translation, rotation, scale } => Self::Parts {
                translation: Vec3::from(translation).as_dvec3(),
                rotation: Quat::from_array(rotation).as_dquat(),
                scale: Vec3::from(scale).as_dvec3(),
            },
        }
    }

    fn matrix(self) -> DMat4 {
        match self {
            Self::Matrix(matrix) => matrix,
            Self::Parts { translation, rotation, scale } => {
                // A zero quaternion would turn into NaN and hide which node is at fault.
                let rotation = DQuat::from_vec4(DVec4::from(rotation).normalize_or(DVec4::W));
                DMat4::from_scale_rotation_translation(scale, rotation, translation)
            }
        }
    }
}

fn pose(file: &GltfFile, clip: &str, time: f64, local: &mut [Local]) -> Result<(), Found> {
    let Some(animation) = file.document.animations().find(|animation| animation.name() == Some(clip)) else {
        let names = file.document.animations().filter_map(|animation| animation.name());
        let known = names.map(String::from).collect();
        return Err(Fault::Unknown { what: "clip", name: clip.into(), known }.into());
    };
    for channel in animation.channels() {
        let target = channel.target();
        let Local::Parts { translation, rotation, scale } = &mut local[target.node().index()] else {
            let message = "the clip moves a node that has a matrix instead of a translation and rotation";
            return Err(Found::malformed(Place::Node(target.node().index()), message));
        };
        let sampler = channel.sampler();
        match target.property() {
            Property::Translation => *translation = DVec3::from(sample(file, &sampler, time, lerp)?),
            Property::Scale => *scale = DVec3::from(sample(file, &sampler, time, lerp)?),
            Property::Rotation => *rotation = DQuat::from_array(sample(file, &sampler, time, slerp)?),
            // Weights of morph targets, which are not read.
            Property::MorphTargetWeights => {}
        }
    }
    Ok(())
}

/// Value of a channel at a time [s]; it stands still before the first and after the last key.
fn sample<const N: usize>(
    file: &GltfFile,
    sampler: &gltf::animation::Sampler<'_>,
    time: f64,
    between: fn([f64; N], [f64; N], f64) -> [f64; N],
) -> Result<[f64; N], Found> {
    let dimensions = if N == 4 { Dimensions::Vec4 } else { Dimensions::Vec3 };
    let times = file.read::<1>(&sampler.input(), Dimensions::Scalar)?;
    let values = file.read::<N>(&sampler.output(), dimensions)?;
    let cubic = sampler.interpolation() == Interpolation::CubicSpline;
    let per_key = if cubic { 3 } else { 1 };
    if times.is_empty() || values.len() != times.len() * per_key {
        let message = format!("{} values do not fit {} keys", values.len(), times.len());
        return Err(Found::malformed(Place::Accessor(sampler.output().index()), message));
    }
    let key_time = |key: usize| f64::from(times[key][0]);
    let value = |key: usize, part: usize| values[key * per_key + part].map(f64::from);
    // A cubic key is in-tangent, value, out-tangent.
    let middle = usize::from(cubic);
    let next = times.partition_point(|key| f64::from(key[0]) <= time);
    if next == 0 {
        return Ok(value(0, middle));
    }
    let last = next - 1;
    if next == times.len() {
        return Ok(value(last, middle));
    }
    let span = key_time(next) - key_time(last);
    let t = (time - key_time(last)) / span;
    Ok(match sampler.interpolation() {
        Interpolation::Step => value(last, 0),
        Interpolation::Linear => between(value(last, 0), value(next, 0), t),
        Interpolation::CubicSpline => {
            let [a, b] = [value(last, 1), value(next, 1)];
            let [leaving, arriving] = [value(last, 2), value(next, 0)];
            let (t2, t3) = (t * t, t * t * t);
            std::array::from_fn(|i| {
                (2.0 * t3 - 3.0 * t2 + 1.0) * a[i]
                    + span * (t3 - 2.0 * t2 + t) * leaving[i]
                    + (3.0 * t2 - 2.0 * t3) * b[i]
                    + span * (t3 - t2) * arriving[i]
            })
        }
    })
}

fn lerp(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    DVec3::from(a).lerp(DVec3::from(b), t).to_array()
}

fn slerp(a: [f64; 4], b: [f64; 4], t: f64) -> [f64; 4] {
    let unit = |q: [f64; 4]| DQuat::from_vec4(DVec4::from(q).normalize_or(DVec4::W));
    unit(a).slerp(unit(b), t).to_array()
}
