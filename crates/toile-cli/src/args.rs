//! What the user types.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

/// Cloth simulation on the GPU: sews garments around bodies, drapes them, and says how well.
#[derive(Debug, Parser)]
#[command(name = "toile", version)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Sew garments around a standing body and drape them; without arguments, the built-in dress on the built-in body.
    Dress(Dress),
    /// Run a scene file.
    Run(Run),
    /// Print the passes that a scene gets, with dispatches per step and bytes.
    Plan(PlanOf),
    /// List the adapters that wgpu finds.
    Adapters(Adapters),
}

/// What is worn, and how it is simulated.
#[derive(Args, Debug)]
pub struct Outfit {
    /// Body mesh: OBJ, PLY, glTF or GLB.
    #[arg(long, value_name = "FILE")]
    pub body: Option<PathBuf>,
    /// Unit of the body file.
    #[arg(long, value_enum, default_value_t = Unit::M)]
    pub body_units: Unit,
    /// Clip of an animated body file.
    #[arg(long, value_name = "NAME")]
    pub clip: Option<String>,
    /// Time in the clip [s].
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0)]
    pub time: f64,
    /// Garment as GarmentCode JSON; repeat it to wear one over the other, inner ones first.
    #[arg(long, value_name = "FILE")]
    pub garment: Vec<PathBuf>,
    /// Distance of neighbouring particles.
    #[arg(long, value_name = "LENGTH", default_value = "1cm", value_parser = parse_length)]
    pub spacing: f64,
    /// Edge length of a map texel.
    #[arg(long, value_name = "LENGTH", default_value = "0.5cm", value_parser = parse_length)]
    pub texel: f64,
    /// Fabric: the name of a preset or a TOML file.
    #[arg(long, value_name = "NAME|FILE", default_value = "cotton")]
    pub fabric: String,
}

/// Where it runs and what is said of it.
#[derive(Args, Debug)]
pub struct Running {
    /// Folder for the results.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// No progress.
    #[arg(long)]
    pub quiet: bool,
    /// Print the metrics as JSON.
    #[arg(long)]
    pub json: bool,
    /// Where it runs.
    #[command(flatten)]
    pub place: Place,
}

/// Where it runs.
#[derive(Args, Debug)]
pub struct Place {
    /// Part of the name of the adapter to use.
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// What computes.
    #[arg(long, value_enum, default_value_t = Backend::Gpu)]
    pub backend: Backend,
}

/// `toile dress`.
#[derive(Args, Debug)]
pub struct Dress {
    /// What is worn.
    #[command(flatten)]
    pub outfit: Outfit,
    /// Where it runs.
    #[command(flatten)]
    pub running: Running,
}

/// `toile run`.
#[derive(Args, Debug)]
pub struct Run {
    /// Scene file.
    pub scene: PathBuf,
    /// Change a key of the scene, for example n=128 or fabric.threshold=0.01.
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_setting)]
    pub set: Vec<(String, String)>,
    /// Where it runs.
    #[command(flatten)]
    pub running: Running,
}

/// `toile plan`.
#[derive(Args, Debug)]
pub struct PlanOf {
    /// Scene file; without it, the outfit given by the options.
    pub scene: Option<PathBuf>,
    /// Change a key of the scene.
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_setting)]
    pub set: Vec<(String, String)>,
    /// What is worn.
    #[command(flatten)]
    pub outfit: Outfit,
    /// Where it runs.
    #[command(flatten)]
    pub place: Place,
}

/// `toile adapters`.
#[derive(Args, Debug)]
pub struct Adapters {
    /// Print them as JSON.
    #[arg(long)]
    pub json: bool,
}

/// A unit of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Unit {
    /// Metre.
    M,
    /// Decimetre.
    Dm,
    /// Centimetre.
    Cm,
    /// Millimetre.
    Mm,
    /// Inch.
    In,
}

impl Unit {
    /// Its length [m].
    pub fn metres(self) -> f64 {
        match self {
            Unit::M => 1.0,
            Unit::Dm => 0.1,
            Unit::Cm => 0.01,
            Unit::Mm => 0.001,
            Unit::In => 0.0254,
        }
    }
}

/// What computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Backend {
    /// A GPU, or a Vulkan driver that works on the CPU.
    Gpu,
    /// The CPU reference, for machines without any adapter.
    Reference,
}

/// A length such as 1cm, 5mm or 0.01m, in metres.
fn parse_length(text: &str) -> Result<f64, String> {
    let split = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    let unit = if unit.is_empty() { Unit::M } else { Unit::from_str(unit, true)? };
    match number.trim().parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value * unit.metres()),
        _ => Err(format!("{text} is not a positive length; write 1cm, 5mm or 0.01m")),
    }
}

fn parse_setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err(format!("{text} is not KEY=VALUE")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_units() {
        assert_eq!(parse_length("1cm"), Ok(0.01));
        assert_eq!(parse_length("5 mm"), Ok(0.005));
        assert_eq!(parse_length("0.02"), Ok(0.02));
        for wrong in ["-1cm", "0", "cm", "1 parsec", "nanm", "inf"] {
            assert!(parse_length(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_arguments_are_consistent() {
        <Arguments as clap::CommandFactory>::command().debug_assert();
    }
}
