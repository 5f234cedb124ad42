//! Formats that are not read: how each is known, and what to do with it.

use crate::format::{GARMENT, Role};
use crate::source;

/// A format that is not read.
#[derive(Debug, PartialEq)]
pub(crate) struct Foreign {
    pub what: &'static str,
    /// What to do where it is given as a body.
    body: &'static str,
    /// What to do where it is given as a garment.
    garment: &'static str,
}

impl Foreign {
    const fn of(what: &'static str, body: &'static str) -> Self {
        Self { what, body, garment: GARMENT }
    }

    /// One that holds any file: the advice is the same.
    const fn package(what: &'static str, advice: &'static str) -> Self {
        Self { what, body: advice, garment: advice }
    }

    pub fn advice(&self, role: Role) -> &'static str {
        match role {
            Role::Body => self.body,
            Role::Garment => self.garment,
        }
    }
}

const BLENDER: &str =
    "export the body as GLB from the program that wrote it, or import it into Blender and export glTF 2.0";
const MESHLAB: &str =
    "export the body as GLB, PLY or OBJ from the program that wrote it, or open it in MeshLab and export PLY";
const PATTERNS: &str = "it has patterns, and a body is a GLB, PLY or OBJ file";
const MODEL: &str = "it holds the numbers of a body model, not a surface: pose the model with its own program and save \
                     a GLB with a clip, or an OBJ file for each frame";

const USD: Foreign = Foreign::of("USD", BLENDER);
const FBX: Foreign = Foreign::of("FBX", BLENDER);
const BLEND: Foreign = Foreign::of("a file of Blender", "open it in Blender and export glTF 2.0");
const STL: Foreign = Foreign::of("STL", MESHLAB);
const COLLADA: Foreign = Foreign::of("COLLADA", MESHLAB);
const ALEMBIC: Foreign = Foreign::of("Alembic", BLENDER);
const STUDIO: Foreign = Foreign::of("3DS", MESHLAB);
const PRINT: Foreign = Foreign::of("3MF", MESHLAB);
const OFF: Foreign = Foreign::of("OFF", MESHLAB);
const X3D: Foreign = Foreign::of("X3D", MESHLAB);
const VRML: Foreign = Foreign::of("VRML", MESHLAB);
const BVH: Foreign =
    Foreign::of("BVH", "it moves a skeleton without a surface: bind a body to it in Blender and export glTF 2.0");
const NUMPY: Foreign = Foreign::of("NumPy", MODEL);
const PICKLE: Foreign = Foreign::of("a file of Python", MODEL);
const CLO: Foreign = Foreign::of(
    "a project of CLO or Marvelous Designer",
    "export the avatar as glTF or OBJ from the program that wrote it",
);
const DXF: Foreign = Foreign::of("DXF", PATTERNS);
const SVG: Foreign = Foreign::of("SVG", PATTERNS);
const VALENTINA: Foreign = Foreign::of("a pattern of Valentina or Seamly2D", PATTERNS);
const PDF: Foreign = Foreign::of("PDF", PATTERNS);
const YAML: Foreign = Foreign {
    garment: "it has the numbers of a design: let GarmentCode make the garment of it, which it saves as NAME_specification.json",
    ..Foreign::of("YAML", "a body is a GLB, PLY or OBJ file")
};
const LFS: Foreign = Foreign::package("a pointer of Git LFS", "fetch the file itself with git lfs pull");
const PAGE: Foreign = Foreign::package("a web page", "download the file itself");
const GZIP: Foreign = Foreign::package("compressed by gzip", "unpack it");
const ZSTD: Foreign =
    Foreign::package("compressed by Zstandard, as Blender saves files", "unpack it, or export it from Blender");
const ZIP: Foreign = Foreign::package("a ZIP archive", "unpack it");

/// How files begin.
const MAGIC: [(&[u8], &Foreign); 22] = [
    (b"version https://git-lfs", &LFS),
    (b"<!DOCTYPE html", &PAGE),
    (b"<!doctype html", &PAGE),
    (b"<html", &PAGE),
    (b"\x1f\x8b", &GZIP),
    (b"\x28\xb5\x2f\xfd", &ZSTD),
    (b"PXR-USDC", &USD),
    (b"#usda", &USD),
    (b"Kaydara FBX", &FBX),
    (b"; FBX", &FBX),
    (b"BLENDER", &BLEND),
    (b"solid ", &STL),
    (b"Ogawa", &ALEMBIC),
    (b"\x89HDF", &ALEMBIC),
    (b"OFF\n", &OFF),
    (b"OFF\r", &OFF),
    (b"#VRML", &VRML),
    (b"#X3D", &X3D),
    (b"HIERARCHY", &BVH),
    (b"\x93NUMPY", &NUMPY),
    (b"AutoCAD Binary DXF", &DXF),
    (b"%PDF", &PDF),
];

