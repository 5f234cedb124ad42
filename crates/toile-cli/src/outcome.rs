//! How a run ended that was done.

use toile::model::Verdict;

/// How a run ended that was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// As it was meant.
    Done,
    /// Everything is written, but a garment is not on.
    NotWorn,
}

impl Outcome {
    /// That of garments.
    pub fn of<'a>(verdicts: impl IntoIterator<Item = &'a Verdict>) -> Self {
        if verdicts.into_iter().all(Verdict::is_worn) { Self::Done } else { Self::NotWorn }
    }
}

/// Says what is wrong with a garment, a line for each.
pub fn warn(garment: &str, verdict: &Verdict) {
    for finding in &verdict.findings {
        eprintln!("warning: garment {garment}: {finding}");
    }
}
