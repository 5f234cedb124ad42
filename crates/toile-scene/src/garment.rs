//! A garment as flat cutting patterns with seams.

use crate::Fabric;
use glam::{DQuat, DVec2, DVec3};

/// A garment as flat cutting patterns with seams.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Garment {
    /// Name shown in metrics and meshes.
    pub name: String,
    /// The pieces of cloth.
    pub panels: Vec<Panel>,
    /// Pairs of panel edges that are sewn together.
    pub seams: Vec<Seam>,
    /// What it is made of; `None` is the fabric of the settings. It keeps its own thickness from the body, and the larger of both from a garment below.
    pub fabric: Option<Fabric>,
}

impl Garment {
    /// A garment of the fabric of the settings.
    pub fn new(name: impl Into<String>, panels: Vec<Panel>, seams: Vec<Seam>) -> Self {
        Self { name: name.into(), panels, seams, fabric: None }
    }
}

/// One flat piece of cloth. x is the weft and y the warp direction.
///
/// Its outline is one closed loop. The winding gives the outside of the cloth: the outside is the local +z direction where
/// the loop is counter-clockwise, local −z where it is clockwise.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Panel {
    /// Name used in errors and seams.
    pub name: String,
    /// Edges of the outline in loop order: each ends where the next one starts.
    pub edges: Vec<Edge>,
    /// Where the flat panel stands before it is sewn.
    pub placement: Placement,
}

impl Panel {
    /// A panel with this outline.
    pub fn new(name: impl Into<String>, edges: Vec<Edge>, placement: Placement) -> Self {
        Self { name: name.into(), edges, placement }
    }
}

/// One edge of a panel's outline.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Edge {
    /// Where it starts [m], flat. It ends at the start of the next edge.
    pub start: DVec2,
    /// Its shape.
    pub curve: Curve,
    /// Name of an edge that is held at its height while the garment is sewn: waistbands, collars, armholes.
    pub label: Option<String>,
}

impl Edge {
    /// An edge that starts there [m] and is free while the garment is sewn.
    pub fn new(start: DVec2, curve: Curve) -> Self {
        Self { start, curve, label: None }
    }
}

/// Shape of an edge between its ends. All points are flat positions [m].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Curve {
    /// A straight line.
    Straight,
    /// A quadratic Bézier curve.
    Quadratic {
        /// Control point [m].
        control: DVec2,
    },
    /// A cubic Bézier curve.
    Cubic {
        /// Control points [m].
        controls: [DVec2; 2],
    },
    /// A circular arc.
    Arc {
        /// Radius [m], at least half the distance of the ends.
        radius: f64,
        /// Whether it is the longer of the two arcs.
        large: bool,
        /// Whether it bulges to the right of the way from start to end.
        right: bool,
    },
}

/// Where a flat panel stands: world = rotation·(x, y, 0) + translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Rotation.
    pub rotation: DQuat,
    /// Translation [m].
    pub translation: DVec3,
}

impl Placement {
    /// World position [m] of a flat point [m].
    pub fn world(&self, flat: DVec2) -> DVec3 {
        self.rotation * flat.extend(0.0) + self.translation
    }
}

/// One edge of one panel, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct EdgeRef {
    /// Index into [`Garment::panels`].
    pub panel: usize,
    /// Index into [`Panel::edges`].
    pub edge: usize,
}

/// Two edges that are sewn together. They may differ in length: the longer one is gathered.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Seam {
    /// The two edges.
    pub sides: [EdgeRef; 2],
    /// Whether the outside of one panel meets the inside of the other.
    pub right_wrong: bool,
}

impl Seam {
    /// A seam between two edges, right side to right side.
    pub fn new(sides: [EdgeRef; 2]) -> Self {
        Self { sides, right_wrong: false }
    }
}
