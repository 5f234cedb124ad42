//! How a garment is worn, as `metrics.json` has it.

use serde::{Deserialize, Serialize};
use toile::model::Verdict;

/// How a garment is worn.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Told {
    /// Its name.
    pub garment: String,
    /// In a word or three: "on", or the worst of what is wrong.
    pub word: String,
    /// Whether it is on, though it may be too tight.
    pub is_worn: bool,
    /// What is wrong, a sentence for each finding.
    pub sentences: Vec<String>,
    /// What is wrong and what goes through its openings, in metres.
    #[serde(flatten)]
    pub verdict: Verdict,
}

impl Told {
    /// A verdict on a garment.
    pub fn new(garment: &str, verdict: &Verdict) -> Self {
        Self {
            garment: garment.to_owned(),
            word: verdict.word().to_owned(),
            is_worn: verdict.is_worn(),
            sentences: verdict.findings.iter().map(ToString::to_string).collect(),
            verdict: verdict.clone(),
        }
    }
}
