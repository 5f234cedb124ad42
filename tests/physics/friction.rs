//! Coulomb's friction angle on a tilted plate: cloth sticks below atan(μ) and slides above, through the maps.

use toile_report::experiments::validation::friction::{Slide, coulomb_way, slide};
use toile_scene::Friction;
use toile_workspace::lab;

fn slid(degrees: f64, friction: Friction) -> Slide {
    slide(&lab(), degrees, friction).expect("the device answers")
}

#[test]
fn cloth_sticks_below_the_friction_angle() {
    for degrees in [10.0, 20.0, 25.0] {
        let Slide { way, off } = slid(degrees, Friction::Coulomb);
        assert!(way.abs() < 1e-3 && off < 1e-3, "{degrees}°: it slid {way} m and left the plate by {off} m");
    }
}

#[test]
fn cloth_slides_above_the_friction_angle() {
    for degrees in [29.0, 35.0, 45.0] {
        let Slide { way, off } = slid(degrees, Friction::Coulomb);
        let expected = coulomb_way(degrees);
        assert!((way / expected - 1.0).abs() < 0.05, "{degrees}°: it slid {way} m, not {expected} m");
        assert!(off < 1e-3, "{degrees}°: it left the plate by {off} m");
    }
}

/// The papers' law brakes but never holds: it creeps where Coulomb's sticks.
#[test]
fn the_papers_law_creeps() {
    let Slide { way, .. } = slid(20.0, Friction::Papers { velocity_kept: 0.8, force_removed: 0.5 });
    assert!(way > 1e-3, "it slid {way} m");
}
