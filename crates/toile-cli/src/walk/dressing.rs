//! In which pose a body is dressed, and its way from there to the start of the walk.

use anyhow::{Result, bail};
use toile::model::Model;
use toile::scene::{Garment, Mesh, MovingMesh, Settings};
use toile_reference::ExactDistance;

/// Time in which a dressed body goes over to the first pose of its walk [s].
const SECONDS: f64 = 1.0;

/// The way from the first pose of `from`, which moves by the clip of that name, to the start of the walk.
pub fn from_clip(from: &MovingMesh, clip: &str, body: &MovingMesh) -> Result<MovingMesh> {
    match MovingMesh::transition(from, body, SECONDS) {
        Some(way) => Ok(way),
        None => bail!("--dress-in {clip}: it moves other joints than --clip; choose a clip of the same body"),
    }
}

/// The way from the pose without any clip to the start of the walk, where that pose stands clear of the panels and the first pose of
/// the walk does not; `None` where the body is dressed as the walk begins. Patterns are placed around a body that stands still: a leg that
/// strides would stand in front of them, and the garment would be sewn behind it.
pub fn from_rest(body: &MovingMesh, garments: &[Garment], settings: &Settings) -> Result<Option<MovingMesh>> {
    let Some(resting) = body.at_rest() else { return Ok(None) };
    let first = deep_count(&body.mesh, garments, settings)?;
    if first == 0 || deep_count(&resting.mesh, garments, settings)? >= first {
        return Ok(None);
    }
    Ok(MovingMesh::transition(&resting, body, SECONDS))
}

/// Particles of the panels, as they are placed, that are inside a body.
fn deep_count(body: &Mesh, garments: &[Garment], settings: &Settings) -> Result<usize> {
    let exact = ExactDistance::new(body);
    let mut count = 0;
    for garment in garments {
        let open = Model::from_garment(garment, settings)?;
        count += open.positions.iter().filter(|place| exact.penetration(place.as_dvec3()) > 0.0).count();
    }
    Ok(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use toile::files::{BodyOptions, read_garment, read_moving_body};
    use toile::scene::Fabric;

    fn way(clip: &str) -> Option<MovingMesh> {
        let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
        let options = BodyOptions { clip: Some(clip.to_owned()), ..BodyOptions::default() };
        let body = read_moving_body(&fixtures.join("bodies/walking_woman.glb"), &options).expect("a body").body;
        let garment = read_garment(&fixtures.join("garments/skirt.json")).expect("a garment");
        let settings = Settings { spacing: 0.03, ..Settings::new(Fabric::preset("cotton").expect("a preset")) };
        let way = from_rest(&body, &[garment], &settings).expect("the skirt meshes");
        if let Some(way) = &way {
            let end = way.at(way.duration()).positions;
            let far = end.iter().zip(&body.mesh.positions).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            assert!(far < 1e-5, "the way ends {far} m from the start of the walk");
        }
        way
    }

    #[test]
    fn a_striding_body_is_dressed_at_rest_and_one_that_stands_clear_is_not() {
        assert!(way("walk_loop").is_some());
        assert!(way("apose_to_walk").is_none());
    }
}
