//! How far cloth may be stretched, by direction.

use glam::DVec2;

/// Largest elongation that the velocity modification allows [1], by direction in the flat panel: y is along the warp, x along the weft.
/// D §4.3: 1 % to 15 %. Woven cloth gives little along its yarns, and shears easily.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Threshold {
    /// Along the warp: y of the panel.
    pub warp: f64,
    /// Along the weft: x of the panel.
    pub weft: f64,
    /// Along the bias, at 45° to both: an elongation e there is a shear angle of about 2·e.
    pub shear: f64,
}

impl Threshold {
    /// The same in all directions.
    pub const fn even(threshold: f64) -> Self {
        Self { warp: threshold, weft: threshold, shear: threshold }
    }

    /// The largest elongation allowed along a direction [1], which need not have unit length: weft·cos² + warp·sin², as strains turn, and
    /// what the bias allows beyond their mean by sin² of twice the angle; never below [`Self::least`]. Along no direction it is that of the weft.
    pub fn along(&self, direction: DVec2) -> f64 {
        let Some(unit) = direction.try_normalize() else { return self.weft };
        let [cos2, sin2] = [unit.x * unit.x, unit.y * unit.y];
        let bias = self.shear - 0.5 * (self.warp + self.weft);
        // A bias that gives less than warp and weft do would pull what lies between below it.
        (self.weft + (self.warp - self.weft) * sin2 + bias * 4.0 * cos2 * sin2).max(self.least())
    }

    /// The smallest of the three [1].
    pub fn least(&self) -> f64 {
        self.warp.min(self.weft).min(self.shear)
    }

    /// The largest of the three [1].
    pub fn most(&self) -> f64 {
        self.warp.max(self.weft).max(self.shear)
    }
}

#[cfg(test)]
mod tests {
    use super::Threshold;
    use glam::{DVec2, dvec2};
    use proptest::prelude::*;

    const WOVEN: Threshold = Threshold { warp: 0.02, weft: 0.03, shear: 0.1 };

    #[test]
    fn warp_weft_and_bias_have_their_own() {
        assert_eq!(WOVEN.along(DVec2::Y), 0.02);
        assert_eq!(WOVEN.along(DVec2::X), 0.03);
        for bias in [dvec2(2.0, 2.0), dvec2(1.0, -1.0), dvec2(-0.1, 0.1)] {
            assert!((WOVEN.along(bias) - 0.1).abs() < 1e-12, "{bias}");
        }
    }

    proptest! {
        #[test]
        fn an_even_one_is_the_same_along_any_direction(angle in -10.0..10.0_f64, threshold in 0.001..0.15_f64) {
            prop_assert_eq!(Threshold::even(threshold).along(3.0 * DVec2::from_angle(angle)), threshold);
        }

        #[test]
        fn no_direction_allows_less_than_the_least(
            [warp, weft, shear] in proptest::array::uniform3(0.001..0.15_f64),
            angle in -10.0..10.0_f64,
        ) {
            let threshold = Threshold { warp, weft, shear };
            prop_assert!(threshold.along(DVec2::from_angle(angle)) >= threshold.least());
        }
    }
}
