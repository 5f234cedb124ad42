//! What is wrong with a file that names other files.

use crate::error::{FileError, Found};
use std::path::Path;

/// A fault in the file at hand, or in another one that it names.
pub(crate) enum Problem {
    Here(Found),
    There(FileError),
}

impl Problem {
    pub fn in_file(self, path: &Path) -> FileError {
        match self {
            Self::Here(found) => found.in_file(path),
            Self::There(error) => error,
        }
    }
}

impl From<Found> for Problem {
    fn from(found: Found) -> Self {
        Self::Here(found)
    }
}

impl From<FileError> for Problem {
    fn from(error: FileError) -> Self {
        Self::There(error)
    }
}
