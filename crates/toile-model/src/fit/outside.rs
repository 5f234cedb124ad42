//! Panels that are drawn with their outside in, seen by the way in which their neighbours are wound.

use super::finding::Finding;
use super::laid::Laid;
use glam::{DVec2, DVec3};
use toile_scene::{Curve, Edge, Garment, Panel, Seam};

/// How much one way of matching two edges must be shorter than the other [1] to tell how they run.
const CLEAR: f64 = 0.8;

/// Part of the cloth of a garment that must face the body [1] before all of it is taken for inside out.
const MOST: f64 = 0.5;

/// Turns the outside of panels out that their neighbours gainsay; out is away from the middle of the body, x and z [m].
///
/// Edges that are sewn run against each other where both panels show the same side. The panels that hang together so are one
/// cloth, whose outside is the side of which more faces away from the body.
pub(crate) fn turn(garment: &mut Garment, laid: &[Laid], middle: DVec2) -> Vec<Finding> {
    let count = garment.panels.len();
    let mut neighbours: Vec<Vec<(usize, bool)>> = vec![Vec::new(); count];
    for seam in &garment.seams {
        let [one, other] = seam.sides.map(|side| side.panel);
        if let Some(agrees) = agrees(garment, seam).filter(|_| one != other) {
            neighbours[one].push((other, agrees));
            neighbours[other].push((one, agrees));
        }
    }
    let mut side: Vec<Option<bool>> = vec![None; count];
    let mut findings = Vec::new();
    for first in 0..count {
        if side[first].is_some() {
            continue;
        }
        side[first] = Some(true);
        let (mut members, mut at, mut is_sound) = (vec![first], 0, true);
        while let Some(panel) = members.get(at).copied() {
            at += 1;
            for (neighbour, agrees) in &neighbours[panel] {
                let expected = side[panel].map(|side| side == *agrees);
                match side[*neighbour] {
                    None => {
                        side[*neighbour] = expected;
                        members.push(*neighbour);
                    }
                    // A cloth with one side alone, as a ribbon that is sewn with half a turn.
                    known => is_sound &= known == expected,
                }
            }
        }
        let away: f64 =
            members.iter().map(|panel| away(&garment.panels[*panel], &laid[*panel], middle) * sign(side[*panel])).sum();
        let all: f64 = members.iter().map(|panel| laid[*panel].area_of_all()).sum();
        let disagree = members.iter().any(|panel| side[*panel] != Some(true));
        let wrong = Some(away < 0.0);
        let is_clear = disagree || (away < 0.0 && members.len() > 1 && -away > MOST * all);
        for panel in members {
            if is_sound && is_clear && side[panel] == wrong {
                turn_over(garment, panel);
                findings.push(Finding::TurnedPanel {
                    garment: garment.name.clone(),
                    panel: garment.panels[panel].name.clone(),
                });
            }
        }
    }
    findings
}

fn sign(side: Option<bool>) -> f64 {
    if side == Some(true) { 1.0 } else { -1.0 }
}

/// Whether the panels of a seam show the same side; `None` where the placed edges do not tell.
fn agrees(garment: &Garment, seam: &Seam) -> Option<bool> {
    let ends = seam.sides.map(|side| {
        let panel = &garment.panels[side.panel];
        let next = (side.edge + 1) % panel.edges.len();
        [side.edge, next].map(|edge| panel.placement.world(panel.edges[edge].start))
    });
    let [[a0, a1], [b0, b1]] = ends;
    let along = a0.distance_squared(b0) + a1.distance_squared(b1);
    let against = a0.distance_squared(b1) + a1.distance_squared(b0);
    let is_clear = along.min(against) < CLEAR * along.max(against);
    is_clear.then_some((against < along) != seam.right_wrong)
}

/// Area of a panel [m²] that faces away from the middle of the body, less by how much it does not.
fn away(panel: &Panel, laid: &Laid, middle: DVec2) -> f64 {
    let way = laid.middle(panel) - DVec3::new(middle.x, 0.0, middle.y);
    let way = DVec2::new(way.x, way.z).normalize_or_zero();
    let facing = laid.facing(panel);
    laid.area_of_all() * way.dot(DVec2::new(facing.x, facing.z))
}

/// Draws a panel the other way around. Its edges keep their labels and seams.
fn turn_over(garment: &mut Garment, number: usize) {
    let panel = &mut garment.panels[number];
    let count = panel.edges.len();
    let reversed = |edge: usize| {
        let Edge { curve, label, .. } = panel.edges[edge].clone();
        let curve = match curve {
            Curve::Straight | Curve::Quadratic { .. } => curve,
            Curve::Cubic { controls: [first, second] } => Curve::Cubic { controls: [second, first] },
            Curve::Arc { radius, large, right } => Curve::Arc { radius, large, right: !right },
        };
        let mut edge = Edge::new(panel.edges[(edge + 1) % count].start, curve);
        edge.label = label;
        edge
    };
    panel.edges = (0..count).rev().map(reversed).collect();
    for side in garment.seams.iter_mut().flat_map(|seam| &mut seam.sides).filter(|side| side.panel == number) {
        side.edge = count - 1 - side.edge;
    }
}
