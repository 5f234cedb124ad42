//! Garments placed for another body follow the landmarks of this one.

use super::FitError;
use super::figure::Figure;
use super::finding::Finding;
use super::laid::Laid;
use glam::{DVec2, DVec3};
use toile_scene::Garment;

/// A garment whose landmark is at most so far from that of the body, by its height [1], was placed for it.
const TOLERANCE: f64 = 0.05;
/// A neckline lies so far below the narrowest place of the neck, by the height [1].
const NECKLINE_DROP: f64 = 0.034;
/// A garment whose middle is at most so far beside that of the body [m] was placed around it.
const BESIDE: f64 = 0.25;
/// A garment wider than that [m] is no garment around a middle.
const WIDTH: f64 = 2.5;

/// Moves a garment as a whole to where the body has its neck or waist, and around its middle, where it was placed for another one.
///
/// # Errors
/// [`FitError::Height`] when it would be above or below the body.
pub(crate) fn follow(garment: &mut Garment, laid: &[Laid], figure: &Figure) -> Result<Option<Finding>, FitError> {
    let bounds = laid.iter().zip(&garment.panels).filter_map(|(laid, panel)| laid.bounds(panel));
    let Some([low, high]) = bounds.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]) else { return Ok(None) };
    let height = figure.height();
    let mut way = DVec3::ZERO;
    let mut landmark = "middle";
    let neckline = label_height(garment, "collar").map(|own| ("neck", figure.neck - NECKLINE_DROP * height - own));
    let waistline = || label_height(garment, "lower_interface").map(|own| ("waist", figure.waist - own));
    if let Some((name, rise)) = neckline.or_else(waistline)
        && rise.abs() > TOLERANCE * height
    {
        way.y = rise;
        landmark = name;
    }
    let beside = figure.middle - DVec2::new(0.5 * (low.x + high.x), 0.5 * (low.z + high.z));
    if beside.length() > BESIDE && (high - low).with_y(0.0).max_element() < WIDTH {
        way += DVec3::new(beside.x, 0.0, beside.y);
    }
    if low.y + way.y > figure.high || high.y + way.y < figure.low {
        return Err(FitError::Height {
            garment: garment.name.clone(),
            low: low.y,
            high: high.y,
            body_low: figure.low,
            body_high: figure.high,
        });
    }
    if way == DVec3::ZERO {
        return Ok(None);
    }
    garment.panels.iter_mut().for_each(|panel| panel.placement.translation += way);
    Ok(Some(Finding::MovedGarment { garment: garment.name.clone(), way: way.to_array(), landmark }))
}

/// Mean height of the edges whose label has a word in it [m].
fn label_height(garment: &Garment, word: &str) -> Option<f64> {
    let (mut sum, mut length) = (0.0, 0.0);
    for panel in &garment.panels {
        for (index, edge) in panel.edges.iter().enumerate() {
            if !edge.label.as_ref().is_some_and(|label| label.contains(word)) {
                continue;
            }
            for ends in panel.polyline(index, 1e-3).windows(2) {
                let [a, b] = [ends[0], ends[1]].map(|end| panel.placement.world(end));
                sum += a.distance(b) * 0.5 * (a.y + b.y);
                length += a.distance(b);
            }
        }
    }
    (length > 0.0).then(|| sum / length)
}
