//! Garments from GarmentCode's JSON.

mod crossing;
mod garment_json;
mod slit;
mod stitch;

use crate::error::{Fault, FileError, Found, Place, rounded};
use crate::format::{self, GARMENT};
use crate::garment::garment_json::{CurvatureJson, EdgeJson, Number, PanelJson, PropertiesJson, flag};
use crate::plausible::LARGEST_PANEL;
use crate::source;
use crate::unread::Unread;
use glam::{DQuat, DVec2, DVec3, EulerRot};
use std::collections::HashMap;
use std::path::Path;
use toile_scene::{Curve, Edge, Garment, Panel, Placement};

/// Least distance of the ends of an edge [m]. Below, it is a slip of the pattern.
const SHORTEST_EDGE: f64 = 1e-6;

/// Most edges of a panel. Patterns have tens; comparing very many with each other would take forever.
const MOST_EDGES: usize = 2048;

/// How much the radius of an arc may fall short of half its chord by rounding [1].
const RADIUS_ROUNDING: f64 = 1e-6;

/// Distance [m] of the polyline from the curve where the outline is tested for crossings.
const CROSSING_TOLERANCE: f64 = 1e-4;

/// Units in a metre where a file does not say: the format's are centimetres.
const UNITS_IN_METER: f64 = 100.0;

/// Largest file [bytes]. Patterns have some ten thousand, and a small file can ask for much memory.
const LARGEST_FILE: usize = 8 << 20;

/// A garment as it was read.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct GarmentFile {
    /// The garment.
    pub garment: Garment,
    /// What the file leaves open or has that is not read, each with its name.
    pub warnings: Vec<String>,
}

/// Reads a garment in GarmentCode's JSON, and what is unusual about the file.
///
/// A cut into a panel, drawn as an outline that goes in along a line and comes back on it, is opened by half a millimetre.
///
/// # Errors
///
/// [`FileError`] with panel and edge when the file cannot be read, is not valid JSON, has an outline that is open, crosses
/// itself or has a coordinate that is not finite, an edge whose curve cannot exist, a panel larger than 10 m, or a stitch
/// to a panel or edge that does not exist.
pub fn read_garment(path: &Path) -> Result<GarmentFile, FileError> {
    let bytes = source::read_bytes(path)?;
    read(&bytes, path).map_err(|found| found.in_file(path))
}

/// Reads a garment from text; `name` stands for the path in errors, and without its ending it is the garment's name.
///
/// # Errors
///
/// As [`read_garment`].
pub fn parse_garment(text: &str, name: &str) -> Result<GarmentFile, FileError> {
    read(text.as_bytes(), Path::new(name)).map_err(|found| found.in_file(name))
}

/// How the file's numbers are meant.
struct Conventions {
    units_in_meter: f64,
    /// Whether control points are flat positions, not parts of the edge's chord.
    absolute: bool,
    /// Whether a translation is that of the mean of the vertices as it lies flat, not of the flat origin.
    centred: bool,
}

impl Conventions {
    fn of(properties: &PropertiesJson, warnings: &mut Vec<String>) -> Result<Self, Found> {
        let wrong = |key: &str, message: String| Found::malformed(Place::Key(format!("properties.{key}")), message);
        let units_in_meter = match properties.units_in_meter {
            Some(Number(units)) if units.is_finite() && units > 0.0 => units,
            Some(Number(units)) => {
                return Err(wrong("units_in_meter", format!("it is {units} and must be a positive number")));
            }
            None => {
                warnings.push("it has no key \"properties.units_in_meter\": read as centimetres".into());
                UNITS_IN_METER
            }
        };
        let absolute = match &properties.curvature_coords {
            None => false,
            Some(coords) => match coords.as_str() {
                Some("relative") => false,
                Some("absolute") => true,
                _ => {
                    let message = format!("{coords} is not known; there is: \"relative\", \"absolute\"");
                    return Err(wrong("curvature_coords", message));
                }
            },
        };
        let centred = match &properties.normalize_panel_translation {
            None => false,
            Some(value) => flag(value).ok_or_else(|| {
                wrong("normalize_panel_translation", format!("{value} is not known; there is: true, false"))
            })?,
        };
        Ok(Self { units_in_meter, absolute, centred })
    }
}

