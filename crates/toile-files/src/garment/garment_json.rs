//! The shape of GarmentCode's JSON; keys that say nothing about the cloth are passed over.

use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::Value;
use std::fmt;
use std::marker::PhantomData;

#[derive(Deserialize)]
#[serde(expecting = "a garment with \"pattern\" and \"properties\"")]
pub(crate) struct GarmentJson {
    pub pattern: PatternJson,
    pub properties: PropertiesJson,
}

#[derive(Deserialize)]
#[serde(expecting = "a pattern with \"panels\" and \"stitches\"")]
pub(crate) struct PatternJson {
    pub panels: Named<PanelJson>,
    #[serde(default)]
    pub stitches: Vec<Vec<StitchPart>>,
}

#[derive(Deserialize)]
#[serde(expecting = "properties with \"units_in_meter\"")]
pub(crate) struct PropertiesJson {
    pub units_in_meter: Number,
}

#[derive(Deserialize)]
#[serde(expecting = "a panel with \"vertices\", \"edges\", \"translation\" and \"rotation\"")]
pub(crate) struct PanelJson {
    pub vertices: Vec<[Number; 2]>,
    pub edges: Vec<EdgeJson>,
    pub translation: [Number; 3],
    pub rotation: [Number; 3],
}

#[derive(Deserialize)]
#[serde(expecting = "an edge with \"endpoints\"")]
pub(crate) struct EdgeJson {
    pub endpoints: [i64; 2],
    #[serde(default)]
    pub curvature: Option<CurvatureJson>,
    #[serde(default)]
    pub label: Option<String>,
}

/// A number, or null for NaN: so the check that knows panel and edge can name them.
#[derive(Clone, Copy, Deserialize)]
#[serde(from = "Option<f64>")]
pub(crate) struct Number(pub f64);

impl From<Option<f64>> for Number {
    fn from(value: Option<f64>) -> Self {
        Self(value.unwrap_or(f64::NAN))
    }
}

/// The entries of a JSON object in the order of the file, repeated names included.
pub(crate) struct Named<T>(pub Vec<(String, T)>);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for Entries<T> {
            type Value = Named<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Named(entries))
            }
        }

        deserializer.deserialize_map(Entries(PhantomData))
    }
}

/// Reads the text. Python writes NaN and Infinity, which JSON does not have; they become [`Number`] NaN.
pub(crate) fn read(text: &str) -> Result<GarmentJson, serde_json::Error> {
    serde_json::from_str(text).or_else(|error| {
        let Some(mended) = null_for_non_finite(text) else {
            return Err(error);
        };
        serde_json::from_str(&mended).map_err(|_| error)
    })
}

/// The text with `null` for each bare NaN and Infinity; `None` if it has none.
fn null_for_non_finite(text: &str) -> Option<String> {
    let mut mended = String::with_capacity(text.len());
    let mut found = false;
    let mut in_string = false;
    let mut rest = text;
    while let Some(next) = rest.chars().next() {
        let word = ["NaN", "-Infinity", "Infinity"].into_iter().find(|word| rest.starts_with(word));
        if let Some(word) = word.filter(|_| !in_string) {
            mended.push_str("null");
            found = true;
            rest = &rest[word.len()..];
            continue;
        }
        let mut length = next.len_utf8();
        match next {
            '"' => in_string = !in_string,
            '\\' if in_string => length += rest[1..].chars().next().map_or(0, char::len_utf8),
            _ => {}
        }
        mended.push_str(&rest[..length]);
        rest = &rest[length..];
    }
    found.then_some(mended)
}

/// One entry of a stitch.
#[derive(Deserialize)]
#[serde(untagged, expecting = "a stitch has two entries with \"panel\" and \"edge\", and may add \"right_wrong\"")]
pub(crate) enum StitchPart {
    Side(SideJson),
    Flag(String),
}

#[derive(Deserialize)]
pub(crate) struct SideJson {
    pub panel: String,
    pub edge: i64,
}

/// Shape of an edge in units of its chord, and for a circle in the file's unit.
pub(crate) enum CurvatureJson {
    Quadratic([f64; 2]),
    Cubic([[f64; 2]; 2]),
    Circle {
        radius: f64,
        large: bool,
        right: bool,
    },
    /// What cannot be understood, as a sentence: the caller knows the panel and the edge.
    Unknown(String),
}

impl<'de> Deserialize<'de> for CurvatureJson {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Value::deserialize(deserializer)?;
        Ok(curvature(&value).unwrap_or_else(Self::Unknown))
    }
}

fn curvature(value: &Value) -> Result<CurvatureJson, String> {
    // The old form of a quadratic curve is its control point alone.
    if value.is_array() {
        return point(value)
            .map(CurvatureJson::Quadratic)
            .ok_or_else(|| format!("the curvature {value} is not a control point [x, y]"));
    }
    let kind = value.get("type").and_then(Value::as_str).unwrap_or_default();
    let params = value.get("params").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let curve = match (kind, params) {
        ("quadratic", [control]) => point(control).map(CurvatureJson::Quadratic),
        ("cubic", [first, second]) => point(first).zip(point(second)).map(|(a, b)| CurvatureJson::Cubic([a, b])),
        ("circle", [radius, large, right]) => match (number(radius), flag(large), flag(right)) {
            (Some(radius), Some(large), Some(right)) => Some(CurvatureJson::Circle { radius, large, right }),
            _ => None,
        },
        ("quadratic" | "cubic" | "circle", _) => None,
        _ => {
            return Err(format!("the curvature type \"{kind}\" is not known; there is: quadratic, cubic, circle"));
        }
    };
    curve.ok_or_else(|| format!("the params of the curvature type \"{kind}\" are not complete"))
}

fn number(value: &Value) -> Option<f64> {
    if value.is_null() { Some(f64::NAN) } else { value.as_f64() }
}

fn point(value: &Value) -> Option<[f64; 2]> {
    match value.as_array()?.as_slice() {
        [x, y] => Some([number(x)?, number(y)?]),
        _ => None,
    }
}

/// 0, 1, false or true.
fn flag(value: &Value) -> Option<bool> {
    value.as_bool().or_else(|| match value.as_f64() {
        Some(0.0) => Some(false),
        Some(1.0) => Some(true),
        _ => None,
    })
}
