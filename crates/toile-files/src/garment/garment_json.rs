//! The shape of GarmentCode's JSON.

use crate::error::Place;
use crate::unread::Unread;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_ignored::Path;
use serde_json::Value;
use std::fmt;
use std::marker::PhantomData;

/// Keys of the format that say nothing about the cloth, each with its reason; `*` is any name or number.
const NEEDLESS: [(&[&str], &str); 8] = [
    (&["parameters"], "knobs of a template, whose result the panels are"),
    (&["parameter_order"], "the order of the knobs"),
    (&["constraints"], "relations between the knobs"),
    (&["constraint_order"], "the order of the relations"),
    (&["pattern", "panel_order"], "the order in which panels are listed; they are found by name"),
    (&["pattern", "panels", "*", "label"], "a word for a part of the body, by which pictures are coloured"),
    (
        &["properties", "normalized_edge_loops"],
        "where a loop begins and which way it runs, both of which are free here",
    ),
    (&["properties", "original_units_in_meter"], "the unit before the file was brought to centimetres"),
];

#[derive(Deserialize)]
#[serde(expecting = "a garment with \"pattern\" and \"properties\"")]
pub(crate) struct GarmentJson {
    pub pattern: PatternJson,
    #[serde(default)]
    pub properties: PropertiesJson,
}

#[derive(Deserialize)]
#[serde(expecting = "a pattern with \"panels\" and \"stitches\"")]
pub(crate) struct PatternJson {
    pub panels: Named<PanelJson>,
    #[serde(default)]
    pub stitches: Vec<Vec<StitchPart>>,
}

#[derive(Default, Deserialize)]
#[serde(default, expecting = "properties with \"units_in_meter\"")]
pub(crate) struct PropertiesJson {
    #[serde(deserialize_with = "present")]
    pub units_in_meter: Option<Number>,
    pub curvature_coords: Option<Value>,
    pub normalize_panel_translation: Option<Value>,
}

#[derive(Deserialize)]
#[serde(expecting = "a panel with \"vertices\", \"edges\", \"translation\" and \"rotation\"")]
pub(crate) struct PanelJson {
    pub vertices: Vec<[Number; 2]>,
    pub edges: Vec<EdgeJson>,
    #[serde(default)]
    pub translation: [Number; 3],
    #[serde(default)]
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
#[derive(Clone, Copy, Default, Deserialize)]
#[serde(from = "Option<f64>")]
pub(crate) struct Number(pub f64);

impl From<Option<f64>> for Number {
    fn from(value: Option<f64>) -> Self {
        Self(value.unwrap_or(f64::NAN))
    }
}

/// A number that is there, if only as null; the key's absence is the default.
fn present<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Number>, D::Error> {
    Number::deserialize(deserializer).map(Some)
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

/// Reads the text, and notes the keys that nothing reads. Python writes NaN and Infinity, which JSON does not have; they
/// become [`Number`] NaN.
pub(crate) fn read(text: &str, unread: &mut Unread) -> Result<GarmentJson, serde_json::Error> {
    deserialize(text, unread).or_else(|error| {
        let Some(mended) = null_for_non_finite(text) else {
            return Err(error);
        };
        *unread = Unread::default();
        deserialize(&mended, unread).map_err(|_| error)
    })
}

fn deserialize(text: &str, unread: &mut Unread) -> Result<GarmentJson, serde_json::Error> {
    let mut deserializer = serde_json::Deserializer::from_str(text);
    let json = serde_ignored::deserialize(&mut deserializer, |path| note(&names(&path), unread))?;
    deserializer.end()?;
    Ok(json)
}

/// The names and numbers that lead to a value.
fn names(path: &Path<'_>) -> Vec<String> {
    let (parent, name) = match path {
        Path::Root => return Vec::new(),
        Path::Seq { parent, index } => (parent, Some(index.to_string())),
        Path::Map { parent, key } => (parent, Some(key.clone())),
        Path::Some { parent } | Path::NewtypeStruct { parent } | Path::NewtypeVariant { parent } => (parent, None),
    };
    let mut names = names(parent);
    names.extend(name);
    names
}

fn note(names: &[String], unread: &mut Unread) {
    let is = |known: &[&str]| known.len() == names.len() && known.iter().zip(names).all(|(a, b)| *a == "*" || a == b);
    if NEEDLESS.iter().any(|(known, _)| is(known)) {
        return;
    }
    let Some((key, place)) = names.split_last() else { return };
    let number = |text: &String| text.parse().unwrap_or_default();
    let (whole, place) = match place.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["pattern", "panels", _] => ("of a panel", Place::Panel(place[2].clone())),
        ["pattern", "panels", _, "edges", _] => ("of an edge", Place::Edge(place[2].clone(), number(&place[4]))),
        ["pattern", "panels", _, "edges", _, ..] => {
            ("of a curvature", Place::Edge(place[2].clone(), number(&place[4])))
        }
        ["pattern", "stitches", _, ..] => ("of a stitch", Place::Stitch(number(&place[2]))),
        [] => ("of the file", Place::File),
        _ => ("of the file", Place::Key(names.join("."))),
    };
    unread.note(&format!("the key \"{key}\" {whole}"), || place);
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
pub(crate) enum StitchPart {
    Side(SideJson),
    Flag(String),
}

#[derive(Deserialize)]
pub(crate) struct SideJson {
    pub panel: String,
    pub edge: i64,
}

impl<'de> Deserialize<'de> for StitchPart {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Parts;

        impl<'de> Visitor<'de> for Parts {
            type Value = StitchPart;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a stitch has two entries with \"panel\" and \"edge\", and may add \"right_wrong\"")
            }

            fn visit_str<E>(self, flag: &str) -> Result<StitchPart, E> {
                Ok(StitchPart::Flag(flag.into()))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<StitchPart, A::Error> {
                SideJson::deserialize(MapAccessDeserializer::new(map)).map(StitchPart::Side)
            }
        }

        deserializer.deserialize_any(Parts)
    }
}

/// Shape of an edge: control points as "curvature_coords" says, the radius of a circle in the file's unit.
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

#[derive(Deserialize)]
struct CurveJson {
    #[serde(default, rename = "type")]
    kind: Value,
    #[serde(default)]
    params: Value,
}

impl<'de> Deserialize<'de> for CurvatureJson {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Curvatures;

        impl<'de> Visitor<'de> for Curvatures {
            type Value = CurvatureJson;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a curvature with \"type\" and \"params\", or a control point")
            }

            // The old form of a quadratic curve is its control point alone.
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<CurvatureJson, A::Error> {
                let value = Value::deserialize(SeqAccessDeserializer::new(seq))?;
                Ok(point(&value).map_or_else(
                    || CurvatureJson::Unknown(format!("the curvature {value} is not a control point [x, y]")),
                    CurvatureJson::Quadratic,
                ))
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<CurvatureJson, A::Error> {
                let curve = CurveJson::deserialize(MapAccessDeserializer::new(map))?;
                Ok(curvature(&curve).unwrap_or_else(CurvatureJson::Unknown))
            }
        }

        deserializer.deserialize_any(Curvatures)
    }
}

fn curvature(curve: &CurveJson) -> Result<CurvatureJson, String> {
    let kind = curve.kind.as_str().unwrap_or_default();
    let params = curve.params.as_array().map_or(&[][..], Vec::as_slice);
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
pub(crate) fn flag(value: &Value) -> Option<bool> {
    value.as_bool().or_else(|| match value.as_f64() {
        Some(0.0) => Some(false),
        Some(1.0) => Some(true),
        _ => None,
    })
}
