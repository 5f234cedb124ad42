//! Plots as SVG whose colours are CSS variables, so that a page shows them light or dark.
//!
//! Written by hand: plotters, the common crate, writes every colour as a fixed RGB value, and poloto, which leaves them to CSS, has
//! no logarithmic axes.

use crate::page::content::{Axis, Plot, Series, SeriesStyle};
use crate::page::escaped::escaped;
use crate::page::number::tick;
use crate::page::ticks::Span;
use std::fmt::Write;

/// Size of a plot, and of the place that its axes leave for the curves [px].
const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 76.0;
const TOP: f64 = 16.0;
const RIGHT: f64 = 530.0;
const BOTTOM: f64 = 364.0;
/// Distance of the lines of the legend [px].
const LEGEND_LINE: f64 = 20.0;
/// Letters that a line of the legend has room for.
const LEGEND_LETTERS: usize = 32;
/// Colours of [`COLOURS`]; later curves begin anew, with another mark.
const COLOUR_COUNT: usize = 8;

/// The colours of plots and pages, light and dark: those of curves by Okabe and Ito (2008), which colour-blind readers can tell apart,
/// lightened or darkened to stand out from the ground.
pub(crate) const COLOURS: &str = "\
:root{--ground:#ffffff;--ink:#1b1d22;--faint:#5b616c;--rule:#dfe2e8;--raised:#f5f6f9;\
--c0:#0072b2;--c1:#c44e00;--c2:#00795a;--c3:#a8327f;--c4:#8a6d00;--c5:#2f8fd0;--c6:#444b57;--c7:#b3202c}\
@media (prefers-color-scheme:dark){:root{--ground:#14161a;--ink:#e8eaee;--faint:#a2a9b5;--rule:#343943;--raised:#1d2026;\
--c0:#5ab4f0;--c1:#f09050;--c2:#3fd0a4;--c3:#e58ac6;--c4:#e6c84a;--c5:#9bd3ff;--c6:#c3c9d4;--c7:#ff8080}}";

/// How the parts of a plot are drawn.
pub(crate) const PLOT_STYLE: &str = "\
.plot text{font:12px system-ui,sans-serif;fill:var(--ink)}\
.plot .faint{fill:var(--faint)}\
.plot .grid{stroke:var(--rule);stroke-width:1}\
.plot .frame{fill:none;stroke:var(--faint);stroke-width:1}\
.plot .curve{fill:none;stroke-width:1.8;stroke-linejoin:round}\
.plot .theory{fill:none;stroke-width:1.3;stroke-dasharray:5 4}\
.plot .mark{stroke-width:1.6}";

/// A plot as an element of a page that has the styles `COLOURS` and `PLOT_STYLE`.
pub fn inline(plot: &Plot) -> String {
    draw(plot, "")
}

/// A plot as a file of its own.
pub fn standalone(plot: &Plot) -> String {
    let ground = format!(
        "<style>{COLOURS}{PLOT_STYLE}</style><rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"var(--ground)\"/>"
    );
    draw(plot, &ground)
}

fn draw(plot: &Plot, ground: &str) -> String {
    let values =
        |part: usize| plot.series.iter().flat_map(move |series| series.points.iter().map(move |point| point[part]));
    let spans = [Span::around(&plot.x, values(0)), Span::around(&plot.y, values(1))];
    let mut svg = format!(
        "<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{}\">{ground}",
        escaped(&plot.caption)
    );
    draw_axes(&mut svg, plot, spans);
    let hidden: usize =
        plot.series.iter().enumerate().map(|(index, series)| draw_series(&mut svg, series, index, spans)).sum();
    draw_legend(&mut svg, plot, hidden);
    svg.push_str("</svg>");
    svg
}

fn draw_axes(svg: &mut String, plot: &Plot, [x, y]: [Span; 2]) {
    for value in x.ticks() {
        let Some(at) = x.share(value).map(across) else { continue };
        put(svg, format_args!("<line class=\"grid\" x1=\"{at:.1}\" y1=\"{TOP}\" x2=\"{at:.1}\" y2=\"{BOTTOM}\"/>"));
        let below = BOTTOM + 18.0;
        put(
            svg,
            format_args!(
                "<text class=\"faint\" x=\"{at:.1}\" y=\"{below}\" text-anchor=\"middle\">{}</text>",
                tick(value)
            ),
        );
    }
    for value in y.ticks() {
        let Some(at) = y.share(value).map(upward) else { continue };
        put(svg, format_args!("<line class=\"grid\" x1=\"{LEFT}\" y1=\"{at:.1}\" x2=\"{RIGHT}\" y2=\"{at:.1}\"/>"));
        let [beside, lower] = [LEFT - 8.0, at + 4.0];
        put(
            svg,
            format_args!(
                "<text class=\"faint\" x=\"{beside}\" y=\"{lower:.1}\" text-anchor=\"end\">{}</text>",
                tick(value)
            ),
        );
    }
    let [width, height] = [RIGHT - LEFT, BOTTOM - TOP];
    put(svg, format_args!("<rect class=\"frame\" x=\"{LEFT}\" y=\"{TOP}\" width=\"{width}\" height=\"{height}\"/>"));
    let [middle, below] = [0.5 * (LEFT + RIGHT), BOTTOM + 42.0];
    put(svg, format_args!("<text x=\"{middle}\" y=\"{below}\" text-anchor=\"middle\">{}</text>", title(&plot.x)));
    let middle = 0.5 * (TOP + BOTTOM);
    put(
        svg,
        format_args!(
            "<text x=\"16\" y=\"{middle}\" text-anchor=\"middle\" transform=\"rotate(-90 16 {middle})\">{}</text>",
            title(&plot.y)
        ),
    );
}

