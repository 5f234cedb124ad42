//! Fabrics from TOML.

use crate::error::{Fault, FileError, Found, Place};
use crate::scene_toml::{FabricTable, FabricToml, ThresholdTable, ThresholdToml};
use crate::{source, toml_text};
use std::ops::RangeInclusive;
use std::path::Path;
use toile_scene::{Fabric, Threshold};

/// Smallest and largest threshold of a fabric [1]. D §4.3 has 1 % to 15 %.
const THRESHOLD_RANGE: RangeInclusive<f64> = 0.001..=0.15;

/// How many files may name each other as base before it is a circle.
const DEEPEST_BASE: usize = 8;

/// Reads a fabric from TOML. `base = "cotton"` (or another file) gives what the file leaves out.
///
/// # Errors
///
/// [`FileError`] with the key when the file cannot be read, is not valid TOML, has an unknown key, lacks a value and a
/// base, or has a value that no cloth has.
pub fn read_fabric(path: &Path) -> Result<Fabric, FileError> {
    read_file(path, DEEPEST_BASE)
}

fn read_file(path: &Path, depth: usize) -> Result<Fabric, FileError> {
    let text = source::read_text(path)?;
    let table: FabricTable = toml_text::parse(&text).map_err(|found| found.in_file(path))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    fill(table, folder, &stem, "", depth).map_err(|problem| problem.in_file(path))
}

/// A fault in the file at hand, or in another one that it names.
pub(crate) enum Problem {
    Here(Found),
    There(FileError),
}

impl Problem {
    pub fn in_file(self, path: &Path) -> FileError {
        match self {
            Self::Here(found) => found.in_file(path),
            Self::There(error) => error,
        }
    }
}

impl From<Found> for Problem {
    fn from(found: Found) -> Self {
        Self::Here(found)
    }
}

impl From<FileError> for Problem {
    fn from(error: FileError) -> Self {
        Self::There(error)
    }
}

/// The fabric of a scene; files lie relative to the folder.
pub(crate) fn convert(toml: FabricToml, folder: &Path) -> Result<Fabric, Problem> {
    match toml {
        FabricToml::Named(name) => named(&name, folder, DEEPEST_BASE),
        FabricToml::Table(value) => {
            let table = value
                .try_into::<FabricTable>()
                .map_err(|error| Found::malformed(Place::Key("fabric".into()), error.message().to_string()))?;
            fill(table, folder, "fabric", "fabric.", DEEPEST_BASE)
        }
    }
}

fn named(name: &str, folder: &Path, depth: usize) -> Result<Fabric, Problem> {
    if let Some(fabric) = Fabric::preset(name) {
        return Ok(fabric);
    }
    if !name.ends_with(".toml") {
        let known = Fabric::PRESETS.map(String::from).to_vec();
        let fault = Fault::Unknown { what: "fabric", name: name.into(), known };
        return Err(Found::at(Place::Key("fabric".into()), fault).into());
    }
    if depth == 0 {
        let message = format!("the base \"{name}\" leads in a circle");
        return Err(Found::malformed(Place::Key("base".into()), message).into());
    }
    Ok(read_file(&folder.join(name), depth - 1)?)
}

/// `name` is the fabric's if the table gives none; `prefix` stands before the keys in errors.
fn fill(table: FabricTable, folder: &Path, name: &str, prefix: &str, depth: usize) -> Result<Fabric, Problem> {
    let base = table.base.as_deref().map(|base| named(base, folder, depth)).transpose()?;
    let base = base.as_ref();
    let given = |key: &str, own: Option<f64>, inherited: fn(&Fabric) -> f64, zero_allowed: bool| {
        let place = || Place::Key(format!("{prefix}{key}"));
        let Some(value) = own.or(base.map(inherited)) else {
            return Err(Found::malformed(place(), "it is missing; give it, or a base such as \"cotton\""));
        };
        if value.is_finite() && (value > 0.0 || (zero_allowed && value == 0.0)) {
            return Ok(value);
        }
        let least = if zero_allowed { "0 or more" } else { "above 0" };
        Err(Found::malformed(place(), format!("it is {value} and must be {least}")))
    };
    let inherited_name = base.map_or(name, |base| base.name.as_str());
    // Without a base, and without a word on it, bending is left to the bend springs.
    let bending_rigidity = table.bending_rigidity.or(base.is_none().then_some(0.0));
    Ok(Fabric {
        name: table.name.unwrap_or_else(|| inherited_name.into()),
        areal_density: given("areal_density", table.areal_density, |f| f.areal_density, false)?,
        structural_stiffness: given(
            "structural_stiffness",
            table.structural_stiffness,
            |f| f.structural_stiffness,
            false,
        )?,
        shear_stiffness: given("shear_stiffness", table.shear_stiffness, |f| f.shear_stiffness, true)?,
        bend_stiffness: given("bend_stiffness", table.bend_stiffness, |f| f.bend_stiffness, true)?,
        bending_rigidity: given("bending_rigidity", bending_rigidity, |f| f.bending_rigidity, true)?,
        damping: given("damping", table.damping, |f| f.damping, true)?,
        thickness: given("thickness", table.thickness, |f| f.thickness, true)?,
        friction: given("friction", table.friction, |f| f.friction, true)?,
        threshold: threshold(table.threshold, base.map(|f| f.threshold), &format!("{prefix}threshold"))?,
    })
}

/// The threshold of a fabric; a direction that the table leaves out is that of the base.
fn threshold(toml: Option<ThresholdToml>, base: Option<Threshold>, key: &str) -> Result<Threshold, Found> {
    let table = match toml {
        Some(ThresholdToml::Even(even)) => ThresholdTable { warp: Some(even), weft: Some(even), shear: Some(even) },
        Some(ThresholdToml::Directions(table)) => table,
        None => ThresholdTable { warp: None, weft: None, shear: None },
    };
    let given = |direction: &str, own: Option<f64>, inherited: Option<f64>| {
        let value = own.or(inherited).ok_or_else(|| {
            let message = format!("that of the {direction} is missing; give it, or a base such as \"cotton\"");
            Found::malformed(Place::Key(key.into()), message)
        })?;
        if THRESHOLD_RANGE.contains(&value) {
            return Ok(value);
        }
        let [least, most] = [THRESHOLD_RANGE.start(), THRESHOLD_RANGE.end()];
        let message = format!("that of the {direction} is {value} and must be from {least} to {most}: 0.1 % to 15 %");
        Err(Found::malformed(Place::Key(key.into()), message))
    };
    Ok(Threshold {
        warp: given("warp", table.warp, base.map(|b| b.warp))?,
        weft: given("weft", table.weft, base.map(|b| b.weft))?,
        shear: given("shear", table.shear, base.map(|b| b.shear))?,
    })
}
