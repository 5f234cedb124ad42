//! Reports as JSON, out and in.

use crate::page::content::Report;

/// A report as JSON, for programs and for [`compare`](crate::page::compare).
pub fn json(report: &Report) -> String {
    serde_json::to_string_pretty(report).expect("a report has no key that is not a text")
}

/// Reads a report back.
///
/// # Errors
/// What is wrong with the text, with line and column.
pub fn parse(text: &str) -> Result<Report, serde_json::Error> {
    serde_json::from_str(text)
}
