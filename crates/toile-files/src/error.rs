//! Why a file cannot be used: which file, where in it, and what to do.

use crate::plausible::{HEIGHTS, LARGEST_PANEL, WIDTH_MAX};
use std::fmt;
use std::path::PathBuf;

/// Why a file cannot be used, as one sentence with the file and the place in it.
#[derive(Debug, thiserror::Error)]
#[error("{}{place}: {fault}", path.display())]
#[non_exhaustive]
pub struct FileError {
    /// The file, as the caller named it.
    pub path: PathBuf,
    /// Where in the file.
    pub place: Place,
    /// What is wrong there.
    pub fault: Box<Fault>,
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// The file as a whole.
    File,
    /// A line, counted from 1.
    Line(usize),
    /// A line and a column, counted from 1.
    Column(usize, usize),
    /// A byte, counted from 0.
    Byte(usize),
    /// A row of a PLY element, counted from 0.
    Row(String, usize),
    /// A glTF accessor, counted from 0.
    Accessor(usize),
    /// A glTF node, counted from 0.
    Node(usize),
    /// A panel of a garment.
    Panel(String),
    /// An edge of a panel, counted from 0.
    Edge(String, usize),
    /// A stitch of a garment, counted from 0.
    Stitch(usize),
    /// A key of a TOML or JSON file, dotted.
    Key(String),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => Ok(()),
            Self::Line(line) => write!(f, ", line {line}"),
            Self::Column(line, column) => write!(f, ", line {line}, column {column}"),
            Self::Byte(byte) => write!(f, ", byte {byte}"),
            Self::Row(element, row) => write!(f, ", {element} {row}"),
            Self::Accessor(accessor) => write!(f, ", accessor {accessor}"),
            Self::Node(node) => write!(f, ", node {node}"),
            Self::Panel(panel) => write!(f, ", panel \"{panel}\""),
            Self::Edge(panel, edge) => write!(f, ", panel \"{panel}\", edge {edge}"),
            Self::Stitch(stitch) => write!(f, ", stitch {stitch}"),
            Self::Key(key) => write!(f, ", key \"{key}\""),
        }
    }
}

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The operating system refuses to read it.
    #[error("it cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// The operating system refuses to write it.
    #[error("it cannot be written: {0}")]
    Unwritable(std::io::Error),
    /// The name does not end like a file that can be read.
    #[error("its name ends in none of the known ways: {0}")]
    UnknownFormat(&'static str),
    /// The text or the bytes break the rules of the format.
    #[error("{0}")]
    Malformed(String),
    /// The format allows it, but it is not read.
    #[error("{0} cannot be read")]
    Unsupported(String),
    /// A declared size is larger than the file.
    #[error("{what} needs {needed} bytes, but the file has only {available} left: it is truncated or damaged")]
    Truncated {
        /// What has the size.
        what: String,
        /// Declared size [bytes].
        needed: u128,
        /// Size that is there [bytes].
        available: usize,
    },
    /// A number is NaN, infinite, or too large for a position.
    #[error("{0} is not a finite number")]
    NotFinite(String),
    /// An index points outside of the list that it counts.
    #[error("{what} {index} does not exist: there are {count}")]
    OutOfRange {
        /// What is counted.
        what: &'static str,
        /// The index as the file writes it.
        index: i64,
        /// Number of entries.
        count: usize,
    },
    /// A body without triangles.
    #[error("the body is empty: it has {0} vertices and no triangle; export the mesh with its faces")]
    Empty(usize),
    /// A body that is no human size in the declared unit.
    #[error(
        "the body is {height} m tall, and bodies are {} m to {} m tall: {advice}",
        HEIGHTS[0],
        HEIGHTS[1]
    )]
    BodyUnits {
        /// Height in the declared unit [m], rounded for reading.
        height: String,
        /// What to do.
        advice: String,
    },
    /// A body with something far from it.
    #[error(
        "the body is {width} m wide, and bodies are at most {} m to the sides: remove what lies far from it",
        WIDTH_MAX
    )]
    BodyWidth {
        /// Larger extent to the sides [m], rounded for reading.
        width: String,
    },
    /// A panel that is no size of a garment in the declared unit.
    #[error(
        "the panel is {size} m large, and panels are at most {} m: check units_in_meter, which is {units_in_meter}",
        LARGEST_PANEL
    )]
    PanelUnits {
        /// Longer side of the panel's box [m], rounded for reading.
        size: String,
        /// As the file declares it.
        units_in_meter: f64,
    },
    /// A name that nothing has.
    #[error("there is no {what} \"{name}\"{} there is: {}", meant(name, .known), listed(.known))]
    Unknown {
        /// What has names.
        what: &'static str,
        /// The name as the file or the caller writes it.
        name: String,
        /// The names that exist.
        known: Vec<String>,
    },
    /// Two edges of an outline cross or touch.
    #[error(
        "the outline crosses itself: edge {0} meets edge {1} near ({x:.4}, {y:.4}) m; \
         draw it as one loop, or split the panel there into two that are stitched",
        edges[0],
        edges[1]
    )]
    SelfCrossing {
        /// The two edges.
        edges: [usize; 2],
        /// Flat position [m].
        x: f64,
        /// Flat position [m].
        y: f64,
    },
    /// A circular edge that cannot span its ends.
    #[error("the circle of radius {radius} m cannot reach both ends, which are {chord} m apart")]
    SmallRadius {
        /// Radius [m].
        radius: f64,
        /// Distance of the ends [m].
        chord: f64,
    },
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".into() } else { names.join(", ") }
}

