//! Compressed numbers of a glTF file: they are decoded into further buffers, and the JSON is led to these.

use crate::body::gltf_json::{item, list};
use crate::error::{Fault, Found, Place};
use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};
use meshoptimizer_rs::codec::{
    BufferView, Filter, Mode, decode_filter_exp, decode_filter_oct, decode_filter_quat, decode_vertex_buffer,
};
use meshoptimizer_rs::{Error, Limits, Workspace};
use serde_json::{Value, json};

const DRACO: &str = "KHR_draco_mesh_compression";

/// One and the same under three names.
const MESHOPT: [&str; 3] = ["KHR_meshopt_compression", "EXT_meshopt_compression", "MESHOPT_compression"];

/// So many bytes may a file decode to, and [`DECODED_PER_BYTE`] more for each that it has. A few bytes can ask for any number.
const DECODED: usize = 64 << 20;

const DECODED_PER_BYTE: usize = 4;

/// No body has more vertices or triangles.
const MOST: u64 = 1 << 23;

fn extension<'a>(value: &'a Value, name: &str) -> Option<&'a Value> {
    value.get("extensions")?.get(name)
}

/// Of each buffer, whether it is only for programs that know no compression: so it says, or it has no place of its own and
/// all that lies in it is compressed.
pub(crate) fn fallbacks(root: &Value) -> Vec<bool> {
    let is_tagged = |buffer: &Value| {
        let tag = MESHOPT.iter().find_map(|name| extension(buffer, name)?.get("fallback")?.as_bool());
        tag.unwrap_or_default()
    };
    let count = list(root, "buffers").count();
    let (mut is_named, mut is_needed) = (vec![false; count], vec![false; count]);
    let number_in = |object: &Value| {
        let number = object.get("buffer").and_then(Value::as_u64).and_then(|number| usize::try_from(number).ok());
        number.filter(|number| *number < count)
    };
    for (_, view) in list(root, "bufferViews") {
        let packed = MESHOPT.iter().find_map(|name| extension(view, name));
        if let Some(number) = number_in(view) {
            is_named[number] = true;
        }
        if let Some(number) = number_in(packed.unwrap_or(view)) {
            is_needed[number] = true;
        }
    }
    let is_fallback = |(number, buffer): (usize, &Value)| {
        is_tagged(buffer) || (buffer.get("uri").is_none() && is_named[number] && !is_needed[number])
    };
    list(root, "buffers").map(is_fallback).collect()
}

/// Decodes what is compressed. Indices that lead nowhere are left to the checks of the whole file.
pub(crate) fn decode(root: &mut Value, buffers: &mut Vec<Vec<u8>>) -> Result<(), Found> {
    let file_size: usize = buffers.iter().map(Vec::len).sum();
    let mut budget = DECODED + DECODED_PER_BYTE * file_size;
    decode_views(root, buffers, &mut budget)?;
    decode_meshes(root, buffers, &mut budget)
}

fn damaged(place: &str, name: &str, error: impl std::fmt::Display) -> Found {
    let message = format!("what {name} compressed cannot be decoded ({error}): export it without compression");
    Found::malformed(Place::Key(place.into()), message)
}

/// Adds a buffer and a view of all of it; gives the number of the view.
fn add_view(root: &mut Value, buffers: &mut Vec<Vec<u8>>, data: Vec<u8>) -> Option<usize> {
    root.get_mut("buffers")?.as_array_mut()?.push(json!({ "byteLength": data.len() }));
    let views = root.get_mut("bufferViews")?.as_array_mut()?;
    views.push(json!({ "buffer": buffers.len(), "byteLength": data.len() }));
    buffers.push(data);
    Some(views.len() - 1)
}

/// The bytes that an object with buffer, offset and length names.
fn bytes<'a>(object: &Value, buffers: &'a [Vec<u8>]) -> Option<&'a [u8]> {
    let number = |key: &str| usize::try_from(object.get(key)?.as_u64()?).ok();
    let offset = number("byteOffset").unwrap_or_default();
    buffers.get(number("buffer")?)?.get(offset..offset.checked_add(number("byteLength")?)?)
}