fn read(bytes: &[u8], name: &Path) -> Result<GarmentFile, Found> {
    format::check_garment(bytes, name)?;
    if bytes.len() > LARGEST_FILE {
        let what = format!("a garment of more than {LARGEST_FILE} bytes");
        return Err(Fault::Unsupported(what).into());
    }
    let text = source::text(bytes)?;
    let mut unread = Unread::default();
    let json = garment_json::read(&text, &mut unread).map_err(|error| {
        // serde_json repeats the place at the end of its message.
        let message = error.to_string();
        let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(start, _)| start);
        if !text.trim_start().starts_with(['{', '[']) {
            return Found::malformed(Place::File, format!("it is not JSON: {GARMENT}"));
        }
        if message == "missing field `pattern`" {
            return Found::malformed(Place::File, format!("it has no key \"pattern\": {GARMENT}"));
        }
        let place = Place::Column(error.line(), error.column());
        Found::malformed(place, format!("the JSON is not valid: {message}"))
    })?;
    let mut warnings = Vec::new();
    let conventions = Conventions::of(&json.properties, &mut warnings)?;
    warnings.extend(unread.sentences());
    if json.pattern.panels.0.is_empty() {
        return Err(Found::malformed(Place::File, "the garment has no panel"));
    }
    let mut panels = Vec::new();
    let mut numbers = HashMap::new();
    for (name, panel) in &json.pattern.panels.0 {
        if numbers.insert(name.as_str(), panels.len()).is_some() {
            return Err(Found::malformed(Place::Panel(name.clone()), "there are two panels of this name"));
        }
        panels.push(convert_panel(name, panel, &conventions)?);
    }
    let mut seams = Vec::new();
    let mut sewn = HashMap::new();
    for (index, stitch) in json.pattern.stitches.iter().enumerate() {
        seams.push(stitch::convert(index, stitch, &panels, &numbers, &mut sewn)?);
    }
    let stem = name.file_stem().unwrap_or_default().to_string_lossy();
    let name = stem.strip_suffix("_specification").unwrap_or(&stem).to_string();
    Ok(GarmentFile { garment: Garment::new(name, panels, seams), warnings })
}

fn convert_panel(name: &str, json: &PanelJson, conventions: &Conventions) -> Result<Panel, Found> {
    let units_in_meter = conventions.units_in_meter;
    let place = || Place::Panel(name.into());
    let point = |[x, y]: [Number; 2]| DVec2::new(x.0, y.0) / units_in_meter;
    for (index, vertex) in json.vertices.iter().enumerate() {
        if !point(*vertex).is_finite() {
            let what = format!("vertex {index} at ({}, {})", vertex[0].0, vertex[1].0);
            return Err(Found::at(place(), Fault::NotFinite(what)));
        }
    }
    let translation = DVec3::from(json.translation.map(|n| n.0)) / units_in_meter;
    let [x, y, z] = json.rotation.map(|n| n.0.to_radians());
    let rotation = DQuat::from_euler(EulerRot::ZYX, z, y, x);
    if !(translation.is_finite() && rotation.is_finite()) {
        return Err(Found::at(place(), Fault::NotFinite("the translation or rotation".into())));
    }
    let mut placement = Placement { rotation, translation };
    if conventions.centred {
        let mean = json.vertices.iter().map(|vertex| point(*vertex)).sum::<DVec2>() / json.vertices.len().max(1) as f64;
        // The format moves the panel by the mean as it lies flat, whatever its rotation.
        placement.translation += mean.extend(0.0) - rotation * mean.extend(0.0);
    }
    let ends = loop_ends(name, json)?;
    let mut edges = Vec::new();
    for (index, (edge, [a, b])) in json.edges.iter().zip(&ends).enumerate() {
        let [a, b] = [point(json.vertices[*a]), point(json.vertices[*b])];
        let curve = convert_curve(edge, a, b, conventions)
            .map_err(|fault| Found::at(Place::Edge(name.into(), index), fault))?;
        let mut converted = Edge::new(a, curve);
        converted.label.clone_from(&edge.label);
        edges.push(converted);
    }
    slit::open(&mut edges);
    let panel = Panel::new(name, edges, placement);
    check_size(&panel, units_in_meter)?;
    let polylines: Vec<_> = (0..panel.edges.len()).map(|edge| panel.polyline(edge, CROSSING_TOLERANCE)).collect();
    match crossing::first_crossing(&polylines) {
        Some((edges, at)) => Err(Found::at(place(), Fault::SelfCrossing { edges, x: at.x, y: at.y })),
        None => Ok(panel),
    }
}

