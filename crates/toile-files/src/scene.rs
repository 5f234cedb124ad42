//! Scenes from TOML.

pub(crate) mod fabric;
mod problem;
mod scene_body;
mod scene_toml;
mod toml_text;
mod value;

use crate::error::{FileError, Found, Place};
use crate::garment::read_garment;
use crate::scene::problem::Problem;
use crate::scene::scene_toml::{
    CornerToml, FabricToml, FrictionToml, MapsToml, PinToml, PolishToml, RuleToml, SceneToml, SheetToml, WindToml,
};
use crate::scene::value::{SIZES, vector, within, wrong};
use crate::source;
use glam::DVec2;
use std::ops::RangeInclusive;
use std::path::Path;
use toile_scene::{
    Body, Cloth, Fabric, Friction, MapKind, Pin, Polish, Rule, Scene, Settings, Sheet, VelocityModification, Wind,
};

/// Frames of a scene that does not say: two seconds at 60 per second.
const FRAMES: u32 = 120;

/// What is a part of a whole.
const PARTS: RangeInclusive<f64> = 0.0..=1.0;

/// A scene as it was read.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SceneFile {
    /// The scene.
    pub scene: Scene,
    /// Number of frames that it runs.
    pub frames: u32,
    /// What is unusual about its bodies and garments, each with its file; see
    /// [`BodyFile::warnings`](crate::BodyFile::warnings) and [`GarmentFile::warnings`](crate::GarmentFile::warnings).
    pub warnings: Vec<String>,
}

/// Reads a scene. Files that it names lie relative to it.
///
/// Each override sets one key: `("n", "128")`, `("fabric.threshold", "0.01")`, `("sphere.0.radius", "0.3")`. Its value is
/// TOML, or a name without quotes.
///
/// # Errors
///
/// [`FileError`] with line or key when the scene or a file that it names cannot be read, is not valid, or has an unknown key
/// (the known ones are listed) or an impossible value.
pub fn read_scene(path: &Path, overrides: &[(String, String)]) -> Result<SceneFile, FileError> {
    let text = source::read_text(path)?;
    let toml: SceneToml = toml_text::override_keys(&text, overrides).map_err(|found| found.in_file(path))?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let folder = path.parent().unwrap_or(Path::new(""));
    convert(toml, &stem, folder).map_err(|problem| problem.in_file(path))
}

fn convert(toml: SceneToml, stem: &str, folder: &Path) -> Result<SceneFile, Problem> {
    let settings = settings(&toml, folder)?;
    let mut cloths = Vec::new();
    let fabric = |fabric: &Option<FabricToml>, key: String| {
        fabric.clone().map(|fabric| fabric::convert(fabric, &key, folder)).transpose()
    };
    for (index, sheet) in toml.sheet.iter().enumerate() {
        let fabric = fabric(&sheet.fabric, format!("sheet.{index}.fabric"))?;
        let mut sheet = convert_sheet(index, sheet, toml.n)?;
        sheet.fabric = fabric;
        cloths.push(Cloth::Sheet(sheet));
    }
    let mut warnings = Vec::new();
    for (index, toml) in toml.garment.iter().enumerate() {
        let fabric = fabric(&toml.fabric, format!("garment.{index}.fabric"))?;
        let read = read_garment(&folder.join(&toml.file))?;
        warnings.extend(read.warnings.iter().map(|warning| format!("{}: {warning}", toml.file)));
        let mut garment = read.garment;
        garment.fabric = fabric;
        cloths.push(Cloth::Garment(garment));
    }
    if cloths.is_empty() {
        let message = "the scene has no cloth: give a [[sheet]] or a [[garment]]";
        return Err(Found::malformed(Place::File, message).into());
    }
    let mut bodies = Vec::new();
    for (index, body) in toml.body.iter().enumerate() {
        let (body, new_warnings) = scene_body::convert_body(index, body, folder)?;
        bodies.push(body);
        warnings.extend(new_warnings);
    }
    bodies.extend(scene_body::convert_shapes(&toml)?.into_iter().map(Body::Shape));
    let frames = toml.frames.unwrap_or(FRAMES);
    if frames == 0 {
        return Err(wrong("frames", "it must be at least 1").into());
    }
    let name = toml.name.unwrap_or_else(|| stem.into());
    let mut scene = Scene::new(name, settings);
    scene.cloths = cloths;
    scene.bodies = bodies;
    Ok(SceneFile { scene, frames, warnings })
}

