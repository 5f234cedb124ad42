//! The JSON of a glTF file: what the shape does not need is taken out, what is not read is told, the rest is typed.

use crate::body::gltf_extensions;
use crate::error::{Fault, Found, Place};
use crate::source;
use crate::unread::{Unread, shortened};
use gltf::json;
use serde_json::{Map, Value, json as value};
use std::borrow::Cow;

/// So many objects may a JSON have, and one more for so many bytes: each takes some hundreds of bytes once it is typed.
const MOST_OBJECTS: [usize; 2] = [1 << 17, 32];

/// So many values in all.
const MOST_VALUES: [usize; 2] = [1 << 20, 8];

/// Keys of the format that say nothing about the shape, each with its reason.
const NEEDLESS: [(&str, &str); 6] = [
    ("materials", "how surfaces look"),
    ("textures", "how surfaces look"),
    ("images", "how surfaces look"),
    ("samplers", "how textures are sampled"),
    ("cameras", "from where a picture is taken"),
    ("extensions", "what extensions share; those that touch the shape are told by their names"),
];

/// A kind of object, with the keys that are read or known to say nothing, and the kinds of the objects in it.
struct Kind {
    name: &'static str,
    keys: &'static [&'static str],
    parts: &'static [(&'static str, &'static Kind)],
}

/// Keys that every object may have; what lies in them is no part of the format itself.
const COMMON: [&str; 3] = ["name", "extensions", "extras"];

#[rustfmt::skip]
static FILE: Kind = Kind {
    name: "file",
    keys: &["accessors", "animations", "asset", "bufferViews", "buffers", "extensionsRequired", "extensionsUsed", "meshes",
        "nodes", "scene", "scenes", "skins"],
    parts: &[("accessors", &ACCESSOR), ("animations", &ANIMATION), ("asset", &ASSET), ("bufferViews", &BUFFER_VIEW),
        ("buffers", &BUFFER), ("meshes", &MESH), ("nodes", &NODE), ("scenes", &SCENE), ("skins", &SKIN)],
};
static ASSET: Kind = Kind { name: "asset", keys: &["version", "minVersion", "generator", "copyright"], parts: &[] };
/// The bounds follow from the numbers.
static ACCESSOR: Kind = Kind {
    name: "accessor",
    keys: &["bufferView", "byteOffset", "componentType", "normalized", "count", "type", "max", "min", "sparse"],
    parts: &[("sparse", &SPARSE)],
};
static SPARSE: Kind = Kind {
    name: "sparse accessor",
    keys: &["count", "indices", "values"],
    parts: &[("indices", &SPARSE_PART), ("values", &SPARSE_PART)],
};
static SPARSE_PART: Kind =
    Kind { name: "sparse accessor", keys: &["bufferView", "byteOffset", "componentType"], parts: &[] };
/// The target is the use for which a device holds it.
static BUFFER_VIEW: Kind =
    Kind { name: "buffer view", keys: &["buffer", "byteOffset", "byteLength", "byteStride", "target"], parts: &[] };
static BUFFER: Kind = Kind { name: "buffer", keys: &["uri", "byteLength"], parts: &[] };
static MESH: Kind = Kind { name: "mesh", keys: &["primitives", "weights"], parts: &[("primitives", &PRIMITIVE)] };
/// Materials say how it looks.
static PRIMITIVE: Kind =
    Kind { name: "primitive", keys: &["attributes", "indices", "material", "mode", "targets"], parts: &[] };
/// Cameras say from where a picture is taken.
static NODE: Kind = Kind {
    name: "node",
    keys: &["camera", "children", "skin", "matrix", "mesh", "rotation", "scale", "translation", "weights"],
    parts: &[],
};
static SCENE: Kind = Kind { name: "scene", keys: &["nodes"], parts: &[] };
/// The skeleton is the root that the joints have in common; joints themselves say where they are.
static SKIN: Kind = Kind { name: "skin", keys: &["inverseBindMatrices", "skeleton", "joints"], parts: &[] };
static ANIMATION: Kind = Kind {
    name: "animation",
    keys: &["channels", "samplers"],
    parts: &[("channels", &CHANNEL), ("samplers", &SAMPLER)],
};
static CHANNEL: Kind = Kind { name: "channel", keys: &["sampler", "target"], parts: &[("target", &TARGET)] };
static TARGET: Kind = Kind { name: "channel", keys: &["node", "path"], parts: &[] };
static SAMPLER: Kind = Kind { name: "sampler", keys: &["input", "interpolation", "output"], parts: &[] };

/// Attributes of a vertex that are read.
const SHAPE: [&str; 4] = ["POSITION", "NORMAL", "JOINTS_", "WEIGHTS_"];

