//! What was found before sewing, and what was mended.

use super::axis::Axis;
use std::fmt;

/// What was found before sewing, and what was mended; each is one sentence.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// The body was turned until it stood upright.
    TurnedUpright {
        /// What was up.
        up: Axis,
    },
    /// The body was turned about y until it faced +z.
    TurnedAbout {
        /// By how much, counter-clockwise seen from above [°].
        degrees: f64,
        /// The axis that was nearest to where it faced.
        facing: Axis,
    },
    /// The body is no person's size.
    Size {
        /// Its height [m].
        height: f64,
    },
    /// A panel is in no seam.
    Loose {
        /// Name of the garment.
        garment: String,
        /// Name of the panel.
        panel: String,
    },
    /// A panel was drawn with its outside in, and was turned over.
    TurnedPanel {
        /// Name of the garment.
        garment: String,
        /// Name of the panel.
        panel: String,
    },
    /// A panel stands far from the body.
    Far {
        /// Name of the garment.
        garment: String,
        /// Name of the panel.
        panel: String,
        /// Distance between the boxes around them [m].
        distance: f64,
    },
    /// A garment was moved to where the body has its landmark.
    MovedGarment {
        /// Name of the garment.
        garment: String,
        /// How far, along x, y and z [m].
        way: [f64; 3],
        /// The landmark that it follows: "neck", "waist", or "middle".
        landmark: &'static str,
    },
    /// The panels of a sleeve were turned to the arm.
    TurnedSleeve {
        /// Name of the garment.
        garment: String,
        /// Names of the panels.
        panels: Vec<String>,
        /// The arm.
        arm: &'static str,
        /// By how much the sleeve was raised [°]; negative is lowered.
        degrees: f64,
    },
    /// A panel stood in the body and was moved until it was clear.
    MovedPanel {
        /// Name of the garment.
        garment: String,
        /// Name of the panel.
        panel: String,
        /// How far along its outside, negative is towards its inside [m].
        distance: f64,
        /// Where it stood.
        place: InBody,
    },
    /// A panel stands in the body, and was left there.
    LeftPanel {
        /// Name of the garment.
        garment: String,
        /// Name of the panel.
        panel: String,
        /// Where it stands.
        place: InBody,
    },
    /// The body is dressed with level arms: seams would have closed around them.
    RaisedArms {
        /// The time in its clip of all else [s]; `None` without the clip.
        time: Option<f64>,
    },
    /// The body is dressed in another pose than the first of its motion.
    Pose {
        /// The time in its clip [s]; `None` without the clip.
        time: Option<f64>,
    },
}

/// Where a panel stands in a body.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct InBody {
    /// The part of the body, in a word: "left arm", "trunk"; "body" where it is no person.
    pub part: &'static str,
    /// How deep, along the facing of the panel [m].
    pub depth: f64,
    /// Over what area [m²].
    pub area: f64,
}

impl Finding {
    /// Whether it may still go wrong, or the file is wrong whatever was mended.
    pub fn is_warning(&self) -> bool {
        match self {
            Self::Size { .. }
            | Self::Loose { .. }
            | Self::TurnedPanel { .. }
            | Self::Far { .. }
            | Self::LeftPanel { .. } => true,
            Self::TurnedUpright { .. }
            | Self::TurnedAbout { .. }
            | Self::MovedGarment { .. }
            | Self::TurnedSleeve { .. }
            | Self::MovedPanel { .. }
            | Self::RaisedArms { .. }
            | Self::Pose { .. } => false,
        }
    }
}

impl fmt::Display for InBody {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { part, depth, area } = self;
        write!(f, "in the {part}, {:.1} cm deep over {:.0} cm²", 1e2 * depth, 1e4 * area)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TurnedUpright { up } => {
                let (degrees, about) = up.way_upright();
                write!(f, "turned the body by {degrees} degrees about {about}: {up} was up")
            }
            Self::TurnedAbout { degrees, facing } => {
                write!(f, "turned the body by {degrees:.0} degrees about y: it faced {facing}")
            }
            Self::Size { height } => {
                write!(f, "the body is {height:.2} m tall: if that is no person's size, its unit is another one")
            }
            Self::Loose { garment, panel } => {
                write!(f, "panel {panel} of garment {garment} is in no seam: nothing will hold it")
            }
            Self::TurnedPanel { garment, panel } => {
                write!(f, "panel {panel} of garment {garment} is drawn with its outside in: it was turned over")
            }
            Self::Far { garment, panel, distance } => {
                write!(f, "panel {panel} of garment {garment} stands {distance:.2} m from the body")
            }
            Self::MovedGarment { garment, way: [x, y, z], landmark } => {
                let way = [("to +x", "to -x", x), ("up", "down", y), ("to +z", "to -z", z)]
                    .into_iter()
                    .filter(|(_, _, way)| **way != 0.0)
                    .map(|(on, back, way)| format!("{:.0} cm {}", 1e2 * way.abs(), if *way > 0.0 { on } else { back }))
                    .collect::<Vec<_>>()
                    .join(", ");
                write!(f, "moved garment {garment} {way}, to the {landmark} of the body")
            }
            Self::TurnedSleeve { garment, panels, arm, degrees } => {
                let (done, by) = if *degrees > 0.0 { ("raised", degrees) } else { ("lowered", &-degrees) };
                let panels = panels.join(", ");
                write!(f, "{done} panels {panels} of garment {garment} by {by:.0} degrees: the {arm} is held so")
            }
            Self::MovedPanel { garment, panel, distance, place } => {
                let way = if *distance > 0.0 { "out" } else { "in" };
                let moved = 1e2 * distance.abs();
                write!(f, "moved panel {panel} of garment {garment} {moved:.0} cm {way}: it stood {place}")
            }
            Self::LeftPanel { garment, panel, place } => {
                write!(f, "panel {panel} of garment {garment} stands {place}, and no way out of it is free")
            }
            Self::RaisedArms { .. } => {
                write!(f, "dressed with level arms: seams would have closed around them as they hang")
            }
            Self::Pose { time: None } => {
                write!(f, "dressed without the clip: there the body stands clearer of the panels")
            }
            Self::Pose { time: Some(time) } => {
                write!(f, "dressed at {time:.2} s of the clip: there the body stands clearer of the panels")
            }
        }
    }
}
