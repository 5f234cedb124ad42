//! Which format a file has, and what to do with those that are not read.

use crate::error::{Fault, Found, Place};
use crate::source;
use std::path::Path;

/// The formats of bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BodyFormat {
    Obj,
    Ply,
    /// Text or binary.
    Gltf,
}

/// How a file is known that is not read: the bytes that it begins with, the ending of its name, what it is, and what to do.
struct Foreign {
    magic: &'static [u8],
    ending: &'static str,
    what: &'static str,
    advice: &'static str,
}

const EXPORT: &str = "export the body as GLB, PLY or OBJ from the program that wrote it";

const SMPL: &str = "it holds the numbers of a body model, not a surface: pose the model with its own program and save \
                    a GLB with a clip, or an OBJ file for each frame";

#[rustfmt::skip]
const FOREIGN: [Foreign; 26] = [
    Foreign { magic: b"version https://git-lfs", ending: "", what: "a pointer of Git LFS", advice: "fetch the file itself with git lfs pull" },
    Foreign { magic: b"<!DOCTYPE html", ending: "", what: "a web page", advice: "download the file itself" },
    Foreign { magic: b"<!doctype html", ending: "", what: "a web page", advice: "download the file itself" },
    Foreign { magic: b"<html", ending: "", what: "a web page", advice: "download the file itself" },
    Foreign { magic: b"\x1f\x8b", ending: "gz", what: "compressed by gzip", advice: "unpack it" },
    Foreign { magic: b"PXR-USDC", ending: "usdc", what: "USD", advice: EXPORT },
    Foreign { magic: b"#usda", ending: "usda", what: "USD", advice: EXPORT },
    Foreign { magic: b"", ending: "usd", what: "USD", advice: EXPORT },
    Foreign { magic: b"", ending: "usdz", what: "USD", advice: EXPORT },
    Foreign { magic: b"Kaydara FBX", ending: "fbx", what: "FBX", advice: EXPORT },
    Foreign { magic: b"; FBX", ending: "fbx", what: "FBX", advice: EXPORT },
    Foreign { magic: b"BLENDER", ending: "blend", what: "a file of Blender", advice: EXPORT },
    Foreign { magic: b"", ending: "stl", what: "STL", advice: EXPORT },
    Foreign { magic: b"", ending: "dae", what: "COLLADA", advice: EXPORT },
    Foreign { magic: b"", ending: "abc", what: "Alembic", advice: EXPORT },
    Foreign { magic: b"", ending: "3ds", what: "3DS", advice: EXPORT },
    Foreign { magic: b"", ending: "3mf", what: "3MF", advice: EXPORT },
    Foreign { magic: b"", ending: "off", what: "OFF", advice: EXPORT },
    Foreign { magic: b"", ending: "x3d", what: "X3D", advice: EXPORT },
    Foreign { magic: b"", ending: "wrl", what: "VRML", advice: EXPORT },
    Foreign { magic: b"", ending: "vrm", what: "VRM", advice: "it is a GLB: name it .glb" },
    Foreign { magic: b"HIERARCHY", ending: "bvh", what: "BVH", advice: "it moves a skeleton without a surface: bind a body to it and export a GLB" },
    Foreign { magic: b"", ending: "npz", what: "NumPy", advice: SMPL },
    Foreign { magic: b"\x93NUMPY", ending: "npy", what: "NumPy", advice: SMPL },
    Foreign { magic: b"", ending: "pkl", what: "a file of Python", advice: SMPL },
    Foreign { magic: b"PK\x03\x04", ending: "zip", what: "a ZIP archive", advice: "unpack it" },
];

impl Foreign {
    fn refusal(&self) -> Found {
        Found::malformed(Place::File, format!("it is {}, which is not read: {}", self.what, self.advice))
    }
}

/// Refuses a file that is one of another kind by its first bytes.
pub(crate) fn check_magic(bytes: &[u8]) -> Result<(), Found> {
    match FOREIGN.iter().find(|foreign| !foreign.magic.is_empty() && bytes.starts_with(foreign.magic)) {
        Some(foreign) => Err(foreign.refusal()),
        None => Ok(()),
    }
}

