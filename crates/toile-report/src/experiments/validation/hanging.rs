//! Cloth that hangs: the strip that its own weight stretches, and the catenary.

use super::laws::settings;
use crate::page::{Axis, Block, Cell, Plot, Series, SeriesStyle, Table};
use glam::{DVec2, DVec3};
use toile::model::{Model, StepSettings};
use toile::scene::{Pin, Rule, Settings, Sheet};
use toile_lab::{Lab, LabError, settled};

/// Span by length, and sag by length: roots of the catenary's equations.
pub const CATENARIES: [[f64; 2]; 4] = [[0.5, 0.398194], [0.8, 0.265438], [0.9, 0.190709], [0.95, 0.135898]];

/// A strip of 0.5 m that hangs from its upper edge, and what its own weight stretches it by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HangingStrip {
    /// Elongation of the uppermost spring [1].
    pub top: f64,
    /// What theory says of it [1]: the weight below by the stiffness, w·L/k.
    pub theory: f64,
    /// Largest difference of any spring's elongation from the weight below it, in parts of `theory` [1].
    pub error: f64,
}

/// Hangs a strip of five columns and so many rows, structural springs alone, no rule, and measures its middle column at rest.
/// `None` when it diverges.
pub fn hanging_strip(rows: u32) -> Option<HangingStrip> {
    let mut settings = settings(Rule::None);
    settings.fabric.shear_stiffness = 0.0;
    settings.fabric.bend_stiffness = 0.0;
    settings.fabric.damping = 8.0;
    let cell = 0.5 / f64::from(rows - 1);
    let mut sheet = Sheet::new("strip", [5, rows], DVec2::new(4.0 * cell, 0.5));
    sheet.down = DVec3::NEG_Y;
    sheet.pins = (0..5).map(|column| Pin { column, row: 0 }).collect();
    let model = Model::from_sheet(&sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    let end = settled(&model, &step, Default::default(), 240)?;
    let positions: Vec<DVec3> = end.positions().iter().map(|p| p.as_dvec3()).collect();
    let weight = settings.fabric.areal_density * settings.gravity.length();
    // The particle at the lower end of a spring carries half a cell beyond itself, the last one none.
    let below = |row: u32| weight * cell * (f64::from(rows - 1 - row) - 0.5);
    let of = |row: u32| below(row) / settings.fabric.structural_stiffness;
    let elongation = |row: u32| {
        let [a, b] = [row, row + 1].map(|row| positions[(5 * row + 2) as usize]);
        a.distance(b) / cell - 1.0
    };
    let theory = weight * 0.5 / settings.fabric.structural_stiffness;
    let error = (0..rows - 1).map(|row| (elongation(row) - of(row)).abs()).fold(0.0, f64::max);
    Some(HangingStrip { top: elongation(0), theory, error: error / theory })
}

/// Sag by length [1] of a strip of 1 m between two held ends at `span` [m], so many cells long, no rule.
/// NaN when it diverges.
pub fn catenary_sag(span: f64, cells: u32) -> f64 {
    let mut settings: Settings = settings(Rule::None);
    // Stiff enough to stretch by less than a thousandth.
    settings.fabric.structural_stiffness = 300.0;
    settings.fabric.shear_stiffness = 0.0;
    settings.fabric.bend_stiffness = 0.0;
    settings.fabric.damping = 5.0;
    let cell = 1.0 / f64::from(cells);
    let end = cells;
    let mut sheet = Sheet::new("strip", [cells + 1, 2], DVec2::new(1.0, cell));
    sheet.pins = [0, end].iter().flat_map(|&column| [0, 1].map(|row| Pin { column, row })).collect();
    let model = Model::from_sheet(&sheet, &settings);
    // It starts as a V, which is as long as the cloth.
    let drop = (0.25 - 0.25 * span * span).sqrt();
    let hung = model.changed(|model| {
        for (i, position) in model.positions.iter_mut().enumerate() {
            let along = (i as u32 % (cells + 1)) as f64 * cell;
            position.x = (along * span) as f32;
            position.y = (-2.0 * drop * along.min(1.0 - along)) as f32;
        }
    });
    let model = hung.expect("particles at other places");
    let step = StepSettings::new(&settings, &model);
    let Some(end) = settled(&model, &step, Default::default(), 150) else { return f64::NAN };
    -f64::from(end.positions().iter().map(|p| p.y).fold(f32::INFINITY, f32::min))
}

/// Tables and plot.
pub(super) fn blocks(lab: &mut Lab) -> Result<Vec<Block>, LabError> {
    let caption = String::from(
        "A strip hangs from its upper edge: 0.5 m, 0.2 kg/m², structural springs of 20 N/m alone, no rule, at rest. Theory: the \
         uppermost spring is stretched by w·L/k, less half a cell, because a spring carries what lies below its middle. The error \
         is that of the worst spring against the weight below it, by w·L/k. Reference on the CPU.",
    );
    let columns = &[["rows", ""], ["top elongation", "1"], ["w·L/k", "1"], ["error of the worst spring", "1"]];
    let mut table = Table::new(caption, columns);
    for rows in lab.pick(vec![11, 21], vec![11, 21, 41]) {
        lab.say(0.25, &format!("hanging strip of {rows} rows"))?;
        let strip = hanging_strip(rows);
        let numbers = strip.map_or([f64::NAN; 3], |strip| [strip.top, strip.theory, strip.error]).map(Cell::number);
        table.push([Cell::Count(u64::from(rows))].into_iter().chain(numbers).collect());
    }
    let cells = lab.pick(32, 64);
    let caption = format!(
        "A strip of 1 m hangs between two held ends: sag by length against the catenary's. {cells} cells, 0.2 kg/m², structural \
         springs of 300 N/m alone, no rule, at rest after 2.5 s. Reference on the CPU."
    );
    let columns = &[["span by length", "1"], ["sag, measured", "1"], ["sag, catenary", "1"], ["error by length", "1"]];
    let mut catenary = Table::new(caption.clone(), columns);
    let mut measured = Vec::new();
    for [span, sag] in CATENARIES {
        lab.say(0.3, &format!("catenary of span {span}"))?;
        let found = catenary_sag(span, cells);
        measured.push([span, found]);
        catenary.push([span, found, sag, (found - sag).abs()].map(Cell::number).to_vec());
    }
    let plot = Plot {
        caption,
        x: Axis::linear("span by length", "1"),
        y: Axis::linear("sag by length", "1"),
        series: vec![
            Series::new("catenary", SeriesStyle::Line, CATENARIES),
            Series::new("measured", SeriesStyle::Marks, measured),
        ],
    };
    Ok(vec![Block::Table(table), Block::Table(catenary), Block::Plot(plot)])
}