/// Root elements of XML.
const ROOTS: [(&str, &Foreign); 5] =
    [("<COLLADA", &COLLADA), ("<X3D", &X3D), ("<svg", &SVG), ("<pattern", &VALENTINA), ("<html", &PAGE)];

/// Endings of the first entry in a ZIP archive.
const ENTRIES: [(&str, &Foreign); 5] =
    [(".usda", &USD), (".usdc", &USD), (".usd", &USD), (".npy", &NUMPY), (".model", &PRINT)];

/// Endings of names.
const ENDINGS: [(&str, &Foreign); 36] = [
    ("usd", &USD),
    ("usda", &USD),
    ("usdc", &USD),
    ("usdz", &USD),
    ("fbx", &FBX),
    ("blend", &BLEND),
    ("stl", &STL),
    ("dae", &COLLADA),
    ("abc", &ALEMBIC),
    ("3ds", &STUDIO),
    ("max", &STUDIO),
    ("3mf", &PRINT),
    ("off", &OFF),
    ("x3d", &X3D),
    ("wrl", &VRML),
    ("bvh", &BVH),
    ("npz", &NUMPY),
    ("npy", &NUMPY),
    ("pkl", &PICKLE),
    ("zprj", &CLO),
    ("zpac", &CLO),
    ("avt", &CLO),
    ("dxf", &DXF),
    ("svg", &SVG),
    ("val", &VALENTINA),
    ("vit", &VALENTINA),
    ("sm2d", &VALENTINA),
    ("pdf", &PDF),
    ("yaml", &YAML),
    ("yml", &YAML),
    ("html", &PAGE),
    ("htm", &PAGE),
    ("gz", &GZIP),
    ("tgz", &GZIP),
    ("zst", &ZSTD),
    ("zip", &ZIP),
];

/// The format that is not read of files with such an ending, in small letters.
pub(crate) fn by_ending(ending: &str) -> Option<&'static Foreign> {
    found(&ENDINGS, |known| *known == ending)
}

/// The format that is not read of files that begin so.
pub(crate) fn by_bytes(bytes: &[u8]) -> Option<&'static Foreign> {
    let head = source::utf8(&bytes[..bytes.len().min(1 << 12)]);
    let text = head.trim_ascii_start();
    if let Some(foreign) = found(&MAGIC, |magic| bytes.starts_with(magic) || text.starts_with(magic)) {
        return Some(foreign);
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return Some(in_archive(bytes));
    }
    if text.starts_with(b"<") {
        let text = String::from_utf8_lossy(text);
        return found(&ROOTS, |root| text.contains(root));
    }
    if is_drawing(text) {
        return Some(&DXF);
    }
    let word = |at: usize| bytes.get(at..at + 4).map(|b| u64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])));
    let size = bytes.len() as u64;
    // Neither has a mark, but both tell their size.
    if word(80).is_some_and(|count| count > 0 && 84 + 50 * count == size) {
        return Some(&STL);
    }
    (bytes.starts_with(b"MM") && word(2) == Some(size)).then_some(&STUDIO)
}

