//! The checks of a glTF file without which the crate that reads it would panic.

use crate::error::{Fault, Found, Place};
use gltf::json::validation::{Checked, Error, Validate};

/// Refuses what is not valid. What says nothing about the shape is no fault.
pub(crate) fn check(root: &gltf::json::Root) -> Result<(), Found> {
    check_positions(root)?;
    check_channels(root)?;
    check_rest(root)
}

/// The crate's own checks, save what the format allows: bounds of positions, accessors of zeros, primitives without positions.
fn check_rest(root: &gltf::json::Root) -> Result<(), Found> {
    let mut fault = None;
    root.validate(root, gltf::json::Path::new, &mut |path, error| {
        let allowed = error != Error::IndexOutOfBounds && {
            let path = path().to_string();
            let may_be_missing = path.starts_with("accessors") && path.ends_with("].bufferView");
            let ends = ["[\"POSITION\"]", ".min", ".max"];
            may_be_missing || ends.iter().any(|end| path.ends_with(end))
        };
        if fault.is_none() && !allowed {
            fault = Some((path().to_string(), error));
        }
    });
    match fault {
        Some((path, error)) => Err(Found::malformed(Place::Key(path), format!("the glTF is not valid: {error}"))),
        None => Ok(()),
    }
}

/// The validation of the crate indexes the accessors of positions without a look at their number, and would panic.
fn check_positions(root: &gltf::json::Root) -> Result<(), Found> {
    let count = root.accessors.len();
    let positions = Checked::Valid(gltf::Semantic::Positions);
    for (number, mesh) in root.meshes.iter().enumerate() {
        for primitive in &mesh.primitives {
            let accessor = primitive.attributes.get(&positions).map(|accessor| accessor.value());
            if let Some(accessor) = accessor.filter(|accessor| *accessor >= count) {
                let index = i64::try_from(accessor).unwrap_or(i64::MAX);
                let place = Place::Key(format!("meshes[{number}].primitives.attributes.POSITION"));
                return Err(Found::at(place, Fault::OutOfRange { what: "accessor", index, count }));
            }
        }
    }
    Ok(())
}

/// The validation of the crate passes over what channels of clips move, and reading it would panic.
fn check_channels(root: &gltf::json::Root) -> Result<(), Found> {
    let count = root.nodes.len();
    for (clip, animation) in root.animations.iter().enumerate() {
        for (channel, target) in animation.channels.iter().map(|channel| &channel.target).enumerate() {
            let place = |key: &str| Place::Key(format!("animations[{clip}].channels[{channel}].target.{key}"));
            if matches!(target.path, Checked::Invalid) {
                let message = "a clip moves \"translation\", \"rotation\", \"scale\" or \"weights\"";
                return Err(Found::malformed(place("path"), message));
            }
            if target.node.value() >= count {
                let index = i64::try_from(target.node.value()).unwrap_or(i64::MAX);
                return Err(Found::at(place("node"), Fault::OutOfRange { what: "node", index, count }));
            }
        }
    }
    Ok(())
}
