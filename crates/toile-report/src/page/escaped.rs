//! Texts on their way into HTML and SVG.

/// A text in which nothing is taken for a tag of HTML or SVG.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
