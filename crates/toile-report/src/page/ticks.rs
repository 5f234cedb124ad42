//! Round values along an axis, and where values lie on it.

use crate::page::content::{Axis, AxisScale};

/// The part of an axis that a plot shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Span {
    scale: AxisScale,
    low: f64,
    high: f64,
}

impl Span {
    /// The span of an axis around some values, from round value to round value; 0 to 1, or 1 to 10, without any.
    pub(crate) fn around(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let scale = axis.scale;
        let [low, high] = values
            .filter(|value| scale == AxisScale::Linear || *value > 0.0)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
        match scale {
            AxisScale::Log if low > high => Self { scale, low: 1.0, high: 10.0 },
            AxisScale::Linear if low > high => Self { scale, low: 0.0, high: 1.0 },
            AxisScale::Log => Self::log(low, high),
            AxisScale::Linear => {
                // Zero belongs to an axis that comes near it: a curve that starts elsewhere looks steeper than it is.
                let [low, high] = if low > 0.0 && low < 0.5 * high { [0.0, high] } else { [low, high] };
                let [low, high] = if low == high {
                    [low - 0.5 * low.abs().max(1.0), high + 0.5 * high.abs().max(1.0)]
                } else {
                    [low, high]
                };
                let step = linear_step(high - low);
                Self { scale, low: (low / step + 1e-9).floor() * step, high: (high / step - 1e-9).ceil() * step }
            }
        }
    }

    /// From and to 1, 2 or 5 times a power of ten.
    fn log(low: f64, high: f64) -> Self {
        let below = |value: f64| {
            let decade = 10_f64.powf((value.log10() + 1e-9).floor());
            [5.0, 2.0, 1.0]
                .map(|part| part * decade)
                .into_iter()
                .find(|round| *round <= value * 1.0001)
                .unwrap_or(decade)
        };
        let above = |value: f64| {
            let decade = 10_f64.powf((value.log10() - 1e-9).floor());
            [1.0, 2.0, 5.0]
                .map(|part| part * decade)
                .into_iter()
                .find(|round| *round >= value * 0.9999)
                .unwrap_or(10.0 * decade)
        };
        let [low, high] = [below(low), above(high)];
        Self { scale: AxisScale::Log, low, high: if high > low { high } else { 2.0 * low } }
    }

    /// Where a value lies, 0 to 1 inside the span; `None` for what a logarithmic axis cannot show.
    pub(crate) fn share(&self, value: f64) -> Option<f64> {
        match self.scale {
            AxisScale::Linear => Some((value - self.low) / (self.high - self.low)),
            AxisScale::Log if value > 0.0 => Some((value / self.low).ln() / (self.high / self.low).ln()),
            AxisScale::Log => None,
        }
    }

    /// Round values in the span, ascending; between four and a dozen where they are labelled.
    pub(crate) fn ticks(&self) -> Vec<f64> {
        match self.scale {
            AxisScale::Linear => {
                let step = linear_step(self.high - self.low);
                let first = (self.low / step).round() as i64;
                let last = (self.high / step).round() as i64;
                (first..=last).map(|k| k as f64 * step).collect()
            }
            AxisScale::Log => {
                let decades = [self.low, self.high].map(f64::log10);
                let width = decades[1] - decades[0];
                let parts: &[f64] = if width <= 3.0 { &[1.0, 2.0, 5.0] } else { &[1.0] };
                let stride = (width / 10.0).ceil().max(1.0) as i32;
                let [first, last] = [decades[0].floor() as i32, decades[1].ceil() as i32];
                (first..=last)
                    .filter(|decade| decade.rem_euclid(stride) == 0)
                    .flat_map(|decade| parts.iter().map(move |part| part * 10_f64.powi(decade)))
                    .filter(|value| *value >= self.low * 0.999 && *value <= self.high * 1.001)
                    .collect()
            }
        }
    }
}

/// 1, 2 or 5 times a power of ten, so that a width has four to ten steps.
fn linear_step(width: f64) -> f64 {
    let rough = width / 6.0;
    let decade = 10_f64.powf(rough.log10().floor());
    [1.0, 2.0, 5.0, 10.0].map(|part| part * decade).into_iter().find(|step| *step >= rough).unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::Span;
    use crate::page::content::Axis;

    fn ticks(axis: &Axis, values: &[f64]) -> Vec<f64> {
        Span::around(axis, values.iter().copied()).ticks()
    }

    #[test]
    fn linear_ticks_are_round_and_begin_at_zero_where_it_is_near() {
        let axis = Axis::linear("way", "m");
        assert_eq!(ticks(&axis, &[1.0, 9.3]), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(ticks(&axis, &[101.0, 104.0]), [101.0, 101.5, 102.0, 102.5, 103.0, 103.5, 104.0]);
        assert_eq!(ticks(&axis, &[]).len(), 6);
        assert!(ticks(&axis, &[3.0, 3.0]).len() > 3, "one value has an axis too");
    }

    #[test]
    fn logarithmic_ticks_are_powers_of_ten_or_parts_of_them() {
        let axis = Axis::log("error", "m");
        assert_eq!(ticks(&axis, &[0.003, 0.04]), [0.002, 0.005, 0.01, 0.02, 0.05]);
        assert_eq!(ticks(&axis, &[1e-7, 1.0]).len(), 8);
        assert!(ticks(&axis, &[1e-30, 1.0]).len() <= 12);
        assert_eq!(ticks(&axis, &[0.0, -1.0]), [1.0, 2.0, 5.0, 10.0], "nothing that it can show");
    }

    #[test]
    fn the_ends_of_a_span_are_its_borders() {
        let span = Span::around(&Axis::log("error", "m"), [0.01, 10.0].into_iter());
        assert!(span.share(0.01).is_some_and(|share| share.abs() < 1e-12));
        assert!(span.share(10.0).is_some_and(|share| (share - 1.0).abs() < 1e-12));
        assert_eq!(span.share(0.0), None);
    }
}
