//! What the user types.

mod garments;
mod place;
mod report;

pub use garments::Garments;
pub use place::{Backend, Place};
pub use report::ReportOf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use glam::DVec3;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use toile::model::Axis;
use toile::scene::{Polish, Settings, Wind};

/// What a script hears.
const EXIT_CODES: &str = "\
Exit codes:
  0    done, and every garment is on; one that is too tight but at rest is a warning
  2    a bad option, a bad file, or a run that failed: one sentence says why, and nothing is written
  3    done and written, but a garment is not on: fallen off, caught, moving, with an empty opening or an open seam
  130  interrupted";

/// The shortest ways to a result.
const EXAMPLES: &str = "\
Examples:
  toile dress
  toile dress --body scan.ply --body-units mm --garment skirt.json --garment shirt.json --fabric wool
  toile walk --body person.glb --clip walk --garment skirt.json --seconds 4 --out walking
  toile run hang.toml --set n=128
  toile adapters";

const DRESS_EXAMPLES: &str = "\
Examples:
  toile dress
  toile dress --body scan.ply --body-units mm --garment skirt.json --garment shirt.json --fabric wool --spacing 8mm
  toile dress --garment skirt.json --fabric wool --garment shirt.json --fabric silk";

const WALK_EXAMPLES: &str = "\
Examples:
  toile walk --motion pirouette
  toile walk --body person.glb --clip walk --garment skirt.json --garment shirt.json --seconds 4 --fps 30 --out walking";

const RUN_EXAMPLES: &str = "\
Examples:
  toile run hang.toml
  toile run hang.toml --set n=128 --set fabric=silk --set fabric.threshold=0.01";

const RULES_EXAMPLES: &str = "\
Examples:
  toile rules moving-ball.toml --set n=32";

const PLAN_EXAMPLES: &str = "\
Examples:
  toile plan ball.toml --set n=64
  toile plan --garment skirt.json --picture limits.svg";

/// Cloth simulation on the GPU: sews garments around bodies, drapes them, and says how well.
#[derive(Debug, Parser)]
#[command(name = "toile", version, after_help = format!("{EXAMPLES}\n\n{EXIT_CODES}"))]
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
    /// Dress a body in the first pose of a clip and walk; without arguments, the built-in dress on the built-in body.
    Walk(Walk),
    /// Run a scene file.
    Run(Run),
    /// Run a scene of one sheet under every rule of the velocity modification: one picture, side by side.
    Rules(Rules),
    /// Print the passes that a scene gets, with dispatches per step and bytes.
    Plan(PlanOf),
    /// Measure speed against error in every way there is and write the report: about a quarter of an hour, or three minutes with --quick.
    Report(ReportOf),
    /// List the adapters that wgpu finds.
    Adapters(Adapters),
}

/// What is worn, and how it is simulated.
#[derive(Args, Clone, Debug)]
pub struct Outfit {
    /// Body mesh: OBJ, PLY, glTF or GLB.
    #[arg(long, value_name = "FILE")]
    pub body: Option<PathBuf>,
    /// Unit of the body file.
    #[arg(long, value_enum, default_value_t = Unit::M, requires = "body")]
    pub body_units: Unit,
    /// Axis of the body file that is up: x, y, z, -x, -y or -z; without it, found where the body is a person who stands, else y.
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, requires = "body")]
    pub up: Option<Axis>,
    /// Axis that the body faces once it stands upright: x, z, -x or -z; without it, found where feet and trunk tell, else z.
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, requires = "body", value_parser = parse_facing)]
    pub facing: Option<Axis>,
    /// Clip of an animated body file.
    #[arg(long, value_name = "NAME")]
    pub clip: Option<String>,
    /// Time in the clip [s].
    #[arg(long, value_name = "SECONDS", default_value = "0", requires = "clip", value_parser = parse_time, allow_hyphen_values = true)]
    pub time: f64,
    /// What is worn, and of what it is made.
    #[command(flatten)]
    pub garments: Garments,
    /// Distance of neighbouring particles.
    #[arg(long, value_name = "LENGTH", default_value = "1cm", value_parser = parse_spacing, allow_hyphen_values = true)]
    pub spacing: f64,
    /// Edge length of a map texel.
    #[arg(long, value_name = "LENGTH", default_value = "0.5cm", value_parser = parse_texel, allow_hyphen_values = true)]
    pub texel: f64,
    /// Further sweeps in steps that leave an elongation above TARGET, at most SWEEPS in a step; not while sewing.
    #[arg(long, value_name = "TARGET,SWEEPS", value_parser = parse_polish, allow_hyphen_values = true)]
    pub polish: Option<Polish>,
}