/// Attributes of a vertex by which materials are drawn.
const SHAPELESS: [&str; 3] = ["TANGENT", "TEXCOORD_", "COLOR_"];

/// The JSON of a glTF file.
pub(crate) struct GltfJson<'a> {
    /// Without what the shape does not need.
    pub root: Value,
    text: Cow<'a, [u8]>,
}

impl<'a> GltfJson<'a> {
    /// Reads the text, and refuses what cannot be read.
    pub fn read(text: &'a [u8]) -> Result<Self, Found> {
        // The format has no byte order mark and is padded by spaces, but editors and exporters write marks and zeros.
        let length = |text: &[u8]| text.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
        let text = match source::utf8(text) {
            Cow::Borrowed(text) => Cow::Borrowed(&text[..length(text)]),
            Cow::Owned(mut text) => {
                text.truncate(length(&text));
                Cow::Owned(text)
            }
        };
        check_size(&text)?;
        let mut root: Value = serde_json::from_slice(&text).map_err(invalid)?;
        check_version(&root)?;
        if let Some(root) = root.as_object_mut() {
            NEEDLESS.iter().for_each(|(key, _)| drop(root.remove(*key)));
        }
        Ok(Self { root, text })
    }

    /// The nodes that the file hides, each with all below it.
    pub fn hidden(&self, unread: &mut Unread) -> Vec<bool> {
        hidden(&self.root, unread)
    }

    /// The types of the crate; notes what is not read.
    pub fn typed(mut self, unread: &mut Unread) -> Result<json::Root, Found> {
        check_instances(&self.root)?;
        move_pointers(&mut self.root, unread);
        strip(&mut self.root, &FILE, &mut Vec::new(), unread);
        // The text has places where the values have none, and most often the same fault.
        json::deserialize::from_value(self.root)
            .map_err(|error| invalid(json::Root::from_slice(&self.text).err().unwrap_or(error)))
    }
}

fn invalid(error: serde_json::Error) -> Found {
    let message = error.to_string();
    let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(start, _)| start);
    let place = if error.line() == 0 { Place::File } else { Place::Column(error.line(), error.column()) };
    Found::malformed(place, format!("the glTF JSON is not valid: {message}"))
}

/// Refuses more than a body needs: a small file could ask for any memory.
fn check_size(text: &[u8]) -> Result<(), Found> {
    let (mut object_count, mut value_count, mut in_string, mut escaped) = (0, 0, false, false);
    for byte in text {
        match byte {
            _ if escaped => escaped = false,
            b'\\' if in_string => escaped = true,
            b'"' => in_string = !in_string,
            b',' | b'[' if !in_string => value_count += 1,
            b'{' if !in_string => object_count += 1,
            _ => {}
        }
    }
    for (what, count, [most, bytes]) in [("objects", object_count, MOST_OBJECTS), ("values", value_count, MOST_VALUES)]
    {
        let most = most + text.len() / bytes;
        if count > most {
            return Err(Fault::Unsupported(format!("a glTF JSON of more than {most} {what}")).into());
        }
    }
    Ok(())
}

fn check_version(root: &Value) -> Result<(), Found> {
    let asset = |key: &str| root.pointer(&format!("/asset/{key}")).and_then(Value::as_str);
    let needed = asset("minVersion").or_else(|| asset("version"));
    match needed.and_then(|version| version.split('.').next()) {
        None | Some("2") => Ok(()),
        Some(_) => {
            let version = needed.unwrap_or_default();
            let message = format!("it is glTF {version:.20}: export it as glTF 2.0");
            Err(Found::malformed(Place::Key("asset.version".into()), message))
        }
    }
}

/// The items of a list with their numbers.
pub(crate) fn list<'a>(value: &'a Value, key: &str) -> impl Iterator<Item = (usize, &'a Value)> {
    value.get(key).and_then(Value::as_array).into_iter().flatten().enumerate()
}

/// The item of a list that an index names.
pub(crate) fn item<'a>(root: &'a Value, key: &str, index: &Value) -> Option<&'a Value> {
    root.get(key)?.get(usize::try_from(index.as_u64()?).ok()?)
}

/// Refuses meshes that an extension repeats.
fn check_instances(root: &Value) -> Result<(), Found> {
    const INSTANCING: &str = "EXT_mesh_gpu_instancing";
    let repeats = |node: &Value| {
        node.get("mesh").is_some()
            && node.get("extensions").is_some_and(|extensions| extensions.get(INSTANCING).is_some())
    };
    match list(root, "nodes").find(|(_, node)| repeats(node)) {
        Some((number, _)) => Err(gltf_extensions::refuse(&format!("nodes[{number}]"), INSTANCING)),
        None => Ok(()),
    }
}

