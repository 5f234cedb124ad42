//! A small version of each section of the report, and the pages that are made of them.

mod maps;
mod page;
mod precision;
mod settings;
mod terms;

use toile_workspace::lab;