fn settings(toml: &SceneToml, folder: &Path) -> Result<Settings, Problem> {
    let fabric = match &toml.fabric {
        Some(fabric) => fabric::convert(fabric.clone(), "fabric", folder)?,
        None => Fabric::preset("cotton").expect("cotton is a preset"),
    };
    let mut settings = Settings::new(fabric);
    let rule = toml.rule.map_or(settings.velocity_modification.rule, |rule| match rule {
        RuleToml::None => Rule::None,
        RuleToml::Zero => Rule::Zero,
        RuleToml::Average => Rule::Average,
        RuleToml::Directional => Rule::Directional,
        RuleToml::Position => Rule::Position,
        RuleToml::Predictive => Rule::Predictive,
        RuleToml::Hierarchical => Rule::Hierarchical,
    });
    let sweeps = toml.sweeps.map(|sweeps| within("sweeps", sweeps, VelocityModification::SWEEPS, "")).transpose()?;
    let polish = toml.polish.map(|polish| convert_polish(polish, rule)).transpose()?;
    let friction = match toml.friction {
        None => settings.friction,
        Some(FrictionToml::Coulomb) => Friction::Coulomb,
        Some(FrictionToml::Papers(papers)) => Friction::Papers {
            velocity_kept: within("friction.papers.velocity_kept", papers.velocity_kept, PARTS, "")?,
            force_removed: within("friction.papers.force_removed", papers.force_removed, PARTS, "")?,
        },
    };
    settings.velocity_modification.rule = rule;
    settings.velocity_modification.sweeps = sweeps;
    settings.velocity_modification.polish = polish;
    settings.friction = friction;
    settings.reflection = within("reflection", toml.reflection.unwrap_or(settings.reflection), PARTS, "")?;
    settings.gravity = vector("gravity", toml.gravity.unwrap_or(settings.gravity.to_array()))?;
    settings.wind = toml.wind.as_ref().map(convert_wind).transpose()?;
    settings.spacing = within("spacing", toml.spacing.unwrap_or(settings.spacing), Settings::SPACINGS, "m")?;
    settings.maps = match toml.maps {
        None => settings.maps,
        Some(MapsToml::Layers) => MapKind::Layers,
        Some(MapsToml::Sides) => MapKind::Sides,
    };
    settings.texel = within("texel", toml.texel.unwrap_or(settings.texel), Settings::TEXELS, "m")?;
    let frame_rate = toml.frame_rate.unwrap_or(settings.frame_rate);
    settings.frame_rate = within("frame_rate", frame_rate, Settings::FRAME_RATES, "frames per second")?;
    settings.safety = within("safety", toml.safety.unwrap_or(settings.safety), Settings::SAFETIES, "")?;
    settings.swept = toml.swept.unwrap_or(settings.swept);
    Ok(settings)
}

fn convert_polish(toml: PolishToml, rule: Rule) -> Result<Polish, Found> {
    let PolishToml { target, sweeps } = toml;
    if !matches!(rule, Rule::Predictive | Rule::Hierarchical) {
        return Err(wrong("polish", "it needs rule = \"hierarchical\" or \"predictive\""));
    }
    Ok(Polish {
        target: within("polish.target", target, Polish::TARGETS, "")?,
        sweeps: within("polish.sweeps", sweeps, Polish::SWEEPS, "")?,
    })
}

fn convert_wind(toml: &WindToml) -> Result<Wind, Found> {
    let mut wind = Wind::new(vector("wind.velocity", toml.velocity)?);
    for component in toml.velocity {
        within("wind.velocity", component, Wind::VELOCITIES, "m/s")?;
    }
    for (name, value) in &toml.numbers {
        let Some(number) = Wind::NUMBERS.iter().find(|number| number.name == name) else {
            let known: Vec<String> = Wind::NUMBERS.iter().map(|number| format!(", `{}`", number.name)).collect();
            return Err(wrong("wind", format!("unknown field `{name}`, expected one of `velocity`{}", known.concat())));
        };
        *(number.of)(&mut wind) = within(&format!("wind.{name}"), *value, number.range.clone(), number.unit)?;
    }
    Ok(wind)
}

fn convert_sheet(index: usize, toml: &SheetToml, n: Option<u32>) -> Result<Sheet, Found> {
    let key = |name: &str| format!("sheet.{index}.{name}");
    let count = |name: &str, own: Option<u32>| match own.or(n) {
        // A sheet of two rows may be as long as the particles of a square one reach.
        Some(count) => {
            let name = if own.is_some() { key(name) } else { "n".into() };
            within(&name, count, 2..=Settings::PARTICLE_COUNT_MAX / 2, "")
        }
        None => Err(wrong(&key(name), "it is missing; give it, or n for all sheets")),
    };
    let (columns, rows) = (count("columns", toml.columns)?, count("rows", toml.rows)?);
    if columns > Settings::PARTICLE_COUNT_MAX / rows {
        let sheet = format!("sheet.{index}");
        let message = format!("{columns} × {rows} particles are more than {}", Settings::PARTICLE_COUNT_MAX);
        return Err(wrong(if toml.columns.or(toml.rows).is_some() { &sheet } else { "n" }, message));
    }
    let side = |length| within(&key("size"), length, SIZES, "m");
    let size = DVec2::new(side(toml.size[0])?, side(toml.size[1])?);
    let direction = |name: &str, value| {
        vector(&key(name), value)?.try_normalize().ok_or_else(|| wrong(&key(name), "it must be a direction"))
    };
    let right = direction("right", toml.right)?;
    let down = direction("down", toml.down)?;
    if right.dot(down).abs() > 1e-6 {
        return Err(wrong(&key("down"), "it must be perpendicular to right"));
    }
    let pin = |(number, pin): (usize, &PinToml)| {
        let [column, row] = match pin {
            PinToml::At(at) => *at,
            PinToml::Corner(CornerToml::TopLeft) => [0, 0],
            PinToml::Corner(CornerToml::TopRight) => [columns - 1, 0],
            PinToml::Corner(CornerToml::BottomLeft) => [0, rows - 1],
            PinToml::Corner(CornerToml::BottomRight) => [columns - 1, rows - 1],
        };
        if column < columns && row < rows {
            return Ok(Pin { column, row });
        }
        let message = format!("[{column}, {row}] is outside of the sheet of {columns} × {rows}");
        Err(wrong(&key(&format!("pins.{number}")), message))
    };
    let mut sheet = Sheet::new(toml.name.as_deref().unwrap_or("sheet"), [columns, rows], size);
    sheet.corner = vector(&key("corner"), toml.corner)?;
    sheet.right = right;
    sheet.down = down;
    sheet.pins = toml.pins.iter().enumerate().map(pin).collect::<Result<_, _>>()?;
    Ok(sheet)
}
