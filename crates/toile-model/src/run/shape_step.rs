//! A shape as one step meets it.

use crate::StepSettings;
use glam::{DVec3, Vec3};
use toile_scene::{Form, Shape};

/// A shape as one step meets it: where it stands at the start, going straight on to the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeStep {
    /// What it is.
    pub kind: ShapeKind,
    /// Centre at the start of the step [m].
    pub centre: Vec3,
    /// Radius with the thickness of the cloth added [m].
    pub radius: f32,
    /// Velocity of the centre over the step [m/s].
    pub velocity: Vec3,
    /// Angular velocity [rad/s].
    pub spin: Vec3,
    /// At the start of the step: of a capsule from the centre to one of its ends [m], of a plane the unit normal; of a box half of its extents without the
    /// rounding, along its own axes [m]; zero of a sphere.
    pub axis: Vec3,
    /// Unit directions of the first two axes of a box at the start of the step; the axes themselves of all others.
    pub turn: [Vec3; 2],
}

/// What a shape is; its number is that in the kernels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeKind {
    /// A sphere.
    Sphere = 0,
    /// A capsule.
    Capsule = 1,
    /// A plane.
    Plane = 2,
    /// A box.
    Box = 3,
}

impl ShapeStep {
    /// A shape during step `step`; 0 is the first.
    pub fn of(shape: &Shape, step: u64, settings: &StepSettings) -> Self {
        let dt = f64::from(settings.dt);
        let [start, end] = [step, step + 1].map(|step| shape.at(step as f64 * dt).0);
        let (kind, radius, axis) = match shape.form {
            Form::Sphere { radius } => (ShapeKind::Sphere, radius, DVec3::ZERO),
            Form::Capsule { half_axis, radius } => (ShapeKind::Capsule, radius, half_axis),
            Form::Plane { normal } => (ShapeKind::Plane, 0.0, normal),
            Form::Box { half_size, radius, .. } => (ShapeKind::Box, radius, half_size - radius),
        };
        let turn = shape.turn(step as f64 * dt);
        let (axis, turn) = match shape.form {
            Form::Box { rotation, .. } => (axis, [DVec3::X, DVec3::Y].map(|axis| turn * rotation * axis)),
            _ => (turn * axis, [DVec3::X, DVec3::Y]),
        };
        Self {
            kind,
            centre: start.as_vec3(),
            radius: radius as f32 + settings.thickness,
            velocity: ((end - start) / dt).as_vec3(),
            axis: axis.as_vec3(),
            turn: turn.map(|axis| axis.as_vec3()),
            spin: shape.spin(step as f64 * dt).as_vec3(),
        }
    }
}
