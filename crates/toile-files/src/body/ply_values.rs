//! The numbers after the header of a PLY file, one after another.

use crate::body::number::{no_number, number};
use crate::body::ply_header::{Element, Encoding, Header, Property, Scalar};
use crate::error::{Fault, Found, Place};

/// The numbers, and how far they are read.
pub(crate) struct Values<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Number of the line at `at`, counted from 1; only ASCII files have lines.
    line: usize,
    encoding: Encoding,
}

impl<'a> Values<'a> {
    pub fn after(header: &Header, bytes: &'a [u8]) -> Self {
        Self { bytes, at: header.length, line: header.lines, encoding: header.encoding }
    }

    pub fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    pub fn place(&self) -> Place {
        match self.encoding {
            Encoding::Ascii => Place::Line(self.line),
            Encoding::LittleEndian | Encoding::BigEndian => Place::Byte(self.at),
        }
    }

    fn truncated(&self, what: String, needed: u128) -> Found {
        Found::at(self.place(), Fault::Truncated { what, needed, available: self.left() })
    }

    /// Refuses a declared count that the rest of the file cannot hold, before anything is allocated for it.
    pub fn check_declared(&self, element: &Element) -> Result<(), Found> {
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

    pub fn list_length(&mut self, count: Scalar, property: &Property) -> Result<usize, Found> {
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

    pub fn next(&mut self, scalar: Scalar) -> Result<f64, Found> {
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

    pub fn pass_spaces(&mut self) {
        while let Some(byte) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_whitespace()) {
            let ends = *byte == b'\n' || (*byte == b'\r' && self.bytes.get(self.at + 1) != Some(&b'\n'));
            self.line += usize::from(ends);
            self.at += 1;
        }
    }

    fn next_word(&mut self) -> Result<f64, Found> {
        self.pass_spaces();
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if length == 0 {
            return Err(self.truncated("the next number".into(), 1));
        }
        let word = &rest[..length];
        let Some(value) = number(word) else {
            return Err(Found::malformed(self.place(), no_number(word)));
        };
        self.at += length;
        Ok(value)
    }
}
