//! The largest of many values, and the one that nearly all stay below.

/// Largest value, and the one that 99 of 100 do not exceed; `None` without values. NaN counts as the largest.
pub fn max_and_p99(mut values: Vec<f64>) -> Option<[f64; 2]> {
    values.sort_by(f64::total_cmp);
    let rank = (99 * values.len()).div_ceil(100);
    Some([*values.last()?, values[rank - 1]])
}

#[cfg(test)]
mod tests {
    use super::max_and_p99;

    #[test]
    fn the_99th_percentile_is_a_value_that_occurs() {
        let values: Vec<f64> = (1..=200).rev().map(f64::from).collect();
        assert_eq!(max_and_p99(values), Some([200.0, 198.0]));
        assert_eq!(max_and_p99(vec![3.0]), Some([3.0, 3.0]));
        assert_eq!(max_and_p99(vec![]), None);
        assert!(max_and_p99(vec![f64::NAN, 1.0]).is_some_and(|[max, _]| max.is_nan()));
    }
}
