//! The header of a PLY file: encoding, elements and their properties.

use crate::error::{Found, Place};

/// How the numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// Type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// A number, or a list of numbers, in every row of an element.
#[derive(Debug)]
pub(crate) struct Property {
    pub name: String,
    pub scalar: Scalar,
    /// Type of the list's length; `None` for a single number.
    pub list_count: Option<Scalar>,
}

/// A table of the file.
#[derive(Debug)]
pub(crate) struct Element {
    pub name: String,
    /// Declared number of rows, not yet compared with the size of the file.
    pub count: usize,
    pub properties: Vec<Property>,
}

/// Everything before the numbers.
#[derive(Debug)]
pub(crate) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Number of bytes up to the first number.
    pub length: usize,
    /// Number of the first line after the header, counted from 1.
    pub lines: usize,
}

impl Header {
    pub fn read(bytes: &[u8]) -> Result<Self, Found> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut length = 0;
        // Binary numbers follow at once, so the first line says how lines end.
        let end = if bytes.get(3) == Some(&b'\r') && bytes.get(4) != Some(&b'\n') { b'\r' } else { b'\n' };
        for (number, line) in bytes.split_inclusive(|byte| *byte == end).enumerate() {
            length += line.len();
            let wrong = |message: String| Found::malformed(Place::Line(number + 1), message);
            let line = String::from_utf8_lossy(&line[..line.len().min(1000)]);
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            match words.as_slice() {
                ["ply"] if number == 0 => {}
                _ if number == 0 => {
                    return Err(wrong("a PLY file starts with the line \"ply\"".into()));
                }
                [] | ["comment" | "obj_info", ..] => {}
                ["format", name, _] => {
                    encoding = Some(match *name {
                        "ascii" => Encoding::Ascii,
                        "binary_little_endian" => Encoding::LittleEndian,
                        "binary_big_endian" => Encoding::BigEndian,
                        _ => return Err(wrong(format!("the format \"{name}\" is not known"))),
                    });
                }
                ["element", name, count] => elements.push(Element {
                    name: (*name).into(),
                    count: count.parse().map_err(|_| wrong(format!("\"{count}\" is not a number of rows")))?,
                    properties: Vec::new(),
                }),
                ["property", rest @ ..] => {
                    let property = property(rest).map_err(wrong)?;
                    elements
                        .last_mut()
                        .ok_or_else(|| wrong("a property before any element".into()))?
                        .properties
                        .push(property);
                }
                ["end_header"] => {
                    let encoding = encoding.ok_or_else(|| wrong("the header has no line \"format\"".into()))?;
                    return Ok(Self { encoding, elements, length, lines: number + 2 });
                }
                _ => {
                    return Err(wrong(format!("\"{}\" is no line of a PLY header", line.trim())));
                }
            }
        }
        Err(Found::malformed(Place::Byte(bytes.len()), "the header has no line \"end_header\""))
    }
}

fn property(words: &[&str]) -> Result<Property, String> {
    let scalar = |word: &str| Scalar::named(word).ok_or(format!("the type \"{word}\" is not known"));
    match words {
        ["list", count, kind, name] => {
            Ok(Property { name: (*name).into(), scalar: scalar(kind)?, list_count: Some(scalar(count)?) })
        }
        [kind, name] => Ok(Property { name: (*name).into(), scalar: scalar(kind)?, list_count: None }),
        _ => Err(format!("\"property {}\" is not complete", words.join(" "))),
    }
}

impl Element {
    /// The property of that name if it is a single number.
    pub fn scalar(&self, name: &str) -> Option<&Property> {
        self.properties.iter().find(|p| p.name == name && p.list_count.is_none())
    }
}

impl Scalar {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Size in a binary file [bytes].
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// The value of little-endian bytes; bytes beyond the size are zero.
    pub fn value(self, b: [u8; 8]) -> f64 {
        match self {
            Self::I8 => f64::from(i8::from_le_bytes([b[0]])),
            Self::U8 => f64::from(b[0]),
            Self::I16 => f64::from(i16::from_le_bytes([b[0], b[1]])),
            Self::U16 => f64::from(u16::from_le_bytes([b[0], b[1]])),
            Self::I32 => f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::U32 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::F32 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::F64 => f64::from_le_bytes(b),
        }
    }
}
