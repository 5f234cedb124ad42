//! The bounds within which settings must not change the answer.

use crate::lab;
use toile_report::experiments::rest::{RestScene, RestSettings, come_to_rest};
use toile_report::experiments::settings::{Change, moved_by};

/// The farthest that any particle moves under each change [m], with 5 × 5 particles.
fn moved(scene: RestScene, changes: &[Change]) -> Vec<f64> {
    let settings = RestSettings::new(5);
    let rest = come_to_rest(&lab(), scene, settings).expect("the device answers");
    assert!(rest.speed < 2e-3, "it rests: {rest:?}");
    let of = |change| moved_by(&lab(), scene, settings, &rest, change).expect("the device answers").0.max;
    changes.iter().copied().map(of).collect()
}

/// A hammock has one rest shape. A run ends at 2 mm/s, with a fraction of a millimetre to go; a chord of 12.5 cm in its arc is off by
/// a few millimetres.
#[test]
fn settings_do_not_move_a_hammock() {
    let changes = [(Change::FrameRate, 2e-4), (Change::Step, 3e-4), (Change::Sweeps, 3e-4), (Change::Resolution, 5e-3)];
    let ways = moved(RestScene::Hammock, &changes.map(|(change, _)| change));
    for ((change, bound), way) in changes.iter().zip(&ways) {
        assert!(way < bound, "{change:?}: {way} m");
    }
    assert!(ways[3] > 1e-4, "another mesh is seen: {} m", ways[3]);
}

/// Friction lets a cloth on a body rest where it happens to stop, within two millimetres.
#[test]
fn half_the_step_hardly_moves_a_cloth_on_a_sphere() {
    let way = moved(RestScene::Cap, &[Change::Step])[0];
    assert!(way < 2e-3, "{way} m");
}
