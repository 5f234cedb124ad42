//! PLY, ASCII and binary: the elements `vertex` and `face`; other elements and properties are passed over.

use crate::body::ply_header::{Element, Encoding, Header, Property, Scalar};
use crate::body::soup::Soup;
use crate::error::{Fault, Found, Place};
use glam::DVec3;

/// Reads a PLY file. Positions stay in the file's unit.
pub(crate) fn read(bytes: &[u8]) -> Result<Soup, Found> {
    let header = Header::read(bytes)?;
    let mut values = Values { bytes, at: header.length, line: header.lines, encoding: header.encoding };
    let mut soup = Soup::default();
    for element in &header.elements {
        values.check_declared(element)?;
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut values, &mut soup)?,
            "face" => read_faces(element, &mut values, &mut soup)?,
            _ => pass_over(element, &mut values)?,
        }
    }
    soup.check_indices(0)?;
    Ok(soup)
}

fn read_vertices(element: &Element, values: &mut Values, soup: &mut Soup) -> Result<(), Found> {
    const NAMES: [&str; 6] = ["x", "y", "z", "nx", "ny", "nz"];
    let slots: Vec<Option<usize>> =
        element.properties.iter().map(|property| NAMES.iter().position(|name| *name == property.name)).collect();
    if let Some(missing) = NAMES[..3].iter().find(|name| element.scalar(name).is_none()) {
        let message = format!("the element vertex has no number \"{missing}\"");
        return Err(Found::malformed(Place::File, message));
    }
    if !soup.positions.is_empty() {
        return Err(Found::malformed(Place::File, "it has two elements vertex"));
    }
    soup.positions.reserve(element.count);
    soup.normals.reserve(element.count);
    for row in 0..element.count {
        let mut numbers = [0.0; 6];
        for (property, slot) in element.properties.iter().zip(&slots) {
            match (property.list_count, slot) {
                (None, Some(slot)) => numbers[*slot] = values.next(property.scalar)?,
                (None, None) => {
                    values.next(property.scalar)?;
                }
                (Some(count), _) => {
                    for _ in 0..values.list_length(count, property)? {
                        values.next(property.scalar)?;
                    }
                }
            }
        }
        let [x, y, z, nx, ny, nz] = numbers;
        soup.push_vertex(DVec3::new(x, y, z), || Place::Row("vertex".into(), row))?;
        soup.normals[row] = DVec3::new(nx, ny, nz);
    }
    Ok(())
}

fn read_faces(element: &Element, values: &mut Values, soup: &mut Soup) -> Result<(), Found> {
    let is_corners = |property: &Property| {
        property.list_count.is_some() && matches!(property.name.as_str(), "vertex_indices" | "vertex_index")
    };
    if !element.properties.iter().any(is_corners) {
        let message = "the element face has no list \"vertex_indices\"";
        return Err(Found::malformed(Place::File, message));
    }
    soup.triangles.reserve(element.count);
    let mut corners: Vec<u32> = Vec::new();
    for row in 0..element.count {
        let place = || Place::Row("face".into(), row);
        for property in &element.properties {
            let Some(count) = property.list_count else {
                values.next(property.scalar)?;
                continue;
            };
            let length = values.list_length(count, property)?;
            if !is_corners(property) {
                for _ in 0..length {
                    values.next(property.scalar)?;
                }
                continue;
            }
            corners.clear();
            for _ in 0..length {
                let index = values.next(property.scalar)?;
                if index < 0.0 || index >= f64::from(u32::MAX) || index.fract() != 0.0 || index.is_nan() {
                    return Err(Found::malformed(place(), format!("{index} is not a vertex index")));
                }
                corners.push(index as u32);
            }
            if corners.len() < 3 {
                let message = format!("it has {} corners, it needs 3", corners.len());
                return Err(Found::malformed(place(), message));
            }
            soup.push_polygon(&corners, place);
        }
    }
    Ok(())
}

fn pass_over(element: &Element, values: &mut Values) -> Result<(), Found> {
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            let length = match property.list_count {
                Some(count) => values.list_length(count, property)?,
                None => 1,
            };
            for _ in 0..length {
                values.next(property.scalar)?;
            }
        }
    }
    Ok(())
}

/// The numbers after the header, one after another.
struct Values<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Number of the line at `at`, counted from 1; only ASCII files have lines.
    line: usize,
    encoding: Encoding,
}

impl Values<'_> {
    fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn place(&self) -> Place {
        match self.encoding {
            Encoding::Ascii => Place::Line(self.line),
            Encoding::LittleEndian | Encoding::BigEndian => Place::Byte(self.at),
        }
    }

    fn truncated(&self, what: String, needed: u128) -> Found {
        Found::at(self.place(), Fault::Truncated { what, needed, available: self.left() })
    }

    /// Refuses a declared count that the rest of the file cannot hold, before anything is allocated for it.
    fn check_declared(&self, element: &Element) -> Result<(), Found> {
        let row: usize = element.properties.iter().map(|p| self.least_size(p.list_count.unwrap_or(p.scalar))).sum();
        // The last number of an ASCII file needs no space behind it.
        let slack = usize::from(matches!(self.encoding, Encoding::Ascii));
        let needed = (element.count as u128 * row as u128).saturating_sub(slack as u128);
        if needed > self.left() as u128 {
            let what = format!("element {} with {} rows", element.name, element.count);
            return Err(self.truncated(what, needed));
        }
        Ok(())
    }

    /// Least number of bytes of a number in the file.
    fn least_size(&self, scalar: Scalar) -> usize {
        match self.encoding {
            Encoding::Ascii => 2,
            Encoding::LittleEndian | Encoding::BigEndian => scalar.size(),
        }
    }

    fn list_length(&mut self, count: Scalar, property: &Property) -> Result<usize, Found> {
        let length = self.next(count)?;
        if length < 0.0 || length.fract() != 0.0 || length.is_nan() {
            let message = format!("{length} is not a length of the list \"{}\"", property.name);
            return Err(Found::malformed(self.place(), message));
        }
        let needed = (length as u128).saturating_mul(self.least_size(property.scalar) as u128).saturating_sub(1);
        if needed > self.left() as u128 {
            return Err(self.truncated(format!("a list of {length} numbers"), needed));
        }
        Ok(length as usize)
    }

    fn next(&mut self, scalar: Scalar) -> Result<f64, Found> {
        match self.encoding {
            Encoding::Ascii => self.next_word(),
            Encoding::LittleEndian | Encoding::BigEndian => {
                let size = scalar.size();
                let Some(bytes) = self.bytes.get(self.at..self.at + size) else {
                    return Err(self.truncated("the next number".into(), size as u128));
                };
                let mut little = [0; 8];
                little[..size].copy_from_slice(bytes);
                if matches!(self.encoding, Encoding::BigEndian) {
                    little[..size].reverse();
                }
                self.at += size;
                Ok(scalar.value(little))
            }
        }
    }

    fn next_word(&mut self) -> Result<f64, Found> {
        while let Some(byte) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_whitespace()) {
            self.line += usize::from(*byte == b'\n');
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if length == 0 {
            return Err(self.truncated("the next number".into(), 1));
        }
        let word = &rest[..length];
        let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        let Some(value) = value else {
            let word = String::from_utf8_lossy(&word[..length.min(40)]);
            return Err(Found::malformed(self.place(), format!("\"{word}\" is not a number")));
        };
        self.at += length;
        Ok(value)
    }
}
