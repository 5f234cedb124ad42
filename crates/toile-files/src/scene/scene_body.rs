//! Bodies of a scene file, at rest and moving.

use crate::body::gltf_rig::DURATION_MAX;
use crate::body::mesh_sequence::read_mesh_sequence;
use crate::body::moving_body::read_moving_body;
use crate::body::{BodyOptions, read_body};
use crate::error::Found;
use crate::scene::problem::Problem;
use crate::scene::scene_toml::{
    BodyToml, BoxToml, CapsuleToml, KeyToml, PlaneToml, SceneToml, SphereToml, SwingToml, UnitsToml,
};
use crate::scene::value::{SIZES, vector, within, wrong};
use glam::{DQuat, DVec3};
use std::path::Path;
use toile_scene::{Body, Form, MovingMesh, RigidKey, RigidMotion, Settings, Shape, ShapeMotion};

/// Reads a body of a scene; the second part is what is unusual about it.
pub(crate) fn convert_body(index: usize, toml: &BodyToml, folder: &Path) -> Result<(Body, Vec<String>), Problem> {
    let key = |name: &str| format!("body.{index}.{name}");
    let metres_per_unit = match toml.units {
        None | Some(UnitsToml::M) => 1.0,
        Some(UnitsToml::Dm) => 0.1,
        Some(UnitsToml::Cm) => 0.01,
        Some(UnitsToml::Mm) => 0.001,
        Some(UnitsToml::In) => 0.0254,
    };
    let time = within(&key("time"), toml.time.unwrap_or(0.0), -DURATION_MAX..=DURATION_MAX, "s")?;
    let options = BodyOptions { metres_per_unit, clip: toml.clip.clone(), time };
    let moving = toml.moving == Some(true);
    let needless = |name: &str, present: bool, why: &str| {
        if present { Err(wrong(&key(name), why)) } else { Ok(()) }
    };
    let (name, body, warnings) = match (&toml.file, &toml.sequence) {
        (Some(_), Some(_)) => return Err(wrong(&key("sequence"), "give either file or sequence, not both").into()),
        (None, None) => return Err(wrong(&key("file"), "it is missing; give file, or sequence with a folder").into()),
        (None, Some(sequence)) => {
            let why = "a sequence has no clip; its files are its motion";
            needless("clip", toml.clip.is_some(), why)?;
            needless("time", toml.time.is_some(), why)?;
            needless("moving", toml.moving.is_some(), "a sequence always moves")?;
            needless("keys", toml.keys.is_some(), "a sequence moves by its files, not by keys")?;
            let rate =
                toml.frame_rate.ok_or_else(|| wrong(&key("frame_rate"), "it is missing; a sequence needs it"))?;
            let rate = within(&key("frame_rate"), rate, Settings::FRAME_RATES, "frames per second")?;
            let read = read_mesh_sequence(&folder.join(sequence), rate, &options)?;
            (sequence, Body::Moving(read.body), read.warnings)
        }
        (Some(file), None) => {
            needless("frame_rate", toml.frame_rate.is_some(), "only a sequence has it; a clip has times of its own")?;
            let path = folder.join(file);
            if moving {
                needless("time", toml.time.is_some(), "a moving body starts its clip at 0; leave it out")?;
                needless("keys", toml.keys.is_some(), "give either moving = true or keys, not both")?;
                let read = read_moving_body(&path, &options)?;
                (file, Body::Moving(read.body), read.warnings)
            } else {
                let keys = toml.keys.as_ref().map(|keys| convert_keys(&key("keys"), keys)).transpose()?;
                let read = read_body(&path, &options)?;
                let body = match keys {
                    Some(keys) => Body::Moving(MovingMesh::rigid(read.mesh, keys)),
                    None => Body::Mesh(read.mesh),
                };
                (file, body, read.warnings)
            }
        }
    };
    Ok((body, warnings.iter().map(|warning| format!("{name}: {warning}")).collect()))
}

/// Converts the shapes of a scene.
pub(crate) fn convert_shapes(toml: &SceneToml) -> Result<Vec<Shape>, Found> {
    let spheres = toml.sphere.iter().enumerate().map(|(index, sphere)| convert_sphere(index, sphere));
    let capsules = toml.capsule.iter().enumerate().map(|(index, capsule)| convert_capsule(index, capsule));
    let planes = toml.plane.iter().enumerate().map(|(index, plane)| convert_plane(index, plane));
    let boxes = toml.cuboid.iter().enumerate().map(|(index, cuboid)| convert_box(index, cuboid));
    spheres.chain(capsules).chain(planes).chain(boxes).collect()
}

/// Converts a sphere of a scene.
fn convert_sphere(index: usize, toml: &SphereToml) -> Result<Shape, Found> {
    let key = |name: &str| format!("sphere.{index}.{name}");
    let motion = convert_motion(&key, &toml.swing, &toml.keys)?;
    let radius = within(&key("radius"), toml.radius, SIZES, "m")?;
    let mut shape = Shape::sphere(vector(&key("centre"), toml.centre)?, radius);
    shape.motion = motion;
    Ok(shape)
}