fn decode_views(root: &mut Value, buffers: &mut Vec<Vec<u8>>, budget: &mut usize) -> Result<(), Found> {
    for number in 0..list(root, "bufferViews").count() {
        let view = &root["bufferViews"][number];
        let Some((name, packed)) = MESHOPT.iter().find_map(|name| Some((*name, extension(view, name)?))) else {
            continue;
        };
        let place = format!("bufferViews[{number}]");
        let text = |key: &str| packed.get(key).and_then(Value::as_str);
        let count = |key: &str| packed.get(key).and_then(Value::as_u64).and_then(|count| usize::try_from(count).ok());
        // Of colours, which need not be decoded.
        if text("filter") == Some("COLOR") {
            continue;
        }
        let Some(source) = bytes(packed, buffers) else {
            return Err(damaged(&place, name, "its bytes are not in the file"));
        };
        let limits = Limits { max_bytes: *budget, ..Limits::default() };
        let layout = [count("count"), count("byteStride")].map(Option::unwrap_or_default);
        let names = [text("mode").unwrap_or_default(), text("filter").unwrap_or("NONE")];
        let decoded = decode_view(names, layout, source, &mut Workspace::new(limits));
        let decoded = decoded.map_err(|error| damaged(&place, name, error))?;
        *budget = budget.saturating_sub(decoded.len());
        let length = decoded.len();
        let Some(buffer) = add_view(root, buffers, decoded).map(|_| buffers.len() - 1) else { continue };
        let view = &mut root["bufferViews"][number];
        view["buffer"] = buffer.into();
        view["byteOffset"] = 0.into();
        view["byteLength"] = length.into();
    }
    Ok(())
}

/// A view by its mode and filter, the number of its elements, and the bytes of each. Of both versions of the codec: the
/// newer extension allows both, and exporters write the newer one under the older name.
fn decode_view(
    [mode, filter]: [&str; 2],
    [count, stride]: [usize; 2],
    source: &[u8],
    workspace: &mut Workspace,
) -> Result<Vec<u8>, Error> {
    let (mode, filter) = (Mode::parse(mode)?, Filter::parse(filter)?);
    let view = BufferView::new(mode, filter, count, stride)?;
    if mode != Mode::Attributes {
        return view.decode(source, workspace);
    }
    let mut data = decode_vertex_buffer(count, stride, source, workspace)?;
    match filter {
        Filter::None => {}
        Filter::Octahedral => decode_filter_oct(&mut data, count, stride, workspace)?,
        Filter::Quaternion => decode_filter_quat(&mut data, count, stride, workspace)?,
        Filter::Exponential => decode_filter_exp(&mut data, count, stride, workspace)?,
    }
    Ok(data)
}

fn decode_meshes(root: &mut Value, buffers: &mut Vec<Vec<u8>>, budget: &mut usize) -> Result<(), Found> {
    for mesh in 0..list(root, "meshes").count() {
        for part in 0..list(&root["meshes"][mesh], "primitives").count() {
            let primitive = &root["meshes"][mesh]["primitives"][part];
            if extension(primitive, DRACO).is_some() && needs_decoding(root, primitive) {
                let place = format!("meshes[{mesh}].primitives[{part}]");
                let primitive = decode_primitive(root, &primitive.clone(), buffers, budget, &place)?;
                root["meshes"][mesh]["primitives"][part] = primitive;
            }
        }
    }
    Ok(())
}

/// Whether a primitive has numbers that lie in the compressed mesh alone.
fn needs_decoding(root: &Value, primitive: &Value) -> bool {
    let attributes = primitive.get("attributes").and_then(Value::as_object).into_iter().flat_map(|map| map.values());
    let is_empty = |index: &Value| {
        item(root, "accessors", index)
            .is_some_and(|accessor| accessor.get("bufferView").is_none() && accessor.get("sparse").is_none())
    };
    attributes.chain(primitive.get("indices")).any(is_empty)
}

