//! Sleeves follow the arms, however these are held.

use super::figure::Figure;
use super::finding::Finding;
use super::laid::Laid;
use super::section::Skin;
use glam::{DQuat, DVec3};
use toile_scene::{EdgeRef, Garment};

/// A sleeve that is turned against its arm by at most so much was placed for it [°].
const TOLERANCE: f64 = 25.0;
/// An arm that points forward or backward by more than this [1] has no sleeve that a turn in the plane of the panels would bring to it.
const FORWARD: f64 = 0.4;

/// A sleeve that does not lie along its arm.
pub(crate) struct Sleeve {
    /// Indices of its panels.
    panels: Vec<usize>,
    /// Where it hangs on the rest of the garment [m].
    pivot: DVec3,
    /// By how much it has to be raised [rad].
    raise: f64,
    is_left: bool,
}

impl Sleeve {
    /// The sleeves of a garment that do not lie along their arms.
    pub(crate) fn astray(garment: &Garment, laid: &[Laid], figure: &Figure, skin: &Skin) -> Vec<Self> {
        [true, false].into_iter().filter_map(|is_left| Self::of(garment, laid, figure, skin, is_left)).collect()
    }

    fn of(garment: &Garment, laid: &[Laid], figure: &Figure, skin: &Skin, is_left: bool) -> Option<Self> {
        let arm = figure.arm(skin, is_left)?.direction;
        let panels = panels(garment, laid, figure, is_left);
        let has = |side: &EdgeRef| panels.contains(&side.panel);
        let (mut pivot, mut armhole) = (DVec3::ZERO, 0.0);
        let mut along = DVec3::ZERO;
        let out = figure.out(is_left);
        for seam in &garment.seams {
            let [one, other] = &seam.sides;
            match (has(one), has(other)) {
                (true, true) => {
                    // Seams of a sleeve run along it, towards the hand or back.
                    let way = chord(garment, one);
                    along += if way.dot(out) >= 0.0 { way } else { -way };
                }
                (false, false) => {}
                (sleeve_first, _) => {
                    let [start, end] = ends(garment, if sleeve_first { other } else { one });
                    let length = start.distance(end);
                    pivot += length * start.midpoint(end);
                    armhole += length;
                }
            }
        }
        if armhole == 0.0 || arm.dot(forward(figure)).abs() > FORWARD {
            return None;
        }
        // In the plane across the body: how far each of the two is raised above level.
        let rise = |way: DVec3| way.y.atan2(way.dot(out));
        if along.length() < 1e-3 {
            return None;
        }
        let raise = rise(arm) - rise(along);
        (raise.abs() > TOLERANCE.to_radians()).then(|| Self { panels, pivot: pivot / armhole, raise, is_left })
    }

    /// Number of points of its panels.
    pub(crate) fn point_count(&self, garment: &Garment, laid: &[Laid]) -> usize {
        self.panels.iter().map(|panel| laid[*panel].places(&garment.panels[*panel]).count()).sum()
    }

    /// Turns its panels to the arm.
    pub(crate) fn turn(&self, garment: &mut Garment, figure: &Figure) -> Finding {
        // About the axis that the person faces along, towards which left turns up.
        let angle = if self.is_left { self.raise } else { -self.raise };
        let turn = DQuat::from_axis_angle(forward(figure), angle);
        for panel in &self.panels {
            let placement = &mut garment.panels[*panel].placement;
            placement.rotation = turn * placement.rotation;
            placement.translation = self.pivot + turn * (placement.translation - self.pivot);
        }
        Finding::TurnedSleeve {
            garment: garment.name.clone(),
            panels: self.panels.iter().map(|panel| garment.panels[*panel].name.clone()).collect(),
            arm: if self.is_left { "left arm" } else { "right arm" },
            degrees: self.raise.to_degrees(),
        }
    }
}

/// Indices of the panels of a sleeve. Panels with a collar are the trunk of a garment; its sleeves lie beyond them.
pub(crate) fn panels(garment: &Garment, laid: &[Laid], figure: &Figure, is_left: bool) -> Vec<usize> {
    let side = if is_left { 1.0 } else { -1.0 };
    let is_trunk: Vec<bool> = garment
        .panels
        .iter()
        .map(|panel| panel.edges.iter().any(|edge| edge.label.as_ref().is_some_and(|label| label.contains("collar"))))
        .collect();
    let trunk = garment.panels.iter().zip(laid).zip(&is_trunk).filter(|(_, is_trunk)| **is_trunk);
    let reach = trunk
        .flat_map(|((panel, laid), _)| laid.places(panel))
        .map(|place| side * figure.leftward(place))
        .fold(f64::NEG_INFINITY, f64::max);
    let is_beyond = |panel: &usize| {
        let middle = laid[*panel].middle(&garment.panels[*panel]);
        !is_trunk[*panel] && reach.is_finite() && side * figure.leftward(middle) > reach
    };
    (0..garment.panels.len()).filter(is_beyond).collect()
}

/// Where a person faces, +z where that is not known.
fn forward(figure: &Figure) -> DVec3 {
    figure.facing.map_or(DVec3::Z, |facing| DVec3::new(facing.x, 0.0, facing.y))
}

/// The ends of an edge as it is placed [m].
fn ends(garment: &Garment, side: &EdgeRef) -> [DVec3; 2] {
    let panel = &garment.panels[side.panel];
    [side.edge, (side.edge + 1) % panel.edges.len()].map(|edge| panel.placement.world(panel.edges[edge].start))
}

/// From the start of an edge to its end [m].
fn chord(garment: &Garment, side: &EdgeRef) -> DVec3 {
    let [start, end] = ends(garment, side);
    end - start
}
