//! What is measured of a run: `metrics.json`.

mod contact;
mod frames;
mod measures;
mod told;

pub use contact::{Surfaces, is_far, reach};
pub use frames::StrainRow;
pub use measures::Measures;
pub use told::Told;

use crate::worn::Worn;
use serde::Serialize;

/// What is measured of a run. The names are stable.
#[derive(Debug, Serialize)]
pub struct Metrics {
    /// Scene, or "outfit".
    pub scene: String,
    /// Name of the adapter, or "reference".
    pub adapter: String,
    /// What was found before sewing, and what was mended.
    pub fit: Vec<String>,
    /// All cloths together.
    #[serde(flatten)]
    pub whole: Measures,
    /// Each cloth.
    pub cloths: Vec<ClothMetrics>,
}

/// What is measured of one cloth.
#[derive(Debug, Serialize)]
pub struct ClothMetrics {
    /// Name of the garment or sheet.
    pub name: String,
    /// How it is worn; null of a sheet.
    pub verdict: Option<Told>,
    /// Elongation that the fabric allows along warp, weft and bias [1].
    pub threshold: [f64; 3],
    /// What is measured.
    #[serde(flatten)]
    pub measures: Measures,
    /// How far it was stretched at the end of each frame of the run, or of draping.
    pub frames: Vec<StrainRow>,
}

impl Metrics {
    /// The metrics of all cloths of a run.
    pub fn new(scene: &str, adapter: &str, fit: Vec<String>, cloths: Vec<ClothMetrics>) -> Self {
        let whole = cloths.iter().map(|cloth| cloth.measures.clone()).reduce(Measures::with).unwrap_or_default();
        Self { scene: scene.to_owned(), adapter: adapter.to_owned(), fit, whole, cloths }
    }
}

impl ClothMetrics {
    /// Measures a cloth against the surfaces that it lies over; `texel` is that of their maps [m].
    pub fn new(worn: &Worn, surfaces: &Surfaces, texel: f32) -> Self {
        let measures = Measures::new(worn, surfaces, texel);
        let verdict = worn.verdict.as_ref().map(|verdict| Told::new(&worn.name, verdict));
        let threshold = worn.model.threshold;
        let threshold = [threshold.warp, threshold.weft, threshold.shear];
        Self { name: worn.name.clone(), verdict, threshold, measures, frames: StrainRow::all(worn) }
    }

    /// The cloth on one line, for the terminal.
    pub fn line(&self) -> String {
        let m = &self.measures;
        let mut parts: Vec<String> = self.verdict.iter().map(|verdict| verdict.word.clone()).collect();
        parts.push(format!("{} particles", m.particle_count));
        parts.push(match m.steps_sewing {
            0 => format!("{} steps", m.steps_draping),
            sewing => format!("sewn in {sewing} steps to {:.1} mm, draped in {}", m.seam_gap_max_mm, m.steps_draping),
        });
        parts.push(elongation(m.elongation_max, m.elongation_p99, self.threshold));
        if m.further_sweeps > 0 {
            parts.push(format!("{} further sweeps, target missed in {} steps", m.further_sweeps, m.missed_steps));
        }
        if let (Some(max), Some(p99)) = (m.penetration_max_mm, m.penetration_p99_mm) {
            parts.push(format!("{} (99 of 100: {})", depth(max), depth(p99)));
        }
        if let (Some(edge), Some(face)) = (m.edge_penetration_max_mm, m.face_penetration_max_mm) {
            parts.push(format!("edges {}, faces {}", depth(edge), depth(face)));
        }
        if let Some(count) = m.crossed_count.filter(|count| *count > 0) {
            parts.push(format!("{count} particles on the wrong side"));
        }
        format!("{}: {}", self.name, parts.join(" · "))
    }
}

/// Elongations [1] beside what the fabric allows along warp, weft and bias [1], in words.
pub fn elongation(max: f64, p99: f64, threshold: [f64; 3]) -> String {
    let [warp, weft, shear] = threshold.map(|threshold| format!("{:.1}", 1e2 * threshold));
    let allowed = if warp == weft && weft == shear { warp } else { format!("{warp}, {weft} and {shear}") };
    format!("elongation {:.1} % of {allowed} % allowed (99 of 100: {:.1} %)", 1e2 * max, 1e2 * p99)
}

/// How deep something is in a body [mm], in words; what is outside keeps clear of it.
pub fn depth(millimetres: f64) -> String {
    let word = if millimetres > 0.0 { "inside" } else { "clear" };
    format!("{:.1} mm {word}", millimetres.abs())
}

#[cfg(test)]
mod tests {
    use super::{depth, elongation};

    #[test]
    fn numbers_are_words_that_need_no_sign() {
        assert_eq!([-1.14, 0.0, 2.5].map(depth), ["1.1 mm clear", "0.0 mm clear", "2.5 mm inside"]);
        let even = elongation(0.048, 0.034, [0.05; 3]);
        assert_eq!(even, "elongation 4.8 % of 5.0 % allowed (99 of 100: 3.4 %)");
        let woven = elongation(0.048, 0.034, [0.02, 0.03, 0.1]);
        assert!(woven.starts_with("elongation 4.8 % of 2.0, 3.0 and 10.0 % allowed"), "{woven}");
    }
}