/// Where the results go, and what is said of the run.
#[derive(Args, Debug)]
pub struct Running {
    /// Folder for the results.
    #[arg(long, value_name = "DIR", default_value = "out")]
    pub out: PathBuf,
    /// Print nothing but errors.
    #[arg(long)]
    pub quiet: bool,
    /// Print the metrics as JSON, and nothing else.
    #[arg(long)]
    pub json: bool,
    /// Where it runs.
    #[command(flatten)]
    pub place: Place,
}

impl Running {
    /// Whether nothing is said of how far it is.
    pub fn hides_progress(&self) -> bool {
        self.quiet || self.json
    }
}

/// `toile dress`.
#[derive(Args, Debug)]
#[command(after_help = DRESS_EXAMPLES)]
pub struct Dress {
    /// What is worn.
    #[command(flatten)]
    pub outfit: Outfit,
    /// Where the results go, and what is said of the run.
    #[command(flatten)]
    pub running: Running,
}

/// `toile walk`.
#[derive(Args, Debug)]
#[command(after_help = WALK_EXAMPLES)]
pub struct Walk {
    /// What is worn; the body is an animated glTF or GLB.
    #[command(flatten)]
    pub outfit: Outfit,
    /// A motion that is made for the built-in body, in place of a clip.
    #[arg(long, value_enum, conflicts_with_all = ["body", "clip"])]
    pub motion: Option<MotionName>,
    /// Length of the walk [s]; without it, that of the clip.
    #[arg(long, value_name = "SECONDS", value_parser = parse_time, allow_hyphen_values = true)]
    pub seconds: Option<f64>,
    /// Frames per second.
    #[arg(long, value_name = "RATE", default_value = "30", value_parser = parse_rate, allow_hyphen_values = true)]
    pub fps: f64,
    /// Dress in the first pose of this clip, and go over to that of --clip in a second: for clips that begin with arms at the body.
    #[arg(long, value_name = "CLIP")]
    pub dress_in: Option<String>,
    /// Velocity of the air [m/s]; without it there is no air. Garments are dressed without it.
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_velocity, allow_hyphen_values = true)]
    pub wind: Option<DVec3>,
    /// Height of the pictures in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 480, value_parser = clap::value_parser!(u32).range(40..=2160), allow_hyphen_values = true)]
    pub height: u32,
    /// From where the pictures look; repeat it for several side by side.
    #[arg(long, value_enum, default_values_t = [ViewName::ThreeQuarter, ViewName::Side])]
    pub view: Vec<ViewName>,
    /// Draw the maps of a clip that repeats once, and keep them: faster frames for more memory.
    #[arg(long)]
    pub precompute_maps: bool,
    /// Go on with an interrupted walk in the same folder, with the same options.
    #[arg(long)]
    pub resume: bool,
    /// Where the results go, and what is said of the run.
    #[command(flatten)]
    pub running: Running,
}

/// `toile run`.
#[derive(Args, Debug)]
#[command(after_help = RUN_EXAMPLES)]
pub struct Run {
    /// Scene file.
    pub scene: PathBuf,
    /// Change a key of the scene, for example n=128 or fabric.threshold=0.01.
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_setting)]
    pub set: Vec<(String, String)>,
    /// Where the results go, and what is said of the run.
    #[command(flatten)]
    pub running: Running,
}

/// `toile rules`.
#[derive(Args, Debug)]
#[command(after_help = RULES_EXAMPLES)]
pub struct Rules {
    /// Scene file.
    pub scene: PathBuf,
    /// Change a key of the scene, for example n=128.
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_setting)]
    pub set: Vec<(String, String)>,
    /// Where the results go, and what is said of the run.
    #[command(flatten)]
    pub running: Running,
}

