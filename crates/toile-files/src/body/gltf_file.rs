//! A glTF or GLB file with its buffers, and the numbers of its accessors.

use crate::body::gltf_json::{GltfJson, list};
use crate::body::{gltf_checks, gltf_compressed, gltf_extensions};
use crate::error::{Fault, Found, Place};
use crate::unread::Unread;
use base64::Engine;
use gltf::accessor::sparse::IndexType;
use gltf::accessor::{DataType, Dimensions};
use serde_json::Value;
use std::borrow::Cow;
use std::path::Path;

/// No sparse accessor has more elements that stand for themselves as zero.
const MOST_ZEROS: usize = 1 << 23;

/// A glTF file with its buffers.
pub(crate) struct GltfFile {
    pub document: gltf::Document,
    /// Whether the file hides a node and all below it.
    pub hidden: Vec<bool>,
    buffers: Vec<Vec<u8>>,
}

impl GltfFile {
    /// Opens the bytes of a .gltf or .glb file; buffers in files of their own lie relative to the folder.
    pub fn open(bytes: &[u8], folder: Option<&Path>, unread: &mut Unread) -> Result<Self, Found> {
        let (text, mut blob) = match bytes.starts_with(b"glTF") {
            true => chunks(bytes, unread)?,
            false => (bytes, None),
        };
        let mut json = GltfJson::read(text)?;
        gltf_extensions::check(&json.root, unread)?;
        let fallbacks = gltf_compressed::fallbacks(&json.root);
        let mut buffers = list(&json.root, "buffers")
            .map(|(number, buffer)| load(number, buffer, fallbacks[number], &mut blob, folder))
            .collect::<Result<Vec<_>, Found>>()?;
        gltf_compressed::decode(&mut json.root, &mut buffers)?;
        let hidden = json.hidden(unread);
        let root = json.typed(unread)?;
        gltf_checks::check(&root)?;
        Ok(Self { document: gltf::Document::from_json_without_validation(root), hidden, buffers })
    }

    /// The numbers of an accessor, N per element. Normalised integers become 0..1 or −1..1.
    pub fn read<const N: usize>(
        &self,
        accessor: &gltf::Accessor<'_>,
        dimensions: Dimensions,
    ) -> Result<Vec<[f32; N]>, Found> {
        let normalise = if accessor.normalized() { integer_range(accessor.data_type()) } else { 1.0 };
        self.decode(accessor, dimensions, |bytes| {
            let value = match accessor.data_type() {
                DataType::F32 => f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
                DataType::I8 => f32::from(i8::from_le_bytes([bytes[0]])),
                DataType::I16 => f32::from(i16::from_le_bytes([bytes[0], bytes[1]])),
                _ => unsigned(bytes) as f32,
            };
            (value / normalise).max(if normalise > 1.0 { -1.0 } else { f32::NEG_INFINITY })
        })
    }

