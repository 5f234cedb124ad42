//! Which format a file has: by its first bytes, else by the ending of its name.

use crate::error::{Fault, Found, Place};
use crate::foreign::{self, Foreign};
use crate::source;
use std::path::Path;

/// What a file is given as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    Body,
    Garment,
}

/// The formats of bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BodyFormat {
    Obj,
    Ply,
    /// Text or binary.
    Gltf,
}

/// What a garment is, for whoever gives something else.
pub(crate) const GARMENT: &str = "a garment is GarmentCode's JSON, a file like NAME_specification.json";

/// The format of a body; `known` lists the endings. First bytes that gainsay the ending are believed.
pub(crate) fn of_body(bytes: &[u8], name: &Path, known: &'static str) -> Result<BodyFormat, Found> {
    let ending = ending(name);
    if let Some(foreign) = foreign::by_bytes(bytes) {
        return Err(refusal(foreign, Role::Body));
    }
    let named = match ending.as_str() {
        "obj" => Some(BodyFormat::Obj),
        "ply" => Some(BodyFormat::Ply),
        // A VRM is a glTF file with notes about a person.
        "gltf" | "glb" | "vrm" => Some(BodyFormat::Gltf),
        _ => None,
    };
    match (named, by_bytes(bytes), foreign::by_ending(&ending)) {
        (Some(named), Some(seen), _) if seen.format != named => Err(seen.misnamed()),
        (Some(named), _, _) => Ok(named),
        (None, Some(seen), _) => Err(seen.misnamed()),
        (None, None, Some(foreign)) => Err(refusal(foreign, Role::Body)),
        (None, None, None) => Err(Fault::UnknownFormat(known).into()),
    }
}

/// Refuses what is no garment by its first bytes; if these do not tell, by the ending of its name.
pub(crate) fn check_garment(bytes: &[u8], name: &Path) -> Result<(), Found> {
    if let Some(foreign) = foreign::by_bytes(bytes) {
        return Err(refusal(foreign, Role::Garment));
    }
    match (by_bytes(bytes), foreign::by_ending(&ending(name))) {
        // Any JSON is looked into, whatever its name.
        (Some(seen), _) if seen.is_json() => Ok(()),
        (Some(seen), _) => {
            Err(Found::malformed(Place::File, format!("it is {}, which has no patterns: {GARMENT}", seen.what)))
        }
        (None, Some(foreign)) => Err(refusal(foreign, Role::Garment)),
        (None, None) => Ok(()),
    }
}

fn ending(name: &Path) -> String {
    name.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase()
}

fn refusal(foreign: &Foreign, role: Role) -> Found {
    let advice = foreign.advice(role);
    Found::malformed(Place::File, format!("it is {}, which is not read: {advice}", foreign.what))
}

const JSON: &str = "a JSON text, as a glTF file is";

/// What a file is by its first bytes.
struct Seen {
    format: BodyFormat,
    what: &'static str,
    /// How its name should end.
    ending: &'static str,
}

impl Seen {
    fn is_json(&self) -> bool {
        self.what == JSON
    }

    fn misnamed(&self) -> Found {
        Found::malformed(Place::File, format!("by its first bytes it is {}: name it {}", self.what, self.ending))
    }
}

fn by_bytes(bytes: &[u8]) -> Option<Seen> {
    let seen = |format, what, ending| Some(Seen { format, what, ending });
    let start = source::utf8(&bytes[..bytes.len().min(1 << 12)]);
    match start.trim_ascii_start() {
        [b'p', b'l', b'y', b'\n' | b'\r', ..] => seen(BodyFormat::Ply, "a PLY file", ".ply"),
        [b'g', b'l', b'T', b'F', ..] => seen(BodyFormat::Gltf, "a binary glTF file", ".glb"),
        [b'{', ..] => seen(BodyFormat::Gltf, JSON, ".gltf, and a garment is no body"),
        text if is_obj(text) => seen(BodyFormat::Obj, "an OBJ file", ".obj"),
        _ => None,
    }
}