/// The format of a body by the ending of its name, which its first bytes must not gainsay; `known` lists the endings.
pub(crate) fn of_body(bytes: &[u8], name: &Path, known: &'static str) -> Result<BodyFormat, Found> {
    let ending = name.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
    if let Some(foreign) = FOREIGN.iter().find(|foreign| !ending.is_empty() && foreign.ending == ending) {
        return Err(foreign.refusal());
    }
    check_magic(bytes)?;
    let format = match ending.as_str() {
        "obj" => BodyFormat::Obj,
        "ply" => BodyFormat::Ply,
        "gltf" | "glb" => BodyFormat::Gltf,
        _ => return Err(Fault::UnknownFormat(known).into()),
    };
    let start = source::utf8(&bytes[..bytes.len().min(64)]);
    let (is, named) = match start.trim_ascii_start() {
        [b'p', b'l', b'y', b'\n' | b'\r', ..] => (BodyFormat::Ply, "a PLY file: name it .ply"),
        [b'g', b'l', b'T', b'F', ..] => (BodyFormat::Gltf, "a binary glTF file: name it .glb"),
        [b'{', ..] => (BodyFormat::Gltf, "a JSON text, as a glTF file is: name it .gltf"),
        _ => return Ok(format),
    };
    if is == format {
        return Ok(format);
    }
    Err(Found::malformed(Place::File, format!("by its first bytes it is {named}")))
}

#[cfg(test)]
mod tests {
    use super::of_body;
    use std::path::Path;

    #[test]
    fn files_that_are_not_read_say_what_they_are() {
        let told = |name: &str, bytes: &[u8]| match of_body(bytes, Path::new(name), ".obj") {
            Ok(format) => format!("{name} {format:?}"),
            Err(found) => found.in_file(name).to_string(),
        };
        let told = [
            told("a.OBJ", b"v 0 0 0"),
            told("a.ply", b"ply\r\n"),
            told("a.glb", b"glTF"),
            told("a.gltf", b"\xef\xbb\xbf {}"),
            told("a", b"v 0 0 0"),
            told("a.obj", b"\n\nply\nformat"),
            told("a.ply", b"{\"asset\":"),
            told("a.obj", b"glTF\x02"),
            told("a.usdz", b"PK\x03\x04"),
            told("a.glb", b"PXR-USDC"),
            told("a.fbx", b""),
            told("a.npz", b"PK\x03\x04"),
            told("a.obj", b"version https://git-lfs.github.com/spec/v1\n"),
            told("a.obj.gz", b"\x1f\x8b\x08"),
            told("a.obj", b"<!DOCTYPE html>"),
        ];
        insta::assert_snapshot!(told.join("\n"), @"
        a.OBJ Obj
        a.ply Ply
        a.glb Gltf
        a.gltf Gltf
        a: its name ends in none of the known ways: .obj
        a.obj: by its first bytes it is a PLY file: name it .ply
        a.ply: by its first bytes it is a JSON text, as a glTF file is: name it .gltf
        a.obj: by its first bytes it is a binary glTF file: name it .glb
        a.usdz: it is USD, which is not read: export the body as GLB, PLY or OBJ from the program that wrote it
        a.glb: it is USD, which is not read: export the body as GLB, PLY or OBJ from the program that wrote it
        a.fbx: it is FBX, which is not read: export the body as GLB, PLY or OBJ from the program that wrote it
        a.npz: it is NumPy, which is not read: it holds the numbers of a body model, not a surface: pose the model with its own program and save a GLB with a clip, or an OBJ file for each frame
        a.obj: it is a pointer of Git LFS, which is not read: fetch the file itself with git lfs pull
        a.obj.gz: it is compressed by gzip, which is not read: unpack it
        a.obj: it is a web page, which is not read: download the file itself
        ");
    }
}
