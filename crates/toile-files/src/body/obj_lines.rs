//! The lines of an OBJ file: every kind of line end, and lines that go on after a backslash.

/// The lines of a text, each with the number of its first one, counted from 1.
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
    /// A line that was put together.
    joined: Vec<u8>,
}

impl<'a> Lines<'a> {
    /// Of a text in which a line ends with LF, CR LF, or CR.
    pub fn of(text: &'a [u8]) -> Self {
        Self { rest: text, number: 0, joined: Vec::new() }
    }

    /// The next line and its number. A backslash at the end goes on with the line below, save in a comment, where it ends a path.
    pub fn read(&mut self) -> Option<(&[u8], usize)> {
        let mut line = self.cut()?;
        let number = self.number;
        let is_comment = line.trim_ascii_start().starts_with(b"#");
        if is_comment || !line.trim_ascii_end().ends_with(b"\\") {
            return Some((line, number));
        }
        self.joined.clear();
        loop {
            let part = line.trim_ascii_end();
            match part.strip_suffix(b"\\") {
                Some(part) => self.joined.extend(part),
                None => {
                    self.joined.extend(part);
                    break;
                }
            }
            self.joined.push(b' ');
            match self.cut() {
                Some(next) => line = next,
                None => break,
            }
        }
        Some((&self.joined, number))
    }

    /// One line as it stands.
    fn cut(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number += 1;
        let end = self.rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(self.rest.len());
        let line = &self.rest[..end];
        let after = &self.rest[end..];
        let width = if after.starts_with(b"\r\n") { 2 } else { after.len().min(1) };
        self.rest = &after[width..];
        Some(line)
    }
}

#[cfg(test)]
mod tests {
    use super::Lines;

    fn all(text: &str) -> Vec<(String, usize)> {
        let mut lines = Lines::of(text.as_bytes());
        let mut all = Vec::new();
        while let Some((line, number)) = lines.read() {
            all.push((String::from_utf8_lossy(line).into_owned(), number));
        }
        all
    }

    fn told(lines: &[(&str, usize)]) -> Vec<(String, usize)> {
        lines.iter().map(|(line, number)| ((*line).to_owned(), *number)).collect()
    }

    #[test]
    fn every_kind_of_line_end_ends_a_line() {
        for end in ["\n", "\r\n", "\r"] {
            let text = ["a", "", "b"].join(end);
            assert_eq!(all(&text), told(&[("a", 1), ("", 2), ("b", 3)]), "{end:?}");
            assert_eq!(all(&(text + end)), told(&[("a", 1), ("", 2), ("b", 3)]), "{end:?}");
        }
        assert_eq!(all(""), []);
    }

    #[test]
    fn a_backslash_joins_lines_and_their_number_is_that_of_the_first() {
        for end in ["\n", "\r\n", "\r"] {
            let text = format!("f 1{end}f 1 \\{end} 2\\{end}3{end}# C:\\{end}v");
            assert_eq!(all(&text), told(&[("f 1", 1), ("f 1   2 3", 2), ("# C:\\", 5), ("v", 6)]), "{end:?}");
        }
        assert_eq!(all("f 1 \\"), told(&[("f 1  ", 1)]));
        assert_eq!(all("f 1 \\ \n2"), told(&[("f 1  2", 1)]));
    }
}