/// Whether the first line that is no comment is a statement as OBJ files begin with.
fn is_obj(text: &[u8]) -> bool {
    const FIRST: [&[u8]; 8] = [b"v", b"vn", b"vt", b"o", b"g", b"s", b"mtllib", b"usemtl"];
    let lines = text.split(|byte| matches!(byte, b'\n' | b'\r')).map(<[u8]>::trim_ascii);
    let first = lines.filter(|line| !line.is_empty()).find(|line| line[0] != b'#');
    let mut words = first.unwrap_or_default().split(u8::is_ascii_whitespace);
    words.next().is_some_and(|word| FIRST.contains(&word)) && words.next().is_some()
}

#[cfg(test)]
mod tests {
    use super::{check_garment, of_body};
    use std::path::Path;

    fn body(name: &str, bytes: &[u8]) -> String {
        match of_body(bytes, Path::new(name), ".obj") {
            Ok(format) => format!("{name} {format:?}"),
            Err(found) => found.in_file(name).to_string(),
        }
    }

    fn garment(name: &str, bytes: &[u8]) -> String {
        match check_garment(bytes, Path::new(name)) {
            Ok(()) => format!("{name} looked into"),
            Err(found) => found.in_file(name).to_string(),
        }
    }

    #[test]
    fn bodies_are_known_by_bytes_and_endings() {
        let told = [
            body("a.OBJ", b"v 0 0 0"),
            body("a.ply", b"ply\r\n"),
            body("a.glb", b"glTF"),
            body("a.gltf", b"\xef\xbb\xbf {}"),
            body("a.vrm", b"glTF"),
            body("a", b"hello"),
            body("a", b"# by hand\n\nv 0 0 0"),
            body("a.fbx", b"# by hand\r\nmtllib a.mtl\r\n"),
            body("a.usd", b"glTF\x02"),
            body("a.obj", b"\n\nply\nformat"),
            body("a.ply", b"{\"asset\":"),
            body("a.obj", b"glTF\x02"),
            body("a.json", b"{\"pattern\":"),
            body("a.ply", b"v 0 0 0"),
        ];
        insta::assert_snapshot!(told.join("\n"), @"
        a.OBJ Obj
        a.ply Ply
        a.glb Gltf
        a.gltf Gltf
        a.vrm Gltf
        a: its name ends in none of the known ways: .obj
        a: by its first bytes it is an OBJ file: name it .obj
        a.fbx: by its first bytes it is an OBJ file: name it .obj
        a.usd: by its first bytes it is a binary glTF file: name it .glb
        a.obj: by its first bytes it is a PLY file: name it .ply
        a.ply: by its first bytes it is a JSON text, as a glTF file is: name it .gltf, and a garment is no body
        a.obj: by its first bytes it is a binary glTF file: name it .glb
        a.json: by its first bytes it is a JSON text, as a glTF file is: name it .gltf, and a garment is no body
        a.ply: by its first bytes it is an OBJ file: name it .obj
        ");
    }

    #[test]
    fn garments_are_known_by_bytes_and_endings() {
        let told = [
            garment("a.json", b"{"),
            garment("a.svg", b" {"),
            garment("a.json", b""),
            garment("a.json", b"glTF\x02"),
            garment("a.json", b"ply\n"),
            garment("a.obj", b"v 0 0 0\n"),
            garment("a.zprj", b"\x01\x02"),
        ];
        insta::assert_snapshot!(told.join("\n"), @"
        a.json looked into
        a.svg looked into
        a.json looked into
        a.json: it is a binary glTF file, which has no patterns: a garment is GarmentCode's JSON, a file like NAME_specification.json
        a.json: it is a PLY file, which has no patterns: a garment is GarmentCode's JSON, a file like NAME_specification.json
        a.obj: it is an OBJ file, which has no patterns: a garment is GarmentCode's JSON, a file like NAME_specification.json
        a.zprj: it is a project of CLO or Marvelous Designer, which is not read: a garment is GarmentCode's JSON, a file like NAME_specification.json
        ");
    }
}