/// `toile plan`.
#[derive(Args, Debug)]
#[command(after_help = PLAN_EXAMPLES)]
pub struct PlanOf {
    /// Scene file; without it, the outfit given by the options.
    #[arg(conflicts_with_all = OUTFIT_OPTIONS)]
    pub scene: Option<PathBuf>,
    /// Change a key of the scene.
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse_setting, requires = "scene")]
    pub set: Vec<(String, String)>,
    /// What is worn.
    #[command(flatten)]
    pub outfit: Outfit,
    /// Draw the flat panels with the limits of every level and the seams.
    #[arg(long, value_name = "FILE.svg", value_parser = parse_svg)]
    pub picture: Option<PathBuf>,
    /// Print it as JSON, and nothing else.
    #[arg(long)]
    pub json: bool,
}

/// Names of the options of [`Outfit`], which say nothing about a scene file.
const OUTFIT_OPTIONS: [&str; 11] =
    ["body", "body_units", "up", "facing", "clip", "time", "garment", "spacing", "texel", "fabric", "polish"];

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

/// A motion that is made for the built-in body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MotionName {
    /// Walks on, turns left by 90° and walks on.
    Corner,
    /// Walks on the spot and turns.
    Turning,
    /// Folds her arms and lets them down.
    ArmsFolded,
    /// Sits down and stands up.
    Sitting,
    /// Turns once a second.
    Pirouette,
}

/// From where a picture looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ViewName {
    /// From +z.
    Front,
    /// From −z.
    Back,
    /// From +x.
    Side,
    /// From between front and side.
    ThreeQuarter,
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

fn parse_spacing(text: &str) -> Result<f64, String> {
    parse_length(text, Settings::SPACINGS)
}

fn parse_texel(text: &str) -> Result<f64, String> {
    parse_length(text, Settings::TEXELS)
}

fn parse_facing(text: &str) -> Result<Axis, String> {
    let facing: Axis = text.parse()?;
    if facing.is_parallel_to(Axis::Y) { Err("it must be x, z, -x or -z".to_owned()) } else { Ok(facing) }
}

fn parse_velocity(text: &str) -> Result<DVec3, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, z]) if [x, y, z].iter().all(|v| Wind::VELOCITIES.contains(v)) => Ok(DVec3::new(x, y, z)),
        _ => Err(format!("it must be three numbers of at most {} m/s, as 0,0,-3", Wind::VELOCITIES.end())),
    }
}

/// A length such as 1cm, 5mm or 0.01m, in metres.
fn parse_length(text: &str, allowed: RangeInclusive<f64>) -> Result<f64, String> {
    let split = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (number, unit) = text.split_at(split);
    let unit = if unit.is_empty() { Ok(Unit::M) } else { Unit::from_str(unit, true) };
    match (number.trim().parse::<f64>(), unit) {
        (Ok(value), Ok(unit)) if allowed.contains(&(value * unit.metres())) => Ok(value * unit.metres()),
        (Ok(_), Ok(_)) => Err(format!("it must be {} mm to {} mm", 1e3 * allowed.start(), 1e3 * allowed.end())),
        _ => Err("it is not a length; write 1cm, 5mm or 0.01m".to_owned()),
    }
}

fn parse_time(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value >= 0.0 => Ok(value),
        _ => Err("it is not a time; write seconds, such as 0.5".to_owned()),
    }
}

fn parse_rate(text: &str) -> Result<f64, String> {
    let rates = Settings::FRAME_RATES;
    match text.parse::<f64>() {
        Ok(value) if rates.contains(&value) => Ok(value),
        _ => Err(format!("it must be {} to {} frames per second", rates.start(), rates.end())),
    }
}

fn parse_polish(text: &str) -> Result<Polish, String> {
    let (targets, bounds) = (Polish::TARGETS, Polish::SWEEPS);
    let parts = text.split_once(',').map(|(target, sweeps)| (target.trim().parse(), sweeps.trim().parse()));
    match parts {
        Some((Ok(target), Ok(sweeps))) if targets.contains(&target) && bounds.contains(&sweeps) => {
            Ok(Polish { target, sweeps })
        }
        _ => Err(format!(
            "it must be an elongation of {} to {} and {} to {} sweeps, as 0.05,8",
            targets.start(),
            targets.end(),
            bounds.start(),
            bounds.end()
        )),
    }
}

fn parse_svg(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("svg") => Ok(path),
        _ => Err("the picture is an SVG: end the name with .svg".to_owned()),
    }
}

fn parse_setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err("it is not KEY=VALUE".to_owned()),
    }
}

