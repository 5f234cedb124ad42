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
        Self { name: worn.name.clone(), verdict, measures, frames: StrainRow::all(worn) }
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
        parts.push(format!("elongation {:.1} % (99 of 100: {:.1} %)", 1e2 * m.elongation_max, 1e2 * m.elongation_p99));
        if m.further_sweeps > 0 {
            parts.push(format!("{} further sweeps, target missed in {} steps", m.further_sweeps, m.missed_steps));
        }
        if let (Some(max), Some(p99)) = (m.penetration_max_mm, m.penetration_p99_mm) {
            parts.push(format!("penetration {max:.1} mm (99 of 100: {p99:.1} mm)"));
        }
        if let (Some(edge), Some(face)) = (m.edge_penetration_max_mm, m.face_penetration_max_mm) {
            parts.push(format!("edges {edge:.1} mm, faces {face:.1} mm"));
        }
        if let Some(count) = m.crossed_count.filter(|count| *count > 0) {
            parts.push(format!("{count} particles on the wrong side"));
        }
        format!("{}: {}", self.name, parts.join(" · "))
    }
}
