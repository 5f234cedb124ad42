//! Scenes that several experiments share.

use crate::LabError;
use glam::{DVec2, DVec3};
use toile::files::{BodyOptions, parse_body};
use toile::scene::{Fabric, Mesh, Pin, Settings, Shape, Sheet, Threshold};

const BODY: &[u8] = include_bytes!("../../../fixtures/bodies/walking_woman.glb");

/// The fabric of the sheets: soft springs, so that it is the limits that hold the stretch, and little damping, so that a low
/// elongation is not the work of the damping.
pub fn fabric() -> Fabric {
    Fabric {
        name: "sheet of the measurements".to_owned(),
        areal_density: 0.2,
        structural_stiffness: 20.0,
        shear_stiffness: 10.0,
        bend_stiffness: 2.0,
        bending_rigidity: 0.0,
        damping: 0.1,
        thickness: 0.005,
        friction: 0.3,
        threshold: Threshold::even(0.05),
    }
}

/// A sheet of 1 m × 1 m of n × n particles that starts flat and level, held at two corners of its edge z = 0.
pub fn hanging_sheet(n: u32) -> (Sheet, Settings) {
    let pins = vec![Pin { column: 0, row: 0 }, Pin { column: n - 1, row: 0 }];
    (square(n, 1.0, DVec3::ZERO, DVec3::Z, pins), Settings::new(fabric()))
}

/// A square sheet with its columns along x.
pub fn square(n: u32, side: f64, corner: DVec3, down: DVec3, pins: Vec<Pin>) -> Sheet {
    Sheet {
        name: "sheet".to_owned(),
        columns: n,
        rows: n,
        size: DVec2::splat(side),
        corner,
        right: DVec3::X,
        down,
        pins,
        fabric: None,
    }
}

/// Radius of [`ball`] [m].
pub const BALL_RADIUS: f64 = 0.25;

/// A sphere of radius 0.25 m around the origin.
pub fn ball() -> Shape {
    Shape::sphere(DVec3::ZERO, BALL_RADIUS)
}

/// The built-in body, arms away from the trunk.
///
/// # Errors
/// [`LabError::File`] when it cannot be read.
pub fn body() -> Result<Mesh, LabError> {
    let options = BodyOptions { clip: Some("apose_to_walk".to_owned()), ..Default::default() };
    Ok(parse_body(BODY, "walking_woman.glb", &options)?.mesh)
}
