//! A page as Markdown, its plots in files beside it.

use crate::page::content::{Block, Page, Table};
use crate::page::svg;

/// A page as Markdown; gives its text, and name and text of each plot that it links to. All names begin with `stem`.
pub fn markdown(page: &Page, stem: &str) -> (String, Vec<(String, String)>) {
    let mut text = format!("# {}\n\n{}\n\n", page.title, page.lead);
    for section in &page.sections {
        text.push_str(&format!("- [{}](#{})\n", section.title, anchor(&section.title)));
    }
    let mut plots = Vec::new();
    for section in &page.sections {
        text.push_str(&format!("\n## {}\n\n{}\n", section.title, plain(&section.lead)));
        for (index, block) in section.blocks.iter().enumerate() {
            text.push('\n');
            match block {
                Block::Text(words) => text.push_str(&format!("{}\n", plain(words))),
                Block::Table(table) => text.push_str(&table_text(table)),
                Block::Plot(plot) => {
                    let name = format!("{stem}-{}-{}.svg", section.name, index + 1);
                    let [x, y] = [&plot.x, &plot.y].map(|axis| axis.label.as_str());
                    text.push_str(&format!("![{y} against {x}]({name})\n\n*{}*\n", plain(&plot.caption)));
                    plots.push((name, svg::standalone(plot)));
                }
            }
        }
    }
    (text, plots)
}

fn table_text(table: &Table) -> String {
    let heads: Vec<String> = table.columns.iter().map(|column| cell_text(&column.head())).collect();
    let numbers = |column: usize| table.rows.iter().any(|row| row[column].value().is_some());
    let rules: Vec<&str> = (0..heads.len()).map(|column| if numbers(column) { "--:" } else { "---" }).collect();
    let mut text = format!("*{}*\n\n| {} |\n|{}|\n", plain(&table.caption), heads.join(" | "), rules.join("|"));
    for row in &table.rows {
        let cells: Vec<String> = row.iter().map(|cell| cell_text(&cell.shown())).collect();
        text.push_str(&format!("| {} |\n", cells.join(" | ")));
    }
    text
}

/// Words in which nothing is taken for a tag or for emphasis.
fn plain(words: &str) -> String {
    words.replace('<', "\\<").replace('*', "\\*")
}

/// The same in a table, where a bar would end the cell.
fn cell_text(text: &str) -> String {
    plain(text).replace('|', "\\|")
}

/// The name that GitHub and most others give a heading.
fn anchor(title: &str) -> String {
    let kept = |c: char| match c {
        ' ' => Some('-'),
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
        _ => None,
    };
    title.to_lowercase().chars().filter_map(kept).collect()
}
