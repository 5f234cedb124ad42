//! Fabrics from TOML.

use crate::error::{Fault, FileError, Found, Place};
use crate::scene::problem::Problem;
use crate::scene::scene_toml::{FabricTable, FabricToml, ThresholdTable, ThresholdToml};
use crate::scene::toml_text;
use crate::scene::value::{within, wrong};
use crate::source;
use std::path::Path;
use toile_scene::{Fabric, Threshold};

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

/// The fabric of a scene, or of a cloth in it, under its key; files lie relative to the folder.
pub(crate) fn convert(toml: FabricToml, key: &str, folder: &Path) -> Result<Fabric, Problem> {
    match toml {
        FabricToml::Named(name) => named(&name, key, folder, DEEPEST_BASE),
        FabricToml::Table(value) => {
            let table = value.try_into::<FabricTable>().map_err(|error| wrong(key, error.message()))?;
            fill(table, folder, "fabric", &format!("{key}."), DEEPEST_BASE)
        }
    }
}

/// The fabric that the key names.
fn named(name: &str, key: &str, folder: &Path, depth: usize) -> Result<Fabric, Problem> {
    if let Some(fabric) = Fabric::preset(name) {
        return Ok(fabric);
    }
    if !name.ends_with(".toml") {
        let known = Fabric::PRESETS.map(String::from).to_vec();
        let fault = Fault::Unknown { what: "fabric", name: name.into(), known };
        return Err(Found::at(Place::Key(key.into()), fault).into());
    }
    if depth == 0 {
        let message = format!("the base \"{name}\" leads in a circle");
        return Err(wrong(key, message).into());
    }
    Ok(read_file(&folder.join(name), depth - 1)?)
}

/// `name` is the fabric's if the table gives none; `prefix` stands before the keys in errors.
fn fill(table: FabricTable, folder: &Path, name: &str, prefix: &str, depth: usize) -> Result<Fabric, Problem> {
    let base = table.base.as_deref().map(|base| named(base, &format!("{prefix}base"), folder, depth)).transpose()?;
    let base = base.as_ref();
    let given = |name: &str, own: Option<f64>| {
        let number = Fabric::NUMBERS.iter().find(|number| number.name == name).expect("a number of a fabric");
        let key = format!("{prefix}{name}");
        match own.or(base.map(|base| number.value(base))) {
            Some(value) => within(&key, value, number.range.clone(), number.unit),
            None => Err(wrong(&key, "it is missing; give it, or a base such as \"cotton\"")),
        }
    };
    let inherited_name = base.map_or(name, |base| base.name.as_str());
    // Without a base, and without a word on it, bending is left to the bend springs.
    let bending_rigidity = table.bending_rigidity.or(base.is_none().then_some(0.0));
    // Without a base all that cotton has is set anew.
    let mut fabric = base.cloned().unwrap_or_else(|| Fabric::preset("cotton").expect("cotton is a preset"));
    fabric.name = table.name.unwrap_or_else(|| inherited_name.into());
    fabric.areal_density = given("areal_density", table.areal_density)?;
    fabric.structural_stiffness = given("structural_stiffness", table.structural_stiffness)?;
    fabric.shear_stiffness = given("shear_stiffness", table.shear_stiffness)?;
    fabric.bend_stiffness = given("bend_stiffness", table.bend_stiffness)?;
    fabric.bending_rigidity = given("bending_rigidity", bending_rigidity)?;
    fabric.damping = given("damping", table.damping)?;
    fabric.thickness = given("thickness", table.thickness)?;
    fabric.friction = given("friction", table.friction)?;
    fabric.threshold = threshold(table.threshold, base.map(|f| f.threshold), &format!("{prefix}threshold"))?;
    Ok(fabric)
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
        if Fabric::THRESHOLDS.contains(&value) {
            return Ok(value);
        }
        let [least, most] = [Fabric::THRESHOLDS.start(), Fabric::THRESHOLDS.end()];
        let message = format!("that of the {direction} is {value} and must be from {least} to {most}: 0.1 % to 15 %");
        Err(Found::malformed(Place::Key(key.into()), message))
    };
    Ok(Threshold {
        warp: given("warp", table.warp, base.map(|b| b.warp))?,
        weft: given("weft", table.weft, base.map(|b| b.weft))?,
        shear: given("shear", table.shear, base.map(|b| b.shear))?,
    })
}
