//! Reading whole files, and nothing that is not a file.

use crate::error::{Fault, FileError, Found, Place};
use std::borrow::Cow;
use std::path::Path;

/// The bytes of a file. A pipe or a device has no end to wait for, so it is refused.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    let refuse = |error| Found::from(Fault::Unreadable(error)).in_file(path);
    let metadata = std::fs::metadata(path).map_err(refuse)?;
    if !metadata.is_file() {
        let error = std::io::Error::new(std::io::ErrorKind::InvalidInput, "it is not a plain file");
        return Err(refuse(error));
    }
    std::fs::read(path).map_err(refuse)
}

/// The text of a file without its byte order mark.
pub(crate) fn read_text(path: &Path) -> Result<String, FileError> {
    let bytes = read_bytes(path)?;
    text(&bytes).map(Cow::into_owned).map_err(|found| found.in_file(path))
}

/// Bytes as text without a byte order mark: UTF-8, or UTF-16 where a mark says so.
///
/// Editors write the mark, and shells of Windows write UTF-16.
pub(crate) fn text(bytes: &[u8]) -> Result<Cow<'_, str>, Found> {
    Ok(match utf8(bytes) {
        Cow::Borrowed(bytes) => Cow::Borrowed(std::str::from_utf8(bytes).map_err(no_text)?),
        Cow::Owned(bytes) => Cow::Owned(String::from_utf8(bytes).map_err(|error| no_text(error.utf8_error()))?),
    })
}

/// The same bytes as UTF-8 without a byte order mark. What is no UTF-16 is not looked at.
pub(crate) fn utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    let units = |rest: &[u8], unit: fn([u8; 2]) -> u16| {
        let units = rest.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        let text: String = char::decode_utf16(units).map(|unit| unit.unwrap_or(char::REPLACEMENT_CHARACTER)).collect();
        Cow::Owned(text.into_bytes())
    };
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        [0xff, 0xfe, rest @ ..] => units(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => units(rest, u16::from_be_bytes),
        _ => Cow::Borrowed(bytes),
    }
}

fn no_text(error: std::str::Utf8Error) -> Found {
    Found::malformed(Place::Byte(error.valid_up_to()), "it is not UTF-8 text: save it as UTF-8")
}

#[cfg(test)]
mod tests {
    use super::text;

    #[test]
    fn marks_of_every_kind_are_no_part_of_the_text() {
        let units = |bytes: fn(u16) -> [u8; 2]| -> Vec<u8> { "\u{feff}{é}".encode_utf16().flat_map(bytes).collect() };
        let written = ["{é}".into(), "\u{feff}{é}".into(), units(u16::to_le_bytes), units(u16::to_be_bytes)];
        for bytes in written {
            assert_eq!(text(&bytes).expect("text"), "{é}");
        }
        assert_eq!(text(b"").expect("text"), "");
        let refused = text(b"{\xe9}").expect_err("no UTF-8").in_file("a").to_string();
        assert_eq!(refused, "a, byte 1: it is not UTF-8 text: save it as UTF-8");
    }
}
