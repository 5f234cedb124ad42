//! What is said of a scene before it is sewn, with the options that decide otherwise.

use anyhow::{Result, anyhow};
use toile::model::{Finding, Fit, FitError, FitOptions};
use toile::scene::Scene;

/// Looks at a scene; what cannot be mended is one sentence with the option that can.
pub fn look(scene: &Scene, options: &FitOptions) -> Result<Fit> {
    Fit::new(scene, options).map_err(|error| match &error {
        FitError::Lies { .. } => anyhow!("{error} with --up"),
        FitError::InBody { .. } => anyhow!("{error} (--clip and --time choose a pose, --dress-in that of a walk)"),
        _ => error.into(),
    })
}

/// Says what was found, a line each.
pub fn tell(fit: &Fit) {
    for (finding, sentence) in fit.findings.iter().zip(sentences(fit)) {
        eprintln!("{}: {sentence}", if finding.is_warning() { "warning" } else { "note" });
    }
}

/// What was found, in sentences.
pub fn sentences(fit: &Fit) -> Vec<String> {
    fit.findings.iter().map(sentence).collect()
}

fn sentence(finding: &Finding) -> String {
    match finding {
        Finding::TurnedUpright { .. } => format!("{finding} (--up overrules it)"),
        Finding::TurnedAbout { .. } => format!("{finding} (--facing overrules it)"),
        Finding::Size { .. } => format!("{finding} (--body-units)"),
        _ => finding.to_string(),
    }
}

/// Tells what is unusual about the files.
pub fn tell_of_files(warnings: &[String]) {
    for warning in warnings {
        eprintln!("warning: {warning}");
    }
}