/// The vertices of each edge's ends, checked to be one closed loop in order.
fn loop_ends(name: &str, json: &PanelJson) -> Result<Vec<[usize; 2]>, Found> {
    let count = json.vertices.len();
    let mut ends = Vec::new();
    for (index, edge) in json.edges.iter().enumerate() {
        let place = || Place::Edge(name.into(), index);
        let vertex = |written: i64| {
            usize::try_from(written)
                .ok()
                .filter(|vertex| *vertex < count)
                .ok_or_else(|| Found::at(place(), Fault::OutOfRange { what: "vertex", index: written, count }))
        };
        ends.push([vertex(edge.endpoints[0])?, vertex(edge.endpoints[1])?]);
    }
    let curved = json.edges.iter().any(|edge| edge.curvature.is_some());
    let least = if curved { 2 } else { 3 };
    if ends.len() < least {
        let message = format!("the outline has {} edges, it needs {least}", ends.len());
        return Err(Found::malformed(Place::Panel(name.into()), message));
    }
    if ends.len() > MOST_EDGES {
        let what = format!("an outline of more than {MOST_EDGES} edges");
        return Err(Found::at(Place::Panel(name.into()), Fault::Unsupported(what)));
    }
    for (index, [_, end]) in ends.iter().enumerate() {
        let next = (index + 1) % ends.len();
        if *end != ends[next][0] {
            if *end == ends[0][0] {
                let message = "a second outline begins after this edge, and a panel has one: draw a hole as a cut from the \
                               rim, an edge in to the hole and the same edge back, or split the panel through the hole";
                return Err(Found::malformed(Place::Edge(name.into(), index), message));
            }
            let message = format!(
                "the outline is not closed: the edge ends at vertex {end} and edge {next} starts at vertex {}",
                ends[next][0]
            );
            return Err(Found::malformed(Place::Edge(name.into(), index), message));
        }
    }
    Ok(ends)
}

fn convert_curve(edge: &EdgeJson, a: DVec2, b: DVec2, conventions: &Conventions) -> Result<Curve, Fault> {
    let units_in_meter = conventions.units_in_meter;
    let chord = b - a;
    if chord.length() < SHORTEST_EDGE {
        let message = format!("its ends are the same point, ({}, {}) m", a.x, a.y);
        return Err(Fault::Malformed(message));
    }
    let control = |[along, aside]: [f64; 2]| {
        let point = match conventions.absolute {
            true => DVec2::new(along, aside) / units_in_meter,
            false => a + chord * along + chord.perp() * aside,
        };
        if point.is_finite() {
            Ok(point)
        } else {
            Err(Fault::NotFinite(format!("the control point ({along}, {aside})")))
        }
    };
    Ok(match &edge.curvature {
        None => Curve::Straight,
        Some(CurvatureJson::Quadratic(point)) => Curve::Quadratic { control: control(*point)? },
        Some(CurvatureJson::Cubic([first, second])) => Curve::Cubic { controls: [control(*first)?, control(*second)?] },
        Some(CurvatureJson::Circle { radius, large, right }) => {
            let (radius, half) = (radius / units_in_meter, 0.5 * chord.length());
            if !radius.is_finite() {
                return Err(Fault::NotFinite("the radius".into()));
            }
            if radius < half * (1.0 - RADIUS_ROUNDING) {
                return Err(Fault::SmallRadius { radius, chord: 2.0 * half });
            }
            Curve::Arc { radius: radius.max(half), large: *large, right: *right }
        }
        Some(CurvatureJson::Unknown(message)) => return Err(Fault::Malformed(message.clone())),
    })
}

/// Refuses a panel that no garment has. Control points count, because a curve stays within their hull.
fn check_size(panel: &Panel, units_in_meter: f64) -> Result<(), Found> {
    let mut low = DVec2::INFINITY;
    let mut high = DVec2::NEG_INFINITY;
    let mut include = |point: DVec2| {
        low = low.min(point);
        high = high.max(point);
    };
    for (index, edge) in panel.edges.iter().enumerate() {
        include(edge.start);
        match edge.curve {
            Curve::Straight => {}
            Curve::Quadratic { control } => include(control),
            Curve::Cubic { controls } => controls.into_iter().for_each(&mut include),
            // A small arc is no wider than its chord, whatever its radius.
            Curve::Arc { radius, large, .. } => {
                let end = panel.edges[(index + 1) % panel.edges.len()].start;
                let reach = if large { 2.0 * radius } else { 0.5 * edge.start.distance(end) };
                let middle = edge.start.midpoint(end);
                include(middle - reach);
                include(middle + reach);
            }
        }
    }
    let size = (high - low).max_element();
    if size > LARGEST_PANEL {
        let fault = Fault::PanelUnits { size: rounded(size), units_in_meter };
        return Err(Found::at(Place::Panel(panel.name.clone()), fault));
    }
    Ok(())
}