    /// The indices of an accessor, N per element.
    pub fn read_indices<const N: usize>(
        &self,
        accessor: &gltf::Accessor<'_>,
        dimensions: Dimensions,
    ) -> Result<Vec<[u32; N]>, Found> {
        if !matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32) {
            let place = Place::Accessor(accessor.index());
            return Err(Found::malformed(place, "indices must be unsigned integers"));
        }
        self.decode(accessor, dimensions, unsigned)
    }

    fn decode<T: Copy + Default, const N: usize>(
        &self,
        accessor: &gltf::Accessor<'_>,
        dimensions: Dimensions,
        value: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<[T; N]>, Found> {
        let place = Place::Accessor(accessor.index());
        if accessor.dimensions() != dimensions {
            let message = format!("it must be {dimensions:?} and is {:?}", accessor.dimensions());
            return Err(Found::malformed(place, message));
        }
        let size = accessor.data_type().size();
        let element = size * N;
        let count = accessor.count();
        let values = |chunk: &[u8]| std::array::from_fn(|i| value(&chunk[i * size..(i + 1) * size]));
        let mut elements: Vec<[T; N]> = match accessor.view() {
            Some(view) => {
                let stride = view.stride().unwrap_or(element);
                let bytes = self.elements(&view, accessor.offset(), [stride, element], count, &place)?;
                bytes.chunks(stride).map(values).collect()
            }
            // The format says so, with or without elements that are given sparsely.
            None => {
                // These zeros take no place in the file that could bound their number.
                check_most("accessor", "elements without data", count, MOST_ZEROS)?;
                vec![[T::default(); N]; count]
            }
        };
        if let Some(sparse) = accessor.sparse() {
            let (indices, new) = (sparse.indices(), sparse.values());
            let index_size = match indices.index_type() {
                IndexType::U8 => 1,
                IndexType::U16 => 2,
                IndexType::U32 => 4,
            };
            let (view, widths) = (indices.view(), [index_size; 2]);
            let indices = self.elements(&view, indices.offset(), widths, sparse.count(), &place)?;
            let new = self.elements(&new.view(), new.offset(), [element; 2], sparse.count(), &place)?;
            for (index, new) in indices.chunks(index_size).zip(new.chunks(element)) {
                let index = unsigned(index);
                let Some(element) = elements.get_mut(index as usize) else {
                    let fault = Fault::OutOfRange { what: "element", index: i64::from(index), count };
                    return Err(Found::at(place, fault));
                };
                *element = values(new);
            }
        }
        Ok(elements)
    }

    /// The bytes of `count` elements of a view, `stride` apart and each of a size.
    fn elements(
        &self,
        view: &gltf::buffer::View<'_>,
        offset: usize,
        [stride, element]: [usize; 2],
        count: usize,
        place: &Place,
    ) -> Result<&[u8], Found> {
        if stride < element {
            let message = format!("its stride of {stride} bytes is below the {element} of an element");
            return Err(Found::malformed(place.clone(), message));
        }
        let buffer = &self.buffers[view.buffer().index()];
        let start = view.offset() as u128 + offset as u128;
        let view_end = (view.offset() as u128 + view.length() as u128).min(buffer.len() as u128);
        let needed = match count {
            0 => return Ok(&[]),
            _ => (count as u128 - 1) * stride as u128 + element as u128,
        };
        if start + needed > view_end {
            let what = format!("an accessor of {count} elements");
            let available = view_end.saturating_sub(start) as usize;
            return Err(Found::at(place.clone(), Fault::Truncated { what, needed, available }));
        }
        Ok(&buffer[start as usize..(start + needed) as usize])
    }
}

/// Refuses what a small file can ask for in any number.
pub(crate) fn check_most(whole: &str, what: &str, count: usize, most: usize) -> Result<(), Found> {
    if count <= most {
        return Ok(());
    }
    Err(Fault::Unsupported(format!("a {whole} of more than {most} {what}")).into())
}

fn unsigned(bytes: &[u8]) -> u32 {
    bytes.iter().rev().fold(0, |value, byte| (value << 8) | u32::from(*byte))
}

/// The integer that stands for 1 in a normalised accessor.
fn integer_range(data_type: DataType) -> f32 {
    match data_type {
        DataType::I8 => 127.0,
        DataType::U8 => 255.0,
        DataType::I16 => 32_767.0,
        DataType::U16 => 65_535.0,
        DataType::U32 | DataType::F32 => 1.0,
    }
}

