//! The pages of a report that is made up.

use toile_lab::Scale;
use toile_report::page::{
    self, Axis, Block, Cell, Page, Plot, Report, Section, Series, SeriesStyle, Table, compare, html, markdown,
};

fn report() -> Report {
    let mut table =
        Table::new("A sheet on Adapter X; seed 7.", &[["rule", ""], ["n", ""], ["error", "mm"], ["order", "1"]]);
    table.push(vec![Cell::text("none"), Cell::Count(65_536), Cell::number(f64::NAN), Cell::Missing]);
    table.push(vec![Cell::text("a | b"), Cell::Count(9), Cell::number(0.012_345), Cell::number(1.999)]);
    let curve = |name: &str, style, points: &[[f64; 2]]| Series::new(name, style, points.iter().copied());
    let plot = Plot {
        caption: "Error against step & \"cost\" <on Adapter X>.".to_owned(),
        x: Axis::log("step", "ms"),
        y: Axis::linear("error", "mm"),
        series: vec![
            curve("measured", SeriesStyle::LineAndMarks, &[[1.0, 2.0], [10.0, 20.0], [f64::INFINITY, 1.0], [0.0, 3.0]]),
            curve("order 1", SeriesStyle::Line, &[[1.0, 2.0], [10.0, 20.0]]),
            curve("alone", SeriesStyle::Marks, &[[2.0, 5.0]]),
        ],
    };
    let section = Section {
        name: "steps".to_owned(),
        title: "Steps & errors".to_owned(),
        lead: "What < a step costs.".to_owned(),
        blocks: vec![Block::Plot(plot), Block::Text("One paragraph.\n\nAnother.".to_owned()), Block::Table(table)],
    };
    let empty =
        Section { name: "other".to_owned(), title: "Other".to_owned(), lead: String::new(), blocks: Vec::new() };
    Report {
        adapter: "Adapter X".to_owned(),
        version: "1.2.3".to_owned(),
        scale: Scale::Quick,
        seed: 7,
        sections: vec![section, empty],
    }
}

#[test]
fn markdown_of_a_small_report() {
    let (text, plots) = markdown(&Page::from(&report()), "report");
    assert_eq!(plots.len(), 1);
    assert!(text.contains(&format!("({})", plots[0].0)), "the plot is linked");
    insta::assert_snapshot!(text);
}

#[test]
fn a_report_is_the_same_after_json() {
    let report = report();
    assert_eq!(page::parse(&page::json(&report)).expect("its own JSON"), report);
    assert!(page::parse("{}").is_err_and(|error| error.to_string().contains("adapter")));
}

#[test]
fn the_page_is_well_formed_and_needs_no_other_file() {
    let text = html(&Page::from(&report()));
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    let document = roxmltree::Document::parse_with_options(&text, options).unwrap_or_else(|error| panic!("{error}"));
    let count = |name: &str| document.descendants().filter(|node| node.tag_name().name() == name).count();
    assert_eq!((count("svg"), count("table"), count("h2"), count("p")), (1, 1, 2, 5));
    for node in document.descendants() {
        let loads = node.attributes().find(|attribute| ["src", "srcset", "data"].contains(&attribute.name()));
        assert!(loads.is_none() && !["link", "script"].contains(&node.tag_name().name()), "{node:?}");
        // Every line of the contents leads somewhere.
        if let Some(target) = node.attribute("href") {
            let found = document.descendants().any(|other| other.attribute("id") == target.strip_prefix('#'));
            assert!(found, "{target}");
        }
    }
    assert!(text.contains("prefers-color-scheme:dark") && !text.contains("stroke=\"#"), "colours are variables");
}

#[test]
fn a_plot_says_what_its_axes_show_and_what_they_cannot() {
    let Block::Plot(plot) = &report().sections[0].blocks[0] else { panic!("the first block is a plot") };
    let text = page::standalone(plot);
    let document = roxmltree::Document::parse(&text).unwrap_or_else(|error| panic!("{error}"));
    let words: Vec<&str> = document
        .descendants()
        .filter(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "text")))
        .filter_map(|node| node.text())
        .collect();
    for expected in ["step [ms]", "error [mm]", "measured", "order 1", "10", "20", "not shown: 1 points at zero"] {
        assert!(words.contains(&expected), "{expected} in {words:?}");
    }
    for curve in document.descendants().filter(|node| node.has_attribute("points")) {
        let points = curve.attribute("points").expect("points").split([' ', ',']);
        assert!(points.map(|number| number.parse::<f64>().expect("a number")).all(|v| (0.0..760.0).contains(&v)));
    }
}

#[test]
fn two_reports_are_put_side_by_side() {
    let a = report();
    let mut b = report();
    b.adapter = "Adapter Y".to_owned();
    let text = page::json(&b).replace("Adapter X", "Adapter Y");
    b = page::parse(&text).expect("JSON");
    b.sections.remove(1);
    let Block::Table(table) = &mut b.sections[0].blocks[2] else { panic!("the last block is a table") };
    table.rows[0][2] = Cell::number(4.0);
    table.rows[1][2] = Cell::number(0.024_69);
    table.push(vec![Cell::text("new"), Cell::Count(1), Cell::Missing, Cell::Missing]);
    let compared = compare(&a, &b);
    assert_eq!(compared.sections[1].lead, "Only A has this section.");
    let [Block::Plot(plot), Block::Table(table), Block::Text(alone)] = compared.sections[0].blocks.as_slice() else {
        panic!("{compared:?}")
    };
    assert_eq!(plot.series.len(), 6);
    assert_eq!(alone, "Only B has the row new.");
    let shown: Vec<String> =
        table.rows.iter().map(|row| row.iter().map(Cell::shown).collect::<Vec<_>>().join(" · ")).collect();
    assert_eq!(
        shown,
        [
            "none, diverged · n · 65536 · 65536 · 1.00",
            "none, diverged · error [mm] · diverged · 4.00 · –",
            "a | b · n · 9 · 9 · 1.00",
            "a | b · error [mm] · 0.0123 · 0.0247 · 2.00",
            "a | b · order [1] · 2.00 · 2.00 · 1.00",
        ]
    );
}

/// Other columns, other axes or another caption are other figures.
#[test]
fn only_figures_of_the_same_kind_are_compared() {
    let a = report();
    let mut b = report();
    let [Block::Plot(plot), _, Block::Table(table)] = b.sections[0].blocks.as_mut_slice() else { panic!("its blocks") };
    plot.y.unit = "m".to_owned();
    table.columns[2].unit = "m".to_owned();
    let compared = compare(&a, &b);
    let words = compared.sections[0].blocks.iter().map(|block| match block {
        Block::Text(words) => words.split(':').next().unwrap_or_default(),
        _ => "a figure",
    });
    assert_eq!(words.collect::<Vec<_>>(), ["Only A has", "Only A has", "Only B has", "Only B has"]);
}
