//! The report as data: sections of text, tables and plots.

use serde::{Deserialize, Serialize};
use toile_lab::Scale;

/// Everything that a run of the experiments found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Name of the adapter.
    pub adapter: String,
    /// Version of toile.
    pub version: String,
    /// How much was measured.
    pub scale: Scale,
    /// Seed of everything that is random.
    pub seed: u64,
    /// What the experiments gave, in their order.
    pub sections: Vec<Section>,
}

/// What a page shows: a report, or two of them side by side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Page {
    /// Title.
    pub title: String,
    /// First paragraphs.
    pub lead: String,
    /// Sections.
    pub sections: Vec<Section>,
}

/// What one experiment gave.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Name of the experiment.
    pub name: String,
    /// Its title.
    pub title: String,
    /// What it asks and what came out, in a paragraph.
    pub lead: String,
    /// The rest, in order.
    pub blocks: Vec<Block>,
}

/// A part of a section.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Block {
    /// A paragraph.
    Text(String),
    /// A table.
    Table(Table),
    /// A plot.
    Plot(Plot),
}

/// A table of figures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// What it shows: scene, adapter, settings and seed, for a reader who never saw the code.
    pub caption: String,
    /// Columns; every row has a cell for each.
    pub columns: Vec<Column>,
    /// Rows.
    pub rows: Vec<Vec<Cell>>,
}

/// Head of a column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// What it holds.
    pub name: String,
    /// Unit of its numbers; empty for words and counts, "1" for ratios.
    pub unit: String,
}

/// A figure of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Cell {
    /// A word.
    Text(String),
    /// A finite number; shown with three significant digits. [`Cell::number`] makes one of any number.
    Number(f64),
    /// A whole number, shown with all its digits.
    Count(u64),
    /// Nothing was measured.
    Missing,
}

/// Curves over a common axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// What it shows: scene, adapter, settings and seed, for a reader who never saw the code.
    pub caption: String,
    /// Axis to the right.
    pub x: Axis,
    /// Axis upward.
    pub y: Axis,
    /// Curves.
    pub series: Vec<Series>,
}

/// An axis of a plot.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// What goes along it.
    pub label: String,
    /// Unit; "1" for ratios.
    pub unit: String,
    /// How values are spread.
    pub scale: AxisScale,
}

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AxisScale {
    /// Evenly.
    Linear,
    /// By their logarithm; values that are not positive are not shown.
    Log,
}

/// A curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Finite points; [`Series::new`] leaves others out.
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub style: SeriesStyle,
}

/// How a curve is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SeriesStyle {
    /// A thin dashed line: theory, bounds.
    Line,
    /// Marks alone.
    Marks,
    /// Marks joined by a line: what was measured.
    LineAndMarks,
}

impl From<&Report> for Page {
    fn from(report: &Report) -> Self {
        let Report { adapter, version, scale, seed, sections } = report;
        let lead = format!(
            "What error costs how much, measured by toile {version} on {adapter} with seed {seed}; {} run.\n\nCost is counted in state \
             copies: the time of a kernel that reads and writes position and velocity of every particle once, measured beside the \
             rest. It carries over between machines; milliseconds do not.",
            scale.word()
        );
        Self { title: "Speed against error".to_owned(), lead, sections: sections.clone() }
    }
}

impl Table {
    /// A table without rows; each column is a name and a unit.
    pub fn new(caption: impl Into<String>, columns: &[[&str; 2]]) -> Self {
        let column = |[name, unit]: &[&str; 2]| Column { name: (*name).to_owned(), unit: (*unit).to_owned() };
        Self { caption: caption.into(), columns: columns.iter().map(column).collect(), rows: Vec::new() }
    }

    /// Adds a row.
    ///
    /// # Panics
    /// When it has not one cell per column.
    pub fn push(&mut self, row: Vec<Cell>) {
        assert_eq!(row.len(), self.columns.len(), "a row has one cell per column: {}", self.caption);
        self.rows.push(row);
    }
}

impl Column {
    /// Name and unit, as a page shows them.
    pub fn head(&self) -> String {
        if self.unit.is_empty() { self.name.clone() } else { format!("{} [{}]", self.name, self.unit) }
    }
}

impl Cell {
    /// A number; one that is not finite becomes the word "diverged".
    pub fn number(value: f64) -> Self {
        if value.is_finite() { Self::Number(value) } else { Self::text("diverged") }
    }

    /// A number, or nothing where it was not measured.
    pub fn number_or_missing(value: Option<f64>) -> Self {
        value.map_or(Self::Missing, Self::number)
    }

    /// A word.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text(text.into())
    }
}

impl Axis {
    /// An axis with even spread.
    pub fn linear(label: &str, unit: &str) -> Self {
        Self { label: label.to_owned(), unit: unit.to_owned(), scale: AxisScale::Linear }
    }

    /// An axis spread by the logarithm.
    pub fn log(label: &str, unit: &str) -> Self {
        Self { scale: AxisScale::Log, ..Self::linear(label, unit) }
    }
}

impl Series {
    /// A curve through those of the points that are finite.
    pub fn new(name: impl Into<String>, style: SeriesStyle, points: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let finite = |point: &[f64; 2]| point.iter().all(|value| value.is_finite());
        Self { name: name.into(), points: points.into_iter().filter(finite).collect(), style }
    }
}