/// The JSON and the binary chunk of a GLB. The lengths that it declares are compared with the file, so that the message can
/// say what is missing and where.
fn chunks<'a>(bytes: &'a [u8], unread: &mut Unread) -> Result<(&'a [u8], Option<&'a [u8]>), Found> {
    let word = |at: usize| bytes.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize);
    let truncated = |at: usize, what: &str, needed: usize| {
        let available = bytes.len().saturating_sub(at);
        Found::at(
            Place::Byte(at.min(bytes.len())),
            Fault::Truncated { what: what.into(), needed: needed as u128, available },
        )
    };
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(truncated(0, "the GLB header", 12));
    };
    if version != 2 {
        return Err(Found::malformed(Place::Byte(4), format!("GLB version {version} is not 2: export it as glTF 2.0")));
    }
    if length > bytes.len() {
        return Err(truncated(0, "the GLB file by its header", length));
    }
    if length < 12 {
        let message = format!("the GLB header declares {length} bytes, less than the header itself");
        return Err(Found::malformed(Place::Byte(8), message));
    }
    let (mut text, mut blob) = (None, None);
    let mut at = 12;
    while at < length {
        let (Some(chunk), Some(kind)) = (word(at), bytes.get(at + 4..at + 8)) else {
            return Err(truncated(at, "a GLB chunk header", 8));
        };
        if chunk > length.saturating_sub(at + 8) {
            return Err(truncated(at + 8, "a GLB chunk", chunk));
        }
        let data = &bytes[at + 8..at + 8 + chunk];
        match kind {
            b"JSON" if text.is_none() => text = Some(data),
            b"BIN\0" if text.is_some() && blob.is_none() => blob = Some(data),
            _ => {
                let kind = String::from_utf8_lossy(kind).trim_end_matches('\0').to_owned();
                unread.note(&format!("a chunk of the type {kind:?}"), || Place::Byte(at));
            }
        }
        at += 8 + chunk;
    }
    if length < bytes.len() {
        unread.note("what follows the GLB by its header", || Place::Byte(length));
    }
    match text {
        Some(text) => Ok((text, blob)),
        None => Err(Found::malformed(Place::Byte(12), "the GLB has no chunk of the type JSON")),
    }
}

/// The bytes of a buffer: the binary chunk of a GLB for the first one that names no other place. A fallback has none.
fn load(
    number: usize,
    buffer: &Value,
    is_fallback: bool,
    blob: &mut Option<&[u8]>,
    folder: Option<&Path>,
) -> Result<Vec<u8>, Found> {
    if is_fallback {
        return Ok(Vec::new());
    }
    let what = format!("buffer {number}");
    let data = match buffer.get("uri").and_then(Value::as_str) {
        Some(uri) => read_uri(uri, &what, folder)?,
        None => {
            let absent = || Found::malformed(Place::File, format!("{what} is not in the file"));
            blob.take().ok_or_else(absent)?.to_vec()
        }
    };
    let length = buffer.get("byteLength").and_then(Value::as_u64).unwrap_or_default();
    if (data.len() as u64) < length {
        return Err(Fault::Truncated { what, needed: u128::from(length), available: data.len() }.into());
    }
    Ok(data)
}

fn read_uri(uri: &str, what: &str, folder: Option<&Path>) -> Result<Vec<u8>, Found> {
    if uri.starts_with("http:") || uri.starts_with("https:") {
        let message = format!("{what} lies on the web at \"{uri:.100}\": download it beside the file, or export a GLB");
        return Err(Found::malformed(Place::File, message));
    }
    if let Some(data) = uri.strip_prefix("data:") {
        let Some((_, text)) = data.split_once(";base64,") else {
            let message = format!("the data URI of {what} is not base64");
            return Err(Found::malformed(Place::File, message));
        };
        return base64::engine::general_purpose::STANDARD.decode(text).map_err(|error| {
            let message = format!("the data URI of {what} is not valid base64: {error}");
            Found::malformed(Place::File, message)
        });
    }
    let Some(folder) = folder else {
        let message = format!("{what} lies in the file \"{uri}\", which bytes in memory cannot have");
        return Err(Found::malformed(Place::File, message));
    };
    let name: Cow<'_, str> = percent_encoding::percent_decode_str(uri).decode_utf8_lossy();
    crate::source::read_bytes(&folder.join(name.as_ref()))
        .map_err(|error| Found::malformed(Place::File, format!("{what} cannot be read: {error}")))
}