/// What stands between a wrong name and the list of right ones: a question for the one that was probably meant, where one is near.
fn meant(name: &str, known: &[String]) -> String {
    // A third of the letters may be wrong: more of them make another word.
    let slips_max = (name.chars().count() / 3).max(1);
    let nearest = known.iter().map(|known| (slips(name, known), known)).min_by_key(|(slips, _)| *slips);
    match nearest {
        Some((slips, known)) if slips <= slips_max => format!("; did you mean \"{known}\"?"),
        _ => ";".to_owned(),
    }
}

/// How many letters must be added, left out or replaced to make one name of another, case aside: Levenshtein's distance.
fn slips(name: &str, known: &str) -> usize {
    let letters = |text: &str| text.to_lowercase().chars().collect::<Vec<char>>();
    let (name, known) = (letters(name), letters(known));
    let mut row: Vec<usize> = (0..=known.len()).collect();
    for (i, a) in name.iter().enumerate() {
        let mut before = std::mem::replace(&mut row[0], i + 1);
        for (j, b) in known.iter().enumerate() {
            let least = row[j].min(row[j + 1]) + 1;
            let replaced = before + usize::from(a != b);
            before = std::mem::replace(&mut row[j + 1], least.min(replaced));
        }
    }
    row[known.len()]
}

/// Three significant digits, for a sentence.
pub(crate) fn rounded(value: f64) -> String {
    if value >= 1e6 {
        return format!("{value:.2e}");
    }
    let digits = if value > 0.0 { (2.0 - value.log10().floor()).clamp(0.0, 12.0) as usize } else { 0 };
    format!("{value:.digits$}")
}

/// A fault and its place, before the path is known.
#[derive(Debug)]
pub(crate) struct Found {
    pub place: Place,
    pub fault: Fault,
}

impl Found {
    pub fn at(place: Place, fault: Fault) -> Self {
        Self { place, fault }
    }

    pub fn malformed(place: Place, message: impl Into<String>) -> Self {
        Self { place, fault: Fault::Malformed(message.into()) }
    }

    pub fn in_file(self, path: impl Into<PathBuf>) -> FileError {
        FileError { path: path.into(), place: self.place, fault: Box::new(self.fault) }
    }
}

impl From<Fault> for Found {
    fn from(fault: Fault) -> Self {
        Self { place: Place::File, fault }
    }
}

#[cfg(test)]
mod tests {
    use super::{Fault, slips};

    #[test]
    fn the_name_that_was_meant_is_told() {
        assert_eq!(["wool", "Wol", "woool", "silk"].map(|name| slips(name, "wool")), [0, 1, 1, 4]);
        let unknown = |name: &str| {
            let known = ["silk", "wool", "denim"].map(String::from).to_vec();
            Fault::Unknown { what: "fabric", name: name.into(), known }.to_string()
        };
        assert_eq!(unknown("wol"), "there is no fabric \"wol\"; did you mean \"wool\"? there is: silk, wool, denim");
        assert_eq!(unknown("tweed"), "there is no fabric \"tweed\"; there is: silk, wool, denim");
    }
}