/// Converts a capsule of a scene.
fn convert_capsule(index: usize, toml: &CapsuleToml) -> Result<Shape, Found> {
    let key = |name: &str| format!("capsule.{index}.{name}");
    let motion = convert_motion(&key, &toml.swing, &toml.keys)?;
    let radius = within(&key("radius"), toml.radius, SIZES, "m")?;
    let ends = [vector(&key("ends.0"), toml.ends[0])?, vector(&key("ends.1"), toml.ends[1])?];
    if !SIZES.contains(&ends[0].distance(ends[1])) {
        let range = format!("{} to {} m", SIZES.start(), SIZES.end());
        return Err(wrong(&key("ends"), format!("they must be {range} apart; a sphere has one centre")));
    }
    let mut shape = Shape::capsule(ends, radius);
    shape.motion = motion;
    Ok(shape)
}

/// Converts a plane of a scene.
fn convert_plane(index: usize, toml: &PlaneToml) -> Result<Shape, Found> {
    let key = |name: &str| format!("plane.{index}.{name}");
    let motion = convert_motion(&key, &toml.swing, &toml.keys)?;
    let normal = vector(&key("normal"), toml.normal)?.try_normalize();
    let normal = normal.ok_or_else(|| wrong(&key("normal"), "it must be a direction out of the plane, not zero"))?;
    let mut shape = Shape::plane(vector(&key("point"), toml.point)?, normal);
    shape.motion = motion;
    Ok(shape)
}

/// Converts a box of a scene.
fn convert_box(index: usize, toml: &BoxToml) -> Result<Shape, Found> {
    let key = |name: &str| format!("box.{index}.{name}");
    let motion = convert_motion(&key, &toml.swing, &toml.keys)?;
    for size in toml.size {
        within(&key("size"), size, SIZES, "m")?;
    }
    let size = DVec3::from(toml.size);
    let half_size = 0.5 * size;
    let radius = within(&key("radius"), toml.radius.unwrap_or(0.0), 0.0..=half_size.min_element(), "m")?;
    let rotation = convert_rotation(&key("rotation"), toml.rotation)?;
    let mut shape = Shape::cuboid(vector(&key("centre"), toml.centre)?, size, radius);
    shape.form = Form::Box { half_size, rotation, radius };
    shape.motion = motion;
    Ok(shape)
}

/// Converts an axis and an angle in degrees.
fn convert_rotation(key: &str, toml: Option<[f64; 4]>) -> Result<DQuat, Found> {
    let Some([x, y, z, degrees]) = toml else { return Ok(DQuat::IDENTITY) };
    let axis = vector(key, [x, y, z])?.try_normalize().filter(|_| degrees.is_finite());
    let axis = axis.ok_or_else(|| wrong(key, "it must be an axis x, y, z and an angle in degrees"))?;
    Ok(DQuat::from_axis_angle(axis, degrees.to_radians()))
}

/// Converts the motion of a shape, whose keys `key` names.
fn convert_motion(
    key: &impl Fn(&str) -> String,
    swing: &Option<SwingToml>,
    keys: &Option<Vec<KeyToml>>,
) -> Result<ShapeMotion, Found> {
    match (swing, keys) {
        (None, None) => Ok(ShapeMotion::Still),
        (Some(_), Some(_)) => Err(wrong(&key("keys"), "give either swing or keys, not both")),
        (Some(swing), None) => Ok(ShapeMotion::Swing {
            amplitude: vector(&key("swing.amplitude"), swing.amplitude)?,
            period: within(&key("swing.period"), swing.period, SIZES, "s")?,
        }),
        (None, Some(keys)) => Ok(ShapeMotion::Keys(RigidMotion { keys: convert_keys(&key("keys"), keys)? })),
    }
}

fn convert_keys(key: &str, toml: &[KeyToml]) -> Result<Vec<RigidKey>, Found> {
    if toml.is_empty() {
        return Err(wrong(key, "it has no key; leave it out for a body at rest"));
    }
    let mut keys: Vec<RigidKey> = Vec::with_capacity(toml.len());
    for (number, entry) in toml.iter().enumerate() {
        let name = |part: &str| format!("{key}.{number}.{part}");
        within(&name("time"), entry.time, -DURATION_MAX..=DURATION_MAX, "s")?;
        if keys.last().is_some_and(|last| entry.time <= last.time) {
            let message = format!("it is {} and must be a time after the key before", entry.time);
            return Err(wrong(&name("time"), message));
        }
        let rotation = convert_rotation(&name("rotation"), entry.rotation)?;
        let turn = number.checked_sub(1).map_or(0.0, |last| turn_between(toml[last].rotation, entry.rotation));
        if turn >= 180.0 {
            let message = format!(
                "it turns by {turn} degrees from the key before, at most 179 are possible: give keys in between"
            );
            return Err(wrong(&name("rotation"), message));
        }
        let translation = vector(&name("translation"), entry.translation.unwrap_or_default())?;
        keys.push(RigidKey { time: entry.time, translation, rotation });
    }
    Ok(keys)
}

/// Angle in degrees that two keys are apart by what they say, which a rotation alone does not tell beyond half a turn;
/// 0 for keys about different axes.
fn turn_between(a: Option<[f64; 4]>, b: Option<[f64; 4]>) -> f64 {
    let (Some([ax, ay, az, from]), Some([bx, by, bz, to])) = (a, b) else {
        return a.or(b).map_or(0.0, |[.., degrees]| degrees.abs());
    };
    let [a, b] = [DVec3::new(ax, ay, az), DVec3::new(bx, by, bz)].map(DVec3::normalize_or_zero);
    let cosine = a.dot(b);
    if cosine.abs() > 0.999_999 { (to - from * cosine.signum()).abs() } else { 0.0 }
}
