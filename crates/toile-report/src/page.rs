//! The report as data: sections of text, tables and plots, and the pages made from them.

mod compare;
mod content;
mod escaped;
mod html;
mod json;
mod markdown;
mod number;
mod svg;
mod ticks;

pub use compare::compare;
pub use content::{Axis, AxisScale, Block, Cell, Column, Page, Plot, Report, Section, Series, SeriesStyle, Table};
pub use escaped::escaped;
pub use html::html;
pub use json::{json, parse};
pub use markdown::markdown;
pub use number::three_digits;
pub use svg::{inline, standalone};
