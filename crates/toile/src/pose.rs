//! In which pose a body is dressed, and its way from there to the start of its motion.

use toile_model::{Inside, Model};
use toile_scene::{Mesh, MovingMesh};

/// Time in which a dressed body goes over to the start of its motion [s].
pub(crate) const WAY_SECONDS: f64 = 1.0;

/// The way from the pose without any clip to the start of the motion, where that pose stands clear of the panels and the first pose of
/// the motion does not; `None` where the body is dressed as its motion begins. Patterns are placed around a body that stands still: a leg
/// that strides would stand in front of them, and the garment would be sewn behind it.
pub(crate) fn way_from_rest<'a>(
    body: &MovingMesh,
    open: impl Iterator<Item = &'a Model> + Clone,
) -> Option<MovingMesh> {
    let resting = body.at_rest()?;
    let first = inside_count(&body.mesh, open.clone());
    if first == 0 || inside_count(&resting.mesh, open) >= first {
        return None;
    }
    MovingMesh::transition(&resting, body, WAY_SECONDS)
}

/// Particles of the panels, as they are placed, that are inside a body.
fn inside_count<'a>(body: &Mesh, open: impl Iterator<Item = &'a Model>) -> usize {
    let inside = Inside::of(body);
    open.flat_map(|model| &model.positions).filter(|place| inside.holds(place.as_dvec3())).count()
}