/// The primitive with accessors of decoded numbers.
fn decode_primitive(
    root: &mut Value,
    primitive: &Value,
    buffers: &mut Vec<Vec<u8>>,
    budget: &mut usize,
    place: &str,
) -> Result<Value, Found> {
    let packed = extension(primitive, DRACO).unwrap_or(&Value::Null);
    let view = packed.get("bufferView").and_then(|view| item(root, "bufferViews", view));
    let Some(source) = view.and_then(|view| bytes(view, buffers)) else {
        return Err(damaged(place, DRACO, "its bytes are not in the file"));
    };
    let mut limits = DecodeLimits::default();
    (limits.max_points, limits.max_faces, limits.max_decoded_bytes) = (MOST, MOST, *budget as u64);
    let mut mesh = Mesh::new();
    MeshDecoder::new()
        .decode(&mut DecoderBuffer::new(source).with_limits(limits), &mut mesh)
        .map_err(|error| damaged(place, DRACO, error))?;
    let point_count = mesh.num_points();
    let corners = || mesh.faces().iter().flatten().map(|corner| corner.0);
    if corners().any(|corner| corner as usize >= point_count) {
        return Err(damaged(place, DRACO, "a triangle has a corner that is no vertex"));
    }
    let mut decoded = primitive.clone();
    let mut add = |root: &mut Value, component: u32, kind: &str, count: usize, data: Vec<u8>| {
        if data.len() > *budget {
            return Err(Found::from(Fault::Unsupported("what decodes to more bytes than a body has".into())));
        }
        *budget -= data.len();
        let view = add_view(root, buffers, data);
        let accessor = json!({ "bufferView": view, "componentType": component, "count": count, "type": kind });
        let accessors = root.get_mut("accessors").and_then(Value::as_array_mut);
        let number = accessors.map(|accessors| {
            accessors.push(accessor);
            accessors.len() - 1
        });
        Ok(Value::from(number))
    };
    let indices = add(root, 5125, "SCALAR", 3 * mesh.num_faces(), corners().flat_map(u32::to_le_bytes).collect())?;
    decoded["indices"] = indices;
    // A compressed mesh is a list of triangles.
    decoded["mode"] = 4.into();
    for (name, id) in packed.get("attributes").and_then(Value::as_object).into_iter().flatten() {
        let known = primitive.get("attributes").and_then(|attributes| attributes.get(name));
        let Some(accessor) = known.and_then(|index| item(root, "accessors", index)).cloned() else { continue };
        let id = id.as_u64().and_then(|id| u32::try_from(id).ok());
        let Some(attribute) = id.and_then(|id| mesh.attribute_by_unique_id(id)) else {
            return Err(damaged(place, DRACO, format!("it has no attribute for {name:.40}")));
        };
        let kind = accessor.get("type").and_then(Value::as_str).unwrap_or_default().to_owned();
        let components = match kind.as_str() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            _ => continue,
        };
        let values = attribute.read_f32s(point_count, components);
        // The numbers of joints are whole; all else may be a part of the largest whole number.
        let added = if name.starts_with("JOINTS_") {
            let data = values.iter().flat_map(|value| (*value as u32).to_le_bytes()).collect();
            add(root, 5125, &kind, point_count, data)?
        } else {
            let is_part = accessor.get("normalized").and_then(Value::as_bool).unwrap_or_default();
            let most = match accessor.get("componentType").and_then(Value::as_u64) {
                Some(5120) if is_part => 127.0,
                Some(5121) if is_part => 255.0,
                Some(5122) if is_part => 32_767.0,
                Some(5123) if is_part => 65_535.0,
                _ => 1.0,
            };
            let data =
                values.iter().flat_map(|value| (value / most).max(if is_part { -1.0 } else { f32::MIN }).to_le_bytes());
            add(root, 5126, &kind, point_count, data.collect())?
        };
        decoded["attributes"][name] = added;
    }
    Ok(decoded)
}
