//! Numbers as the pages show them.

use crate::page::content::Cell;

/// A number with three significant digits: plain from a thousandth to a hundred thousand, with an exponent outside.
pub fn three_digits(value: f64) -> String {
    significant(value, 3)
}

/// The shortest text of a number that keeps six significant digits: for ticks, which are round.
pub(crate) fn tick(value: f64) -> String {
    let text = significant(value, 6);
    match text.split_once('e') {
        Some((digits, exponent)) => format!("{}e{exponent}", trimmed(digits)),
        None => trimmed(&text).to_owned(),
    }
}

fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    // The exponent after rounding: 999.7 has four digits before the point when it is shown with three.
    let scientific = format!("{value:.*e}", digits - 1);
    let exponent: i32 = scientific.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    if !(-3..5).contains(&exponent) {
        return scientific;
    }
    format!("{value:.*}", usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0))
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

impl Cell {
    /// The figure as a page shows it.
    pub fn shown(&self) -> String {
        match self {
            Cell::Text(text) => text.clone(),
            Cell::Number(value) => three_digits(*value),
            Cell::Count(count) => count.to_string(),
            Cell::Missing => "–".to_owned(),
        }
    }

    /// Its number; `None` for words and what was not measured.
    pub fn value(&self) -> Option<f64> {
        match self {
            Cell::Number(value) => Some(*value),
            Cell::Count(count) => Some(*count as f64),
            Cell::Text(_) | Cell::Missing => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{three_digits, tick};

    #[test]
    fn numbers_have_three_digits_whatever_their_size() {
        let shown = |values: &[f64]| values.iter().map(|v| three_digits(*v)).collect::<Vec<_>>();
        assert_eq!(
            shown(&[0.0, 1.0, -0.12345, 999.7, 12345.6, 99999.0, 123456.0, 0.00123456, 0.000999, 4e-300]),
            ["0", "1.00", "-0.123", "1000", "12346", "1.00e5", "1.23e5", "0.00123", "9.99e-4", "4.00e-300"]
        );
    }

    #[test]
    fn ticks_have_no_zeros_to_spare() {
        let shown = [0.5, 100.0, 0.001, 1e-6, 2.5e7, 0.30000000000000004].map(tick);
        assert_eq!(shown, ["0.5", "100", "0.001", "1e-6", "2.5e7", "0.3"]);
    }
}
