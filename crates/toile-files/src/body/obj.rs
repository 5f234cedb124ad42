//! Wavefront OBJ: vertices, normals and polygons.

use crate::body::number::{no_number, number};
use crate::body::obj_lines::Lines;
use crate::body::soup::Soup;
use crate::error::{Fault, Found, Place};
use crate::source;
use crate::unread::Unread;
use glam::DVec3;

/// Statements that say nothing about the surface, each with its reason.
const NEEDLESS: [(&str, &str); 20] = [
    ("vt", "texture coordinates"),
    ("vp", "points of curves on free-form surfaces, which are told by themselves"),
    ("p", "points have no surface"),
    ("l", "lines have no surface"),
    ("g", "names of groups"),
    ("o", "names of objects"),
    ("s", "smoothing groups, by which normals are made where the file gives none; here they are made of all faces"),
    ("mg", "merging groups of free-form surfaces, which are told by themselves"),
    ("mtllib", "colours"),
    ("usemtl", "colours"),
    ("maplib", "colours"),
    ("usemap", "colours"),
    ("bevel", "how it is lit"),
    ("c_interp", "how it is lit"),
    ("d_interp", "how it is lit"),
    ("shadow_obj", "how it is lit"),
    ("trace_obj", "how it is lit"),
    ("lod", "which of several objects a viewer shows"),
    ("ctech", "how finely a curve is drawn"),
    ("stech", "how finely a free-form surface is drawn"),
];

/// Statements of curved shapes, which have no polygons.
const FREE_FORM: [&str; 14] =
    ["cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con"];

/// Reads OBJ text. Positions stay in the file's unit. What is not read is noted.
pub(crate) fn read(bytes: &[u8], unread: &mut Unread) -> Result<Soup, Found> {
    let bytes = source::utf8(bytes);
    let mut soup = Soup::default();
    let mut normals: Vec<DVec3> = Vec::new();
    // Corners whose normal stands further down.
    let mut early: Vec<(u32, u32, usize)> = Vec::new();
    let mut corners: Vec<u32> = Vec::new();
    let mut lines = Lines::of(&bytes);
    while let Some((line, number)) = lines.read() {
        let place = || Place::Line(number);
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        match words.next() {
            None => {}
            // What follows the position is a weight, which only free-form surfaces have, or a colour.
            Some(b"v") => {
                let position = vector(&mut words, number, "vertex")?;
                soup.push_vertex(position, place)?;
            }
            Some(b"vn") => normals.push(vector(&mut words, number, "normal")?),
            // The older name of a face is fo.
            Some(b"f" | b"fo") => {
                corners.clear();
                for word in words.take_while(|word| word[0] != b'#') {
                    let mut parts = word.split(|byte| *byte == b'/');
                    let vertex = parts.next().unwrap_or_default();
                    let vertex = index(vertex, soup.positions.len(), number, "vertex")?;
                    corners.push(vertex);
                    if let Some(normal) = parts.nth(1).filter(|part| !part.is_empty()) {
                        let normal = index(normal, normals.len(), number, "normal")?;
                        match (soup.normals.get_mut(vertex as usize), normals.get(normal as usize)) {
                            (Some(sum), Some(normal)) => *sum += *normal,
                            _ => early.push((vertex, normal, number)),
                        }
                    }
                }
                if corners.len() < 3 {
                    let message = format!("a face has {} corners, it needs 3", corners.len());
                    return Err(Found::malformed(place(), message));
                }
                soup.push_polygon(&corners, place);
            }
            Some(word) if word[0] == b'#' => {}
            Some(word) => note(word, number, unread),
        }
    }
    soup.check_indices(1)?;
    for (vertex, normal, line) in early {
        let Some(normal) = normals.get(normal as usize) else {
            let (index, count) = (i64::from(normal) + 1, normals.len());
            let fault = Fault::OutOfRange { what: "normal", index, count };
            return Err(Found::at(Place::Line(line), fault));
        };
        soup.normals[vertex as usize] += *normal;
    }
    Ok(soup)
}

fn note(word: &[u8], line: usize, unread: &mut Unread) {
    let is = |name: &&str| name.as_bytes() == word;
    if NEEDLESS.iter().any(|(name, _)| is(name)) {
        return;
    }
    if FREE_FORM.iter().any(is) {
        unread.note("free-form curves and surfaces: export them as polygons", || Place::Line(line));
    } else {
        let word = String::from_utf8_lossy(&word[..word.len().min(40)]);
        unread.note(&format!("the statement \"{word}\""), || Place::Line(line));
    }
}

/// Three numbers.
fn vector<'a>(words: &mut impl Iterator<Item = &'a [u8]>, line: usize, what: &str) -> Result<DVec3, Found> {
    let mut next = || {
        let word =
            words.next().ok_or_else(|| Found::malformed(Place::Line(line), format!("a {what} needs three numbers")))?;
        number(word).ok_or_else(|| Found::malformed(Place::Line(line), no_number(word)))
    };
    Ok(DVec3::new(next()?, next()?, next()?))
}

/// A zero-based index; the file counts from 1, or backwards from −1. An index beyond u32 points outside of any file.
fn index(word: &[u8], count: usize, line: usize, what: &'static str) -> Result<u32, Found> {
    let place = Place::Line(line);
    let Some(written) = std::str::from_utf8(word).ok().and_then(|word| word.parse::<i64>().ok()) else {
        let word = String::from_utf8_lossy(&word[..word.len().min(40)]);
        return Err(Found::malformed(place, format!("\"{word}\" is not an index")));
    };
    let zero_based = if written < 0 { count as i64 + written } else { written - 1 };
    u32::try_from(zero_based).map_err(|_| Found::at(place, Fault::OutOfRange { what, index: written, count }))
}
