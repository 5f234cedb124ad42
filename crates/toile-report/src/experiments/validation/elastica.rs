//! The cantilever that its own weight bends, against the heavy elastica: what a bending rigidity means.

use super::laws::settings;
use crate::page::{Axis, Block, Cell, Plot, Series, SeriesStyle, Table};
use glam::DVec2;
use toile::model::{Model, StepSettings};
use toile::scene::{Pin, Rule, Sheet};
use toile_lab::{Lab, LabError, settled};

/// G = w·L³/B and the angle of the tip below the level [degrees]: the heavy elastica.
pub const ELASTICAS: [[f64; 2]; 4] = [[1.0, 9.460], [4.0, 33.724], [8.0, 53.865], [16.0, 72.207]];

/// Free length [m].
const LENGTH: f64 = 1.0;

/// What resists bending.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Flexion {
    /// A bending rigidity [N·m].
    Rigidity(f64),
    /// The papers' springs alone, of a stiffness [N/m].
    Springs(f64),
}

/// Weight per area of the strip [N/m²].
pub const WEIGHT: f64 = 0.2 * 9.81;

/// Angle of the tip below the level [degrees] of a strip of 1 m, held level at one end, so many cells long, at rest under
/// its own weight; no rule. It is clamped half a cell before the last held particle, because the hinge there stands for a whole cell.
/// NaN when it diverges.
///
/// # Panics
/// When the step of the strip does not carry its rigidity.
pub fn cantilever_tip(flexion: Flexion, cells: u32) -> f64 {
    let mut settings = settings(Rule::None);
    // The push of a rigidity resists like a stiffness that grows with the square of the cells; links that are softer give a step that is too long.
    settings.fabric.structural_stiffness = 1500.0 * (f64::from(cells) / 16.0).powi(2).max(1.0);
    settings.fabric.shear_stiffness = 300.0;
    (settings.fabric.bend_stiffness, settings.fabric.bending_rigidity) = match flexion {
        Flexion::Rigidity(rigidity) => (150.0, rigidity),
        Flexion::Springs(stiffness) => (stiffness, 0.0),
    };
    settings.fabric.damping = 12.0;
    let cell = LENGTH / (f64::from(cells) + 0.5);
    let columns = cells + 2;
    let mut sheet = Sheet::new("strip", [columns, 3], DVec2::new(cell * f64::from(columns - 1), 2.0 * cell));
    sheet.pins = [0, 1].iter().flat_map(|&column| [0, 1, 2].map(|row| Pin { column, row })).collect();
    let model = Model::from_sheet(&sheet, &settings);
    assert!(model.bending_carried > 0.999, "the step of this strip carries its rigidity");
    let step = StepSettings::new(&settings, &model);
    let Some(end) = settled(&model, &step, Default::default(), 150) else { return f64::NAN };
    let positions = end.positions();
    let last = (2 * columns - 1) as usize;
    let tip = positions[last] - positions[last - 1];
    f64::from((-tip.y).atan2(tip.x).to_degrees())
}

/// Tables and plot.
pub(super) fn blocks(lab: &mut Lab) -> Result<Vec<Block>, LabError> {
    let cells = lab.pick(vec![8, 16], vec![8, 16, 32]);
    let caption = String::from(
        "A strip of 1 m is held level at one end and bends under its own weight w = 1.96 N/m². Angle of the tip against that of the heavy elastica \
         for G = w·L³/B, with the bending rigidity B given to the fabric; no rule, at rest. Reference on the CPU.",
    );
    let columns =
        &[["G", "1"], ["B", "N·m"], ["cells", ""], ["tip, measured", "°"], ["tip, elastica", "°"], ["error", "°"]];
    let mut table = Table::new(caption.clone(), columns);
    let mut series = vec![Series::new("elastica", SeriesStyle::Line, ELASTICAS)];
    for cells in cells {
        let mut measured = Vec::new();
        for [g, angle] in ELASTICAS {
            lab.say(0.4, &format!("cantilever of {cells} cells, G = {g}"))?;
            let rigidity = WEIGHT * LENGTH.powi(3) / g;
            let found = cantilever_tip(Flexion::Rigidity(rigidity), cells);
            measured.push([g, found]);
            let [g, rigidity, found, angle, error] = [g, rigidity, found, angle, found - angle].map(Cell::number);
            table.push(vec![g, rigidity, Cell::Count(u64::from(cells)), found, angle, error]);
        }
        series.push(Series::new(format!("{cells} cells"), SeriesStyle::LineAndMarks, measured));
    }
    let plot = Plot { caption, x: Axis::log("G = w·L³/B", "1"), y: Axis::linear("angle of the tip", "°"), series };
    let caption = String::from(
        "The same strip with the papers' flexion springs of 1500 N/m alone, without a bending rigidity: the finer the mesh, the less they resist. Reference on the CPU.",
    );
    let mut papers = Table::new(caption, &[["cells", ""], ["spacing", "mm"], ["tip", "°"]]);
    for cells in [8, 16] {
        let tip = cantilever_tip(Flexion::Springs(1500.0), cells);
        papers.push(vec![
            Cell::Count(u64::from(cells)),
            Cell::number(1e3 * LENGTH / (f64::from(cells) + 0.5)),
            Cell::number(tip),
        ]);
    }
    let theory = "What a flexion spring does. It spans two cells of length h and is 2h long in the flat cloth. When the cloth turns by θ \
        there, it gets shorter by h·θ²/4, so its energy is k·h²·θ⁴/32 and, with the curvature κ = θ/h, the moment per width is k·h⁴·κ³/8: \
        a rigidity of k·h⁴·κ²/8. It is none where the cloth is straight, and it falls with the fourth power of the spacing, so \
        no stiffness of the papers' springs is the rigidity that a laboratory measures. A spring that pushes in the flat cloth, held by the \
        sides that pull, does what is wanted: with the force P its energy is P·h·θ²/4, which is ½·B·κ² per area for P = 2·B/h. \
        So `bending_rigidity` of a fabric is B in N·m; it shifts rest lengths and costs nothing in a step. What remains: it acts along warp and \
        weft alone, so nothing resists twisting and the rigidity in the bias is half of that along the threads; and the step bounds it, \
        at the default of 16 steps per frame and 60 frames per second to about 6·10⁴·σ·h⁴ (σ areal density).";
    Ok(vec![Block::Text(theory.to_owned()), Block::Table(table), Block::Plot(plot), Block::Table(papers)])
}