fn title(axis: &Axis) -> String {
    if axis.unit.is_empty() { escaped(&axis.label) } else { escaped(&format!("{} [{}]", axis.label, axis.unit)) }
}

/// Draws a curve; gives the number of its points that the axes cannot show.
fn draw_series(svg: &mut String, series: &Series, index: usize, [x, y]: [Span; 2]) -> usize {
    let shown: Vec<[f64; 2]> = series
        .points
        .iter()
        .filter_map(|point| Some([across(x.share(point[0])?), upward(y.share(point[1])?)]))
        .collect();
    let colour = index % COLOUR_COUNT;
    if series.style != SeriesStyle::Marks && shown.len() > 1 {
        let class = if series.style == SeriesStyle::Line { "theory" } else { "curve" };
        let path: Vec<String> = shown.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        put(
            svg,
            format_args!("<polyline class=\"{class}\" stroke=\"var(--c{colour})\" points=\"{}\"/>", path.join(" ")),
        );
    }
    if series.style != SeriesStyle::Line {
        for place in &shown {
            draw_mark(svg, *place, index);
        }
    }
    series.points.len() - shown.len()
}

/// Marks differ in shape as well as in colour, for prints without colours.
fn draw_mark(svg: &mut String, [x, y]: [f64; 2], index: usize) {
    let colour = index % COLOUR_COUNT;
    // The outline in the colour, the inside too, but for every second shape.
    let fill = if index.is_multiple_of(2) { format!("var(--c{colour})") } else { "none".to_owned() };
    let style = format!("class=\"mark\" stroke=\"var(--c{colour})\" fill=\"{fill}\"");
    match (index + index / COLOUR_COUNT) % 4 {
        0 => put(svg, format_args!("<circle {style} cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>")),
        1 => put(
            svg,
            format_args!("<rect {style} x=\"{:.1}\" y=\"{:.1}\" width=\"6.6\" height=\"6.6\"/>", x - 3.3, y - 3.3),
        ),
        2 => put(svg, format_args!("<path {style} d=\"M{x:.1} {:.1}l4.4 4.4l-4.4 4.4l-4.4 -4.4z\"/>", y - 4.4)),
        _ => put(svg, format_args!("<path {style} d=\"M{x:.1} {:.1}l4.2 7.2h-8.4z\"/>", y - 4.6)),
    }
}

fn draw_legend(svg: &mut String, plot: &Plot, hidden: usize) {
    let [start, text] = [RIGHT + 14.0, RIGHT + 42.0];
    let mut y = TOP + 10.0;
    for (index, series) in plot.series.iter().enumerate() {
        let middle = y - 4.0;
        if series.style != SeriesStyle::Marks {
            let class = if series.style == SeriesStyle::Line { "theory" } else { "curve" };
            let [end, colour] = [(start + 22.0).to_string(), (index % COLOUR_COUNT).to_string()];
            put(
                svg,
                format_args!(
                    "<line class=\"{class}\" stroke=\"var(--c{colour})\" x1=\"{start}\" y1=\"{middle}\" x2=\"{end}\" y2=\"{middle}\"/>"
                ),
            );
        }
        if series.style != SeriesStyle::Line {
            draw_mark(svg, [start + 11.0, middle], index);
        }
        for line in wrapped(&series.name) {
            put(svg, format_args!("<text x=\"{text}\" y=\"{y}\">{}</text>", escaped(&line)));
            y += LEGEND_LINE - 5.0;
        }
        y += 5.0;
    }
    if hidden > 0 {
        put(
            svg,
            format_args!("<text class=\"faint\" x=\"{start}\" y=\"{y}\">not shown: {hidden} points at zero</text>"),
        );
    }
}

/// A name in lines that fit the legend.
fn wrapped(name: &str) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in name.split_whitespace() {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && lines[last].chars().count() + 1 + word.chars().count() > LEGEND_LETTERS {
            lines.push(word.to_owned());
        } else {
            let space = if lines[last].is_empty() { "" } else { " " };
            lines[last] = format!("{}{space}{word}", lines[last]);
        }
    }
    lines
}

fn across(share: f64) -> f64 {
    LEFT + share * (RIGHT - LEFT)
}

fn upward(share: f64) -> f64 {
    BOTTOM - share * (BOTTOM - TOP)
}

fn put(svg: &mut String, part: std::fmt::Arguments<'_>) {
    svg.write_fmt(part).expect("a text takes every letter");
}
