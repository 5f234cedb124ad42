//! Two reports side by side: the figures of tables that both have, with their ratios, and the curves of plots that both have.

use crate::page::content::{Axis, Block, Cell, Page, Plot, Report, Section, Series, Table};

/// Two reports side by side. Tables and plots match when captions and columns or axes do, the names of the adapters left aside;
/// rows match by place and first cell. What only one of them has is said.
pub fn compare(a: &Report, b: &Report) -> Page {
    let name = |letter: &str, report: &Report| {
        let Report { adapter, version, scale, seed, .. } = report;
        format!("{letter}: {adapter}, toile {version}, {} measured with seed {seed}.", scale.word())
    };
    let mut sections: Vec<Section> = Vec::new();
    for section in &a.sections {
        match b.sections.iter().find(|other| other.name == section.name) {
            Some(other) => sections.push(compare_sections(section, &a.adapter, other, &b.adapter)),
            None => sections.push(alone(section, "A")),
        }
    }
    let known = |section: &&Section| a.sections.iter().any(|other| other.name == section.name);
    sections.extend(b.sections.iter().filter(|section| !known(section)).map(|section| alone(section, "B")));
    Page {
        title: "Two reports side by side".to_owned(),
        lead: format!("{}\n\n{}\n\nRatios are B / A.", name("A", a), name("B", b)),
        sections,
    }
}

fn alone(section: &Section, letter: &str) -> Section {
    Section { lead: format!("Only {letter} has this section."), blocks: Vec::new(), ..section.clone() }
}

fn compare_sections(a: &Section, adapter_a: &str, b: &Section, adapter_b: &str) -> Section {
    let mut blocks = Vec::new();
    let mut matched = vec![false; b.blocks.len()];
    for block in &a.blocks {
        let Some(caption) = key(block, adapter_a) else { continue };
        let partner = (0..b.blocks.len()).find(|index| {
            !matched[*index]
                && key(&b.blocks[*index], adapter_b).as_ref() == Some(&caption)
                && alike(block, &b.blocks[*index])
        });
        let Some(partner) = partner else {
            blocks.push(Block::Text(format!("Only A has: {caption}")));
            continue;
        };
        matched[partner] = true;
        match (block, &b.blocks[partner]) {
            (Block::Table(a), Block::Table(b)) => blocks.extend(compare_tables(&caption, a, b)),
            (Block::Plot(a), Block::Plot(b)) => blocks.push(Block::Plot(overlay(&caption, a, b))),
            _ => {}
        }
    }
    let missing = b.blocks.iter().zip(&matched).filter(|(_, matched)| !**matched);
    blocks.extend(
        missing.filter_map(|(block, _)| key(block, adapter_b)).map(|c| Block::Text(format!("Only B has: {c}"))),
    );
    Section { lead: String::new(), blocks, ..a.clone() }
}

/// The caption without the name of the adapter; `None` for paragraphs.
fn key(block: &Block, adapter: &str) -> Option<String> {
    let caption = match block {
        Block::Text(_) => return None,
        Block::Table(table) => &table.caption,
        Block::Plot(plot) => &plot.caption,
    };
    Some(if adapter.is_empty() { caption.clone() } else { caption.replace(adapter, "A and B") })
}

fn alike(a: &Block, b: &Block) -> bool {
    match (a, b) {
        (Block::Table(a), Block::Table(b)) => a.columns == b.columns,
        (Block::Plot(a), Block::Plot(b)) => [&a.x, &a.y] == [&b.x, &b.y],
        _ => false,
    }
}

/// A row for each figure of the rows that both have, then what only one of them has.
fn compare_tables(caption: &str, a: &Table, b: &Table) -> Vec<Block> {
    let mut table = Table::new(caption, &[["row", ""], ["figure", ""], ["A", ""], ["B", ""], ["B / A", "1"]]);
    let mut alone = Vec::new();
    for index in 0..a.rows.len().max(b.rows.len()) {
        match (a.rows.get(index), b.rows.get(index)) {
            (Some(row), Some(other)) if row.first() == other.first() => {
                for (column, (a_cell, b_cell)) in a.columns.iter().zip(row.iter().zip(other)).skip(1) {
                    // A word that is the same in both says which row it is, not what came out.
                    if a_cell.value().or(b_cell.value()).is_none() && a_cell == b_cell {
                        continue;
                    }
                    table.push(vec![
                        Cell::text(label(row)),
                        Cell::text(column.head()),
                        a_cell.clone(),
                        b_cell.clone(),
                        Cell::number_or_missing(ratio(a_cell, b_cell)),
                    ]);
                }
            }
            (row, other) => {
                alone.extend(row.map(|row| format!("Only A has the row {}.", label(row))));
                alone.extend(other.map(|row| format!("Only B has the row {}.", label(row))));
            }
        }
    }
    let mut blocks = vec![Block::Table(table)];
    if !alone.is_empty() {
        blocks.push(Block::Text(alone.join(" ")));
    }
    blocks
}

/// First cell and words of a row.
fn label(row: &[Cell]) -> String {
    let named = |(index, cell): (usize, &Cell)| (index == 0 || matches!(cell, Cell::Text(_))).then(|| cell.shown());
    row.iter().enumerate().filter_map(named).collect::<Vec<_>>().join(", ")
}

/// B / A where both are numbers and A is not zero.
fn ratio(a: &Cell, b: &Cell) -> Option<f64> {
    let [a, b] = [a.value()?, b.value()?];
    (a != 0.0).then(|| b / a)
}

fn overlay(caption: &str, a: &Plot, b: &Plot) -> Plot {
    let named = |letter: &str, series: &Series| Series { name: format!("{letter}: {}", series.name), ..series.clone() };
    let both = a.series.iter().map(|series| named("A", series)).chain(b.series.iter().map(|series| named("B", series)));
    let [x, y]: [Axis; 2] = [a.x.clone(), a.y.clone()];
    Plot { caption: caption.to_owned(), x, y, series: both.collect() }
}