fn found<K>(table: &[(K, &'static Foreign)], is: impl Fn(&K) -> bool) -> Option<&'static Foreign> {
    table.iter().find(|(known, _)| is(known)).map(|(_, foreign)| *foreign)
}

/// What an archive is by the name of its first entry.
fn in_archive(bytes: &[u8]) -> &'static Foreign {
    let length = bytes.get(26..28).map_or(0, |b| usize::from(u16::from_le_bytes([b[0], b[1]])));
    let name = String::from_utf8_lossy(bytes.get(30..30 + length).unwrap_or_default()).to_ascii_lowercase();
    found(&ENTRIES, |ending| name.ends_with(ending)).unwrap_or(&ZIP)
}

/// Whether a text is a DXF drawing: a 0, then a section, in lines of their own, after comments that have the number 999.
fn is_drawing(text: &[u8]) -> bool {
    let lines = text.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let mut pairs = lines.clone().step_by(2).zip(lines.skip(1).step_by(2));
    pairs.find(|(code, _)| *code != b"999") == Some((b"0", b"SECTION"))
}

#[cfg(test)]
mod tests {
    use super::{ENDINGS, Foreign, by_bytes, by_ending};
    use crate::format::{check_garment, of_body};
    use std::path::Path;

    /// An archive that begins with an entry of that name.
    fn archive(name: &str) -> Vec<u8> {
        [b"PK\x03\x04".as_slice(), &[0; 22], &[name.len() as u8, 0, 0, 0], name.as_bytes(), b"data"].concat()
    }

    /// A binary STL of so many triangles.
    fn stl(count: u32) -> Vec<u8> {
        [[b' '; 80].as_slice(), &count.to_le_bytes(), &vec![0; 50 * count as usize]].concat()
    }

    /// Beginnings of files, each with the endings that such files have.
    fn samples() -> Vec<(&'static str, Vec<u8>)> {
        vec![
            ("usda usd", b"#usda 1.0\n(\n)".to_vec()),
            ("usdc usd", b"PXR-USDC\0\x08".to_vec()),
            ("usdz", archive("scene.usdc")),
            ("usdz", archive("textures/Body.USDA")),
            ("npz", archive("poses.npy")),
            ("npy", b"\x93NUMPY\x01\0".to_vec()),
            ("fbx", b"Kaydara FBX Binary  \0".to_vec()),
            ("fbx", b"; FBX 7.4.0 project file\n".to_vec()),
            ("blend", b"BLENDER-v405".to_vec()),
            ("dae", b"<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"a\">".to_vec()),
            ("stl", b"solid body\n facet normal 0 0 1\n".to_vec()),
            ("stl", stl(3)),
            ("abc", b"Ogawa\xff\0\x01".to_vec()),
            ("bvh", b"HIERARCHY\nROOT Hips\n".to_vec()),
            ("dxf", b"  0\r\nSECTION\r\n  2\r\nHEADER\r\n".to_vec()),
            ("dxf", b"999\nby a program\n0\nSECTION\n".to_vec()),
            ("dxf", b"AutoCAD Binary DXF\r\n\x1a".to_vec()),
            ("svg", b"\xef\xbb\xbf<?xml version=\"1.0\"?>\n<!-- a -->\n<svg width=\"3\">".to_vec()),
            ("val vit", b"<?xml version=\"1.0\"?>\n<pattern>".to_vec()),
            ("x3d", b"<X3D profile=\"Immersive\">".to_vec()),
            ("off", b"OFF\n8 6 0\n".to_vec()),
            ("3ds", [b"MM".as_slice(), &10u32.to_le_bytes(), b"data"].concat()),
            ("pdf", b"%PDF-1.7".to_vec()),
            ("zip", archive("body.obj")),
            ("gz", b"\x1f\x8b\x08".to_vec()),
        ]
    }

    #[test]
    fn what_is_not_read_is_told_by_its_bytes_whatever_its_name() {
        for (endings, bytes) in samples() {
            let expected = by_bytes(&bytes).unwrap_or_else(|| panic!("{endings} is not known"));
            for own in endings.split(' ') {
                assert_eq!(by_ending(own), Some(expected), "{own}");
            }
            for ending in endings.split(' ').chain(["obj", "PLY", "glb", "gltf", "json", "usd", ""]) {
                let name = format!("a.{ending}");
                let name = Path::new(name.trim_end_matches('.'));
                let start = format!("it is {}, which is not read: ", expected.what);
                let refused = of_body(&bytes, name, ".obj").expect_err("no body").fault.to_string();
                assert_eq!(refused, format!("{start}{}", expected.body));
                let refused = check_garment(&bytes, name).expect_err("no garment").fault.to_string();
                assert_eq!(refused, format!("{start}{}", expected.garment));
            }
        }
    }

    #[test]
    fn what_is_not_read_is_told_by_its_ending_where_its_bytes_do_not_tell() {
        for (ending, foreign) in ENDINGS {
            for name in [format!("a.{ending}"), format!("A.{}", ending.to_ascii_uppercase())] {
                let name = Path::new(&name);
                for bytes in [b"".as_slice(), b"\0\x01\x02"] {
                    let told = of_body(bytes, name, ".obj").expect_err("no body").fault.to_string();
                    assert!(told.starts_with(&format!("it is {}, which is not read: ", foreign.what)), "{told}");
                    check_garment(bytes, name).expect_err("no garment");
                }
            }
        }
        assert_eq!(by_ending("obj"), None);
    }

    #[test]
    fn what_is_read_is_not_taken_for_something_else() {
        for text in ["", "v 0 0 0\n", "# solid\no solid\n", "ply\n", "{\"a\": \"<svg\"}", "g OFF\n", "0\n0\n", "MM"] {
            assert_eq!(by_bytes(text.as_bytes()), None, "{text}");
        }
        assert_eq!(by_bytes(&stl(0)), None::<&Foreign>);
    }
}
