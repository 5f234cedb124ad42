//! Wavefront OBJ: vertices, normals and polygons; everything else in the file is passed over.

use crate::body::soup::Soup;
use crate::error::{Fault, Found, Place};
use glam::DVec3;

/// Reads OBJ text. Positions stay in the file's unit.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup, Found> {
    let mut soup = Soup::default();
    let mut normals: Vec<DVec3> = Vec::new();
    let mut corner_normals: Vec<(u32, u32, usize)> = Vec::new();
    let mut corners: Vec<u32> = Vec::new();
    for (number, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let place = || Place::Line(number + 1);
        let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        match words.next() {
            Some(b"v") => {
                let position = vector(&mut words, number + 1, "vertex")?;
                soup.push_vertex(position, place)?;
            }
            Some(b"vn") => normals.push(vector(&mut words, number + 1, "normal")?),
            Some(b"f") => {
                corners.clear();
                for word in words.take_while(|word| word[0] != b'#') {
                    let mut parts = word.split(|byte| *byte == b'/');
                    let vertex = parts.next().unwrap_or_default();
                    let vertex = index(vertex, soup.positions.len(), number + 1, "vertex")?;
                    corners.push(vertex);
                    if let Some(normal) = parts.nth(1).filter(|part| !part.is_empty()) {
                        let normal = index(normal, normals.len(), number + 1, "normal")?;
                        corner_normals.push((vertex, normal, number + 1));
                    }
                }
                if corners.len() < 3 {
                    let message = format!("a face has {} corners, it needs 3", corners.len());
                    return Err(Found::malformed(place(), message));
                }
                soup.push_polygon(&corners, place);
            }
            _ => {}
        }
    }
    soup.check_indices(1)?;
    for (vertex, normal, line) in corner_normals {
        let Some(normal) = normals.get(normal as usize) else {
            let (index, count) = (i64::from(normal) + 1, normals.len());
            let fault = Fault::OutOfRange { what: "normal", index, count };
            return Err(Found::at(Place::Line(line), fault));
        };
        soup.normals[vertex as usize] += *normal;
    }
    Ok(soup)
}

/// Three numbers.
fn vector<'a>(words: &mut impl Iterator<Item = &'a [u8]>, line: usize, what: &str) -> Result<DVec3, Found> {
    let mut next = || {
        let word =
            words.next().ok_or_else(|| Found::malformed(Place::Line(line), format!("a {what} needs three numbers")))?;
        number(word).ok_or_else(|| {
            let word = String::from_utf8_lossy(word);
            Found::malformed(Place::Line(line), format!("\"{word}\" is not a number"))
        })
    };
    Ok(DVec3::new(next()?, next()?, next()?))
}

/// A zero-based index; the file counts from 1, or backwards from −1. An index beyond u32 points outside of any file.
fn index(word: &[u8], count: usize, line: usize, what: &'static str) -> Result<u32, Found> {
    let place = Place::Line(line);
    let Some(written) = std::str::from_utf8(word).ok().and_then(|word| word.parse::<i64>().ok()) else {
        let word = String::from_utf8_lossy(word);
        return Err(Found::malformed(place, format!("\"{word}\" is not an index")));
    };
    let zero_based = if written < 0 { count as i64 + written } else { written - 1 };
    u32::try_from(zero_based).map_err(|_| Found::at(place, Fault::OutOfRange { what, index: written, count }))
}

fn number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}