/// What is wrong with the options, as one sentence; `None` for what is no error, such as a call for help.
pub fn sentence(error: &clap::Error) -> Option<String> {
    use clap::error::ErrorKind;
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            None
        }
        _ => {
            let text = error.to_string();
            let paragraphs = text.split("\n\n").map(|part| part.split_whitespace().collect::<Vec<_>>().join(" "));
            let told: Vec<String> = paragraphs
                .filter(|part| !part.is_empty() && !part.starts_with("Usage:") && !part.starts_with("For more"))
                .map(|part| part.trim_start_matches("error: ").to_owned())
                .collect();
            Some(told.join("; "))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_units_and_bounds() {
        assert_eq!(parse_spacing("1cm"), Ok(0.01));
        assert_eq!(parse_spacing("5 mm"), Ok(0.005));
        assert_eq!(parse_spacing("0.02"), Ok(0.02));
        assert_eq!(parse_texel("0.5mm"), Ok(0.0005));
        for wrong in ["-1cm", "0", "cm", "1 parsec", "nanm", "inf", "10m", "0.01mm", ""] {
            assert!(parse_spacing(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_time_is_finite_and_not_negative() {
        assert_eq!(parse_time("0.5"), Ok(0.5));
        for wrong in ["-1", "nan", "inf", "soon"] {
            assert!(parse_time(wrong).is_err(), "{wrong}");
        }
        assert_eq!(parse_velocity("0, -1.5,3"), Ok(DVec3::new(0.0, -1.5, 3.0)));
        for wrong in ["1,2", "1,2,3,4", "0,nan,0", "0,0,200", "north"] {
            assert!(parse_velocity(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_polish_has_a_target_and_a_bound() {
        assert_eq!(parse_polish("0.05, 8"), Ok(Polish { target: 0.05, sweeps: 8 }));
        for wrong in ["0.05", "0.0001,8", "nan,8", "0.05,0", "0.05,65", "0.05,8,1", "fine"] {
            assert!(parse_polish(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn wrong_options_are_one_sentence() {
        let said = |words: &[&str]| {
            let error = Arguments::try_parse_from(words).expect_err("wrong options");
            sentence(&error).expect("an error")
        };
        insta::assert_snapshot!(
            [
                said(&["toile", "dress", "--spacing", "0"]),
                said(&["toile", "dress", "--spacing", "10m"]),
                said(&["toile", "dress", "--spacing", "-1cm"]),
                said(&["toile", "dress", "--time", "2"]),
                said(&["toile", "walk", "--seconds", "-1"]),
                said(&["toile", "plan", "--picture", "limits.png"]),
                said(&["toile", "dress", "--texel", "big"]),
                said(&["toile", "dress", "--body-units", "cm"]),
                said(&["toile", "dress", "--backend", "cuda"]),
                said(&["toile", "dress", "--jsn"]),
                said(&["toile", "run"]),
                said(&["toile", "run", "hang.toml", "--set", "n"]),
                said(&["toile", "plan", "--set", "n=3"]),
                said(&["toile", "plan", "hang.toml", "--fabric", "silk"]),
                said(&["toile", "sew"]),
            ]
            .join("\n"),
            @"
        invalid value '0' for '--spacing <LENGTH>': it must be 1 mm to 100 mm
        invalid value '10m' for '--spacing <LENGTH>': it must be 1 mm to 100 mm
        invalid value '-1cm' for '--spacing <LENGTH>': it must be 1 mm to 100 mm
        the following required arguments were not provided: --clip <NAME>
        invalid value '-1' for '--seconds <SECONDS>': it is not a time; write seconds, such as 0.5
        invalid value 'limits.png' for '--picture <FILE.svg>': the picture is an SVG: end the name with .svg
        invalid value 'big' for '--texel <LENGTH>': it is not a length; write 1cm, 5mm or 0.01m
        the following required arguments were not provided: --body <FILE>
        invalid value 'cuda' for '--backend <BACKEND>' [possible values: gpu, reference]
        unexpected argument '--jsn' found; tip: a similar argument exists: '--json'
        the following required arguments were not provided: <SCENE>
        invalid value 'n' for '--set <KEY=VALUE>': it is not KEY=VALUE
        the following required arguments were not provided: <SCENE>
        the argument '[SCENE]' cannot be used with '--fabric <NAME|FILE>'
        unrecognized subcommand 'sew'
        "
        );
    }

    #[test]
    fn the_arguments_are_consistent() {
        <Arguments as clap::CommandFactory>::command().debug_assert();
    }
}
