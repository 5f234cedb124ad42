//! The program `toile` from outside.

mod journey;
mod report;
mod support;
