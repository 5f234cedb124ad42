//! Reading whole files, and nothing that is not a file.

use crate::error::{Fault, FileError, Found};
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

/// The text of a file.
pub(crate) fn read_text(path: &Path) -> Result<String, FileError> {
    String::from_utf8(read_bytes(path)?).map_err(|error| {
        let byte = error.utf8_error().valid_up_to();
        Found::malformed(crate::Place::Byte(byte), "it is not UTF-8 text").in_file(path)
    })
}
