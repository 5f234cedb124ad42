//! A page as one self-contained HTML file, light and dark, also for print.

use crate::page::content::{Block, Cell, Page, Section, Table};
use crate::page::escaped::escaped;
use crate::page::svg;
use crate::page::svg::{COLOURS, PLOT_STYLE};

/// How the page is set.
const STYLE: &str = "\
html{background:var(--ground);color:var(--ink);font:16px/1.55 system-ui,sans-serif;color-scheme:light dark}\
body{max-width:60rem;margin:0 auto;padding:2rem 1.25rem 4rem}\
h1{font-size:1.9rem;line-height:1.2;margin:0 0 .5rem}\
h2{font-size:1.35rem;margin:3rem 0 .5rem;padding-top:.75rem;border-top:1px solid var(--rule)}\
p{max-width:46rem}\
a{color:var(--c0)}\
nav{background:var(--raised);padding:.75rem 1.25rem;border-radius:.5rem;margin:1.5rem 0}\
nav ol{margin:0;padding-left:1.25rem}\
figure{margin:1.75rem 0}\
figcaption{color:var(--faint);font-size:.88rem;max-width:46rem;margin:.25rem 0 .5rem}\
svg.plot{width:100%;height:auto;display:block}\
.wide{overflow-x:auto}\
table{border-collapse:collapse;font-size:.88rem;font-variant-numeric:tabular-nums}\
th,td{padding:.25rem .8rem .25rem 0;text-align:left;border-bottom:1px solid var(--rule);vertical-align:top}\
th{color:var(--faint);font-weight:600;vertical-align:bottom}\
th.number,td.number{text-align:right}\
@media print{html{font-size:11px}body{max-width:none;padding:0}nav{break-after:page}h2{break-after:avoid}figure,tr{break-inside:avoid}.wide{overflow:visible}}";

/// A page as one HTML file that needs no other.
pub fn html(page: &Page) -> String {
    let title = escaped(&page.title);
    let mut text = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{title}</title>\n<style>{COLOURS}{PLOT_STYLE}{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n{}",
        paragraphs(&page.lead)
    );
    text.push_str("<nav aria-label=\"Contents\"><ol>\n");
    for section in &page.sections {
        text.push_str(&format!("<li><a href=\"#{}\">{}</a></li>\n", escaped(&section.name), escaped(&section.title)));
    }
    text.push_str("</ol></nav>\n");
    page.sections.iter().for_each(|section| text.push_str(&section_text(section)));
    text.push_str("</body>\n</html>\n");
    text
}

fn section_text(section: &Section) -> String {
    let mut text = format!(
        "<section>\n<h2 id=\"{}\">{}</h2>\n{}",
        escaped(&section.name),
        escaped(&section.title),
        paragraphs(&section.lead)
    );
    for block in &section.blocks {
        match block {
            Block::Text(words) => text.push_str(&paragraphs(words)),
            Block::Table(table) => text.push_str(&table_text(table)),
            Block::Plot(plot) => text.push_str(&format!(
                "<figure>\n{}\n<figcaption>{}</figcaption>\n</figure>\n",
                svg::inline(plot),
                escaped(&plot.caption)
            )),
        }
    }
    text.push_str("</section>\n");
    text
}

fn paragraphs(words: &str) -> String {
    let parts = words.split("\n\n").filter(|part| !part.trim().is_empty());
    parts.map(|part| format!("<p>{}</p>\n", escaped(part.trim()))).collect()
}

fn table_text(table: &Table) -> String {
    let numbers = |column: usize| table.rows.iter().any(|row| row[column].value().is_some());
    let class = |column: usize| if numbers(column) { " class=\"number\"" } else { "" };
    let heads: String = table
        .columns
        .iter()
        .enumerate()
        .map(|(index, column)| format!("<th scope=\"col\"{}>{}</th>", class(index), escaped(&column.head())))
        .collect();
    let row = |cells: &Vec<Cell>| {
        let cells: String = cells
            .iter()
            .enumerate()
            .map(|(index, cell)| format!("<td{}>{}</td>", class(index), escaped(&cell.shown())))
            .collect();
        format!("<tr>{cells}</tr>\n")
    };
    let rows: String = table.rows.iter().map(row).collect();
    format!(
        "<figure>\n<figcaption>{}</figcaption>\n<div class=\"wide\"><table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}</tbody>\n\
         </table></div>\n</figure>\n",
        escaped(&table.caption)
    )
}
