//! The shape of a scene file.

use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneToml {
    pub name: Option<String>,
    /// Columns and rows of every sheet that gives none.
    pub n: Option<u32>,
    pub frames: Option<u32>,
    pub frame_rate: Option<f64>,
    pub gravity: Option<[f64; 3]>,
    pub wind: Option<WindToml>,
    pub spacing: Option<f64>,
    pub maps: Option<MapsToml>,
    pub texel: Option<f64>,
    pub safety: Option<f64>,
    pub swept: Option<bool>,
    pub reflection: Option<f64>,
    pub rule: Option<RuleToml>,
    pub sweeps: Option<u32>,
    pub polish: Option<PolishToml>,
    pub friction: Option<FrictionToml>,
    pub fabric: Option<FabricToml>,
    #[serde(default)]
    pub sheet: Vec<SheetToml>,
    #[serde(default)]
    pub garment: Vec<GarmentToml>,
    #[serde(default)]
    pub body: Vec<BodyToml>,
    #[serde(default)]
    pub sphere: Vec<SphereToml>,
    #[serde(default)]
    pub capsule: Vec<CapsuleToml>,
    #[serde(default)]
    pub plane: Vec<PlaneToml>,
    #[serde(default, rename = "box")]
    pub cuboid: Vec<BoxToml>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum MapsToml {
    Layers,
    Sides,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum RuleToml {
    None,
    Zero,
    Average,
    Directional,
    Position,
    Predictive,
    Hierarchical,
}

/// Further sweeps while an elongation is above the target.
#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PolishToml {
    pub target: f64,
    pub sweeps: u32,
}

/// `"coulomb"`, or `{ papers = { velocity_kept = …, force_removed = … } }`.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum FrictionToml {
    Coulomb,
    Papers(PapersToml),
}

#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PapersToml {
    pub velocity_kept: f64,
    pub force_removed: f64,
}

/// Air with the coefficients of a flat plate, unless it says otherwise.
#[derive(Clone, Deserialize)]
pub(crate) struct WindToml {
    pub velocity: [f64; 3],
    /// Some of [`Wind::NUMBERS`](toile_scene::Wind::NUMBERS).
    #[serde(flatten)]
    pub numbers: BTreeMap<String, f64>,
}

/// The name of a preset or of a fabric file, or a table.
#[derive(Clone, Deserialize)]
#[serde(from = "toml::Value")]
pub(crate) enum FabricToml {
    Named(String),
    Table(toml::Value),
}

impl From<toml::Value> for FabricToml {
    fn from(value: toml::Value) -> Self {
        match value {
            toml::Value::String(name) => Self::Named(name),
            table => Self::Table(table),
        }
    }
}

/// A fabric, whole or as the difference from another one.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FabricTable {
    /// Preset or file that gives what this table does not.
    pub base: Option<String>,
    pub name: Option<String>,
    pub areal_density: Option<f64>,
    pub structural_stiffness: Option<f64>,
    pub shear_stiffness: Option<f64>,
    pub bend_stiffness: Option<f64>,
    pub bending_rigidity: Option<f64>,
    pub damping: Option<f64>,
    pub thickness: Option<f64>,
    pub friction: Option<f64>,
    pub threshold: Option<ThresholdToml>,
}

/// One threshold for all directions, or those of some of them.
#[derive(Deserialize)]
#[serde(untagged, expecting = "threshold is a number, or a table of warp, weft and shear")]
pub(crate) enum ThresholdToml {
    Even(f64),
    Directions(ThresholdTable),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ThresholdTable {
    pub warp: Option<f64>,
    pub weft: Option<f64>,
    pub shear: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SheetToml {
    pub name: Option<String>,
    pub columns: Option<u32>,
    pub rows: Option<u32>,
    pub size: [f64; 2],
    pub corner: [f64; 3],
    pub right: [f64; 3],
    pub down: [f64; 3],
    #[serde(default)]
    pub pins: Vec<PinToml>,
    pub fabric: Option<FabricToml>,
}

/// A corner by name, or a particle as [column, row].
#[derive(Clone, Copy, Deserialize)]
#[serde(
    untagged,
    expecting = "a pin is [column, row], \"top_left\", \"top_right\", \"bottom_left\" or \"bottom_right\""
)]
pub(crate) enum PinToml {
    At([u32; 2]),
    Corner(CornerToml),
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum CornerToml {
    TopLeft,
    TopRight,
    BottomLeft,
    BottomRight,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GarmentToml {
    pub file: String,
    pub fabric: Option<FabricToml>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyToml {
    pub file: Option<String>,
    pub units: Option<UnitsToml>,
    pub clip: Option<String>,
    pub time: Option<f64>,
    /// Whether the body moves with the clip instead of standing at a time of it.
    pub moving: Option<bool>,
    /// Motion of the whole body.
    pub keys: Option<Vec<KeyToml>>,
    /// Folder of OBJ files instead of a file.
    pub sequence: Option<String>,
    /// Files of the sequence per second.
    pub frame_rate: Option<f64>,
}

/// Where something rigid stands at a time.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct KeyToml {
    pub time: f64,
    pub translation: Option<[f64; 3]>,
    /// Axis and angle in degrees.
    pub rotation: Option<[f64; 4]>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum UnitsToml {
    M,
    Dm,
    Cm,
    Mm,
    In,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SphereToml {
    pub centre: [f64; 3],
    pub radius: f64,
    pub swing: Option<SwingToml>,
    pub keys: Option<Vec<KeyToml>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CapsuleToml {
    /// The ends of its line.
    pub ends: [[f64; 3]; 2],
    pub radius: f64,
    pub swing: Option<SwingToml>,
    pub keys: Option<Vec<KeyToml>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlaneToml {
    pub point: [f64; 3],
    pub normal: [f64; 3],
    pub swing: Option<SwingToml>,
    pub keys: Option<Vec<KeyToml>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxToml {
    pub centre: [f64; 3],
    /// Its extents with the rounding.
    pub size: [f64; 3],
    /// That of its edges and corners.
    pub radius: Option<f64>,
    /// An axis and an angle in degrees.
    pub rotation: Option<[f64; 4]>,
    pub swing: Option<SwingToml>,
    pub keys: Option<Vec<KeyToml>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SwingToml {
    pub amplitude: [f64; 3],
    pub period: f64,
}
