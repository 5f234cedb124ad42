//! Scenes that several experiments share.

use crate::LabError;
use glam::{DVec2, DVec3};
use toile::files::{BodyOptions, parse_body};
use toile::scene::{Fabric, Mesh, Pin, Settings, Shape, Sheet, Threshold};

const BODY: &[u8] = include_bytes!("../../../fixtures/bodies/walking_woman.glb");

/// The fabric of the sheets: soft springs, so that it is the limits that hold the stretch, and little damping, so that a low
/// elongation is not the work of the damping.
pub fn fabric() -> Fabric {
    let mut fabric = Fabric::preset("cotton").expect("a preset");
    fabric.name = "sheet of the measurements".to_owned();
    fabric.areal_density = 0.2;
    fabric.structural_stiffness = 20.0;
    fabric.shear_stiffness = 10.0;
    fabric.bend_stiffness = 2.0;
    fabric.bending_rigidity = 0.0;
    fabric.damping = 0.1;
    fabric.thickness = 0.005;
    fabric.friction = 0.3;
    fabric.threshold = Threshold::even(0.05);
    fabric
}

/// A sheet of 1 m × 1 m of n × n particles that starts flat and level, held at two corners of its edge z = 0.
pub fn hanging_sheet(n: u32) -> (Sheet, Settings) {
    let pins = vec![Pin { column: 0, row: 0 }, Pin { column: n - 1, row: 0 }];
    (square(n, 1.0, DVec3::ZERO, DVec3::Z, pins), Settings::new(fabric()))
}

/// A square sheet with its columns along x.
pub fn square(n: u32, side: f64, corner: DVec3, down: DVec3, pins: Vec<Pin>) -> Sheet {
    let mut sheet = Sheet::new("sheet", [n, n], DVec2::splat(side));
    sheet.corner = corner;
    sheet.down = down;
    sheet.pins = pins;
    sheet
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
    let mut options = BodyOptions::default();
    options.clip = Some("apose_to_walk".to_owned());
    Ok(parse_body(BODY, "walking_woman.glb", &options)?.mesh)
}
