//! Lines of the result on the standard output.

use anyhow::Result;
use std::io::{self, ErrorKind, Write};

/// Prints a line of the result. A reader that has read enough, such as `head`, is no error.
pub fn print(text: &str) -> Result<()> {
    match writeln!(io::stdout(), "{text}") {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}
