//! Numbers of text files.

/// A number as programs print it; what they print for NaN and infinity is one of both.
pub(crate) fn number(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    text.parse().ok().or_else(|| {
        let text = text.to_ascii_lowercase();
        let printed = ["nan(", "-nan(", "1.#", "-1.#"];
        printed.iter().any(|start| text.starts_with(start)).then_some(f64::NAN)
    })
}

/// Why a word is not a number.
pub(crate) fn no_number(word: &[u8]) -> String {
    let text = String::from_utf8_lossy(&word[..word.len().min(40)]);
    if text.contains(',') && number(text.replace(',', ".").as_bytes()).is_some() {
        return format!("\"{text}\" has a decimal comma: export it with decimal points");
    }
    format!("\"{text}\" is not a number")
}

#[cfg(test)]
mod tests {
    use super::{no_number, number};

    #[test]
    fn numbers_are_read_as_programs_print_them() {
        for (word, value) in [("1", 1.0), ("-0.5", -0.5), ("+3", 3.0), (".5", 0.5), ("5.", 5.0), ("1E-3", 0.001)] {
            assert_eq!(number(word.as_bytes()), Some(value), "{word}");
        }
        for word in ["nan", "NaN", "-nan", "-nan(ind)", "nan(0x8000)", "1.#QNAN", "-1.#IND0", "1.#INF"] {
            assert!(number(word.as_bytes()).is_some_and(|value| !value.is_finite()), "{word}");
        }
        for word in ["", "one", "1,5", "0x10", "1.#", "\u{fc}"] {
            assert!(number(word.as_bytes()).is_none_or(f64::is_nan), "{word}");
        }
    }

    #[test]
    fn a_decimal_comma_is_named() {
        assert_eq!(no_number(b"1,5"), "\"1,5\" has a decimal comma: export it with decimal points");
        assert_eq!(no_number(b"-0,25e-3"), "\"-0,25e-3\" has a decimal comma: export it with decimal points");
        assert_eq!(no_number(b"1,2,3"), "\"1,2,3\" is not a number");
        assert_eq!(no_number(b"up"), "\"up\" is not a number");
    }
}
