//! Error of a draped shape as the mesh is refined.

use crate::experiments::rest::{RestScene, RestSettings, come_to_rest};
use crate::page::{Axis, Block, Cell, Plot, Series, SeriesStyle, Table};
use toile_lab::Distance;
use toile_lab::{Lab, LabError};

/// How far the rest shape of each mesh is from that of the last one [m], where both have a particle; `sizes` are the particles on a side.
pub fn shape_errors(
    lab: &mut Lab,
    scene: RestScene,
    sizes: &[u32],
    progress: [f64; 2],
) -> Result<Vec<Distance>, LabError> {
    let mut shapes = Vec::new();
    for (index, &n) in sizes.iter().enumerate() {
        // A mesh of twice the particles on a side takes the longer, the larger it is.
        let share = f64::from(1 << index) / f64::from(1 << sizes.len());
        lab.say(progress[0] + (progress[1] - progress[0]) * share, &format!("rest shape of {n} × {n} particles"))?;
        shapes.push((n, come_to_rest(lab, scene, RestSettings::new(n))?.positions));
    }
    let Some((fine_n, fine)) = shapes.pop() else { return Ok(Vec::new()) };
    Ok(shapes.iter().map(|(n, coarse)| Distance::between_meshes(coarse, *n, &fine, fine_n)).collect())
}

pub(super) fn blocks(lab: &mut Lab, progress: [f64; 2]) -> Result<Vec<Block>, LabError> {
    let sizes: &[u32] = lab.pick(&[5, 9, 17], &[9, 17, 33, 65]);
    let finest = sizes[sizes.len() - 1];
    let middle = 0.5 * (progress[0] + progress[1]);
    let scenes = [
        ("hammock", RestScene::Hammock, 500.0, [progress[0], middle]),
        ("cap", RestScene::Cap, 400.0, [middle, progress[1]]),
    ];
    let scenes = &scenes[..lab.pick(1, 2)];
    let told: Vec<&str> = scenes.iter().map(|(_, scene, ..)| scene.description()).collect();
    let caption = format!(
        "Error of a rest shape as the mesh is refined, against that of {finest} × {finest} particles: {}. 0.2 kg/m², springs of 20, 10 and 2 \
         N/m at every spacing, threshold 5 %, two sweeps of hierarchical limits, 960 steps per second. {}",
        told.join("; "),
        lab.place()
    );
    let columns = [["scene", ""], ["spacing", "mm"], ["error, mean", "mm"], ["error, farthest", "mm"], ["order", "1"]];
    let figures = format!("The figures of the plot above: error of the rest shape by spacing. {}", lab.place());
    let mut table = Table::new(figures, &columns);
    let mut series = Vec::new();
    for (name, scene, side, part) in scenes.iter().copied() {
        let mut points: Vec<[f64; 2]> = Vec::new();
        for (error, n) in shape_errors(lab, scene, sizes, part)?.iter().zip(sizes) {
            let spacing = side / f64::from(n - 1);
            let order = points.last().map(|[_, last]| (last / (1e3 * error.rms)).log2());
            points.push([spacing, 1e3 * error.rms]);
            table.push(vec![
                Cell::text(name),
                Cell::number(spacing),
                Cell::number(1e3 * error.rms),
                Cell::number(1e3 * error.max),
                Cell::number_or_missing(order),
            ]);
        }
        series.push(Series::new(name, SeriesStyle::LineAndMarks, points));
    }
    if let Some(&[from, error]) = series[0].points.first() {
        let to = series[0].points[series[0].points.len() - 1][0];
        let through = |order: i32| [[from, error], [to, error * (to / from).powi(order)]];
        series.push(Series::new("order 1", SeriesStyle::Line, through(1)));
        series.push(Series::new("order 2: differences of second order", SeriesStyle::Line, through(2)));
    }
    let plot = Plot { caption, x: Axis::log("spacing", "mm"), y: Axis::log("position error, mean", "mm"), series };
    Ok(vec![Block::Plot(plot), Block::Table(table)])
}
