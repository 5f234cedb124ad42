//! What the cloth is made of.

use crate::{Number, Threshold};
use std::ops::RangeInclusive;

/// Stiffest springs of a fabric [N/m].
const STIFFNESS_MAX: f64 = 1e6;

/// What the cloth is made of.
///
/// The stiffnesses are those of the springs (D eq. 2). On a square grid the stiffness of a structural spring [N/m] is the
/// membrane stiffness of the cloth, whatever the spacing. Springs only carry what the limits do not: elongation is held by
/// the velocity modification, so soft springs do not mean stretchy cloth.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Fabric {
    /// Name shown in metrics.
    pub name: String,
    /// Mass per area [kg/m²], positive.
    pub areal_density: f64,
    /// Stiffness of a structural spring [N/m].
    pub structural_stiffness: f64,
    /// Stiffness of a shear spring [N/m].
    pub shear_stiffness: f64,
    /// Stiffness of a bend spring [N/m] (the papers' flexion).
    pub bend_stiffness: f64,
    /// Bending rigidity [N·m]: moment per width and curvature, as fabric laboratories measure it (B of Kawabata's system, the flexural
    /// rigidity of Peirce's cantilever). It needs structural and bend springs with a stiffness. 0 leaves bending to the bend springs as
    /// the papers have them: they resist a curvature κ like a rigidity of ⅛·stiffness·h⁴·κ² at a spacing h, so hardly any that is small.
    pub bending_rigidity: f64,
    /// Viscous damping rate [1/s]: the damping coefficient of D §3 per particle mass.
    pub damping: f64,
    /// Distance that the cloth keeps from a body [m].
    pub thickness: f64,
    /// Coefficient of Coulomb friction against a body [1].
    pub friction: f64,
    /// Largest elongation that the velocity modification allows, by direction.
    pub threshold: Threshold,
}

impl Fabric {
    /// Smallest and largest threshold [1]. D §4.3 has 1 % to 15 %.
    pub const THRESHOLDS: RangeInclusive<f64> = 0.001..=0.15;

    /// Its numbers, by the names that files give them.
    pub const NUMBERS: &[Number<Self>] = &[
        Number { name: "areal_density", range: 1e-3..=10.0, unit: "kg/m²", of: |fabric| &mut fabric.areal_density },
        Number {
            name: "structural_stiffness",
            range: 1e-3..=STIFFNESS_MAX,
            unit: "N/m",
            of: |fabric| &mut fabric.structural_stiffness,
        },
        Number {
            name: "shear_stiffness",
            range: 0.0..=STIFFNESS_MAX,
            unit: "N/m",
            of: |fabric| &mut fabric.shear_stiffness,
        },
        Number {
            name: "bend_stiffness",
            range: 0.0..=STIFFNESS_MAX,
            unit: "N/m",
            of: |fabric| &mut fabric.bend_stiffness,
        },
        Number { name: "bending_rigidity", range: 0.0..=1.0, unit: "N·m", of: |fabric| &mut fabric.bending_rigidity },
        Number { name: "damping", range: 0.0..=1e3, unit: "1/s", of: |fabric| &mut fabric.damping },
        Number { name: "thickness", range: 0.0..=0.05, unit: "m", of: |fabric| &mut fabric.thickness },
        Number { name: "friction", range: 0.0..=10.0, unit: "", of: |fabric| &mut fabric.friction },
        Number { name: "threshold.warp", range: Self::THRESHOLDS, unit: "", of: |fabric| &mut fabric.threshold.warp },
        Number { name: "threshold.weft", range: Self::THRESHOLDS, unit: "", of: |fabric| &mut fabric.threshold.weft },
        Number { name: "threshold.shear", range: Self::THRESHOLDS, unit: "", of: |fabric| &mut fabric.threshold.shear },
    ];

    /// Names that [`Fabric::preset`] knows, from the softest to the stiffest to bend.
    pub const PRESETS: [&str; 5] = ["silk", "jersey", "cotton", "wool", "denim"];

    /// A fabric by name.
    ///
    /// Weights are those at which such cloth is sold. The bending rigidity of jersey is what Wang, O'Brien and Ramamoorthi measured of an
    /// interlock knit (Data-driven elastic models for cloth, 2011: 0.19 kg/m², 23 µN·m). Those of the others are chosen so that Cusick's
    /// drape coefficient of the simulated cloth lies in the band published for such cloth: silk 20 to 40 %, cotton 60 to 76 %,
    /// wool 40 to 70 %, denim 70 to 90 %. They are higher than a laboratory finds for the same coefficient, because springs along warp
    /// and weft do not resist twisting. The stiffnesses are soft on purpose: limits hold the stretch. Damping, thickness, friction and
    /// threshold are by the look of the drape.
    pub fn preset(name: &str) -> Option<Self> {
        let preset = |areal_density: f64, stiffness: [f64; 3], bending_rigidity: f64, rest: [f64; 4]| Self {
            name: name.into(),
            areal_density,
            structural_stiffness: stiffness[0],
            shear_stiffness: stiffness[1],
            bend_stiffness: stiffness[2],
            bending_rigidity,
            damping: rest[0],
            thickness: rest[1],
            friction: rest[2],
            threshold: Threshold::even(rest[3]),
        };
        Some(match name {
            "silk" => preset(0.12, [20.0, 6.0, 0.5], 8e-6, [1.0, 0.0015, 0.3, 0.05]),
            "jersey" => preset(0.19, [25.0, 7.5, 1.0], 2.3e-5, [1.5, 0.002, 0.4, 0.1]),
            "cotton" => preset(0.15, [30.0, 12.0, 3.0], 4e-5, [2.0, 0.003, 0.4, 0.05]),
            "wool" => preset(0.25, [40.0, 16.0, 6.0], 4.5e-5, [2.0, 0.003, 0.45, 0.06]),
            "denim" => preset(0.4, [60.0, 30.0, 15.0], 2e-4, [3.0, 0.003, 0.5, 0.03]),
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Fabric;

    #[test]
    fn every_preset_exists_and_no_other() {
        for name in Fabric::PRESETS {
            assert_eq!(Fabric::preset(name).expect("a preset").name, name);
        }
        assert_eq!(Fabric::preset("tweed"), None);
    }

    #[test]
    fn presets_are_listed_from_soft_to_stiff() {
        let bend: Vec<f64> =
            Fabric::PRESETS.iter().map(|name| Fabric::preset(name).expect("a preset").bending_rigidity).collect();
        assert!(bend.is_sorted_by(|a, b| a < b), "{bend:?}");
    }
}