/// The nodes that the file hides.
fn hidden(root: &Value, unread: &mut Unread) -> Vec<bool> {
    let visible = |node: &Value| node.pointer("/extensions/KHR_node_visibility/visible").and_then(Value::as_bool);
    let hidden: Vec<bool> = list(root, "nodes").map(|(_, node)| visible(node) == Some(false)).collect();
    if let Some(first) = hidden.iter().position(|hidden| *hidden) {
        unread.note("what KHR_node_visibility hides", || Place::Node(first));
    }
    hidden
}

/// Turns channels that name what they move by a pointer (KHR_animation_pointer) into those of the format itself.
fn move_pointers(root: &mut Value, unread: &mut Unread) {
    /// What may move without any change of the shape: looks, cameras and lights.
    const LOOKS: [&str; 4] = ["/materials/", "/cameras/", "/extensions/KHR_lights_punctual/", "/textures/"];
    let animations = root.get_mut("animations").and_then(Value::as_array_mut).into_iter().flatten();
    for (number, animation) in animations.enumerate() {
        let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) else { continue };
        let mut at = 0..;
        channels.retain_mut(|channel| {
            let place = Place::Key(format!("animations[{number}].channels[{}]", at.next().unwrap_or_default()));
            let Some(target) = channel.get_mut("target").filter(|target| target.is_object()) else { return true };
            if target.get("path").and_then(Value::as_str) != Some("pointer") {
                if target.get("node").is_none() {
                    unread.note("a channel that names no node", || place);
                    return false;
                }
                return true;
            }
            let pointer = target.pointer("/extensions/KHR_animation_pointer/pointer").and_then(Value::as_str);
            let pointer = pointer.unwrap_or_default().to_owned();
            let moved = match pointer.split('/').collect::<Vec<_>>()[..] {
                ["", "nodes", node, path @ ("translation" | "rotation" | "scale" | "weights")] => {
                    node.parse::<u32>().ok().map(|node| (node, path))
                }
                _ => None,
            };
            if let Some((node, path)) = moved {
                *target = value!({ "node": node, "path": path });
            } else if !LOOKS.iter().any(|start| pointer.starts_with(start)) {
                unread.note(&format!("the motion of \"{}\"", shortened(&pointer)), || place);
            }
            moved.is_some()
        });
    }
}

/// Takes out what the shape does not need, so that nothing is checked that is not read, and notes keys that are not known.
fn strip(value: &mut Value, kind: &'static Kind, path: &mut Vec<String>, unread: &mut Unread) {
    let place = |path: &[String]| if path.is_empty() { Place::File } else { Place::Key(path.concat()) };
    let Some(object) = value.as_object_mut() else { return };
    if let Some(extensions) = object.remove("extensions") {
        for name in extensions.as_object().into_iter().flat_map(Map::keys) {
            if !gltf_extensions::is_known(name) {
                unread.note(&format!("the extension {}", shortened(name)), || place(path));
            }
        }
    }
    for key in ["extras", "material", "camera", "extensionsRequired", "extensionsUsed"] {
        object.remove(key);
    }
    for key in object.keys().filter(|key| !kind.keys.contains(&key.as_str()) && !COMMON.contains(&key.as_str())) {
        unread.note(&format!("the key \"{}\" of a {}", shortened(key), kind.name), || place(path));
    }
    let targets = object.get_mut("targets").and_then(Value::as_array_mut).map(|targets| targets.iter_mut());
    let targets: Vec<&mut Value> = targets.into_iter().flatten().collect();
    for attributes in targets {
        keep_shape(attributes, &place(path), unread);
    }
    if let Some(attributes) = object.get_mut("attributes") {
        keep_shape(attributes, &place(path), unread);
    }
    for (key, part) in kind.parts {
        let dot = if path.is_empty() { "" } else { "." };
        match object.get_mut(*key) {
            Some(Value::Array(items)) => {
                for (number, item) in items.iter_mut().enumerate() {
                    path.push(format!("{dot}{key}[{number}]"));
                    strip(item, part, path, unread);
                    path.pop();
                }
            }
            Some(item) => {
                path.push(format!("{dot}{key}"));
                strip(item, part, path, unread);
                path.pop();
            }
            None => {}
        }
    }
}

/// Takes out the attributes that do not touch the shape, and notes those that are not known.
fn keep_shape(attributes: &mut Value, place: &Place, unread: &mut Unread) {
    let Some(attributes) = attributes.as_object_mut() else { return };
    let starts = |name: &str, known: &[&str]| known.iter().any(|known| name.starts_with(known));
    attributes.retain(|name, _| {
        // What begins with a line is a program's own.
        if !starts(name, &SHAPE) && !starts(name, &SHAPELESS) && !name.starts_with('_') {
            unread.note(&format!("the attribute \"{}\"", shortened(name)), || place.clone());
        }
        starts(name, &SHAPE)
    });
}
