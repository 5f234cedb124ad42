//! Bodies that are hard: already inside the cloth, or faster than it.

use super::case::{Case, Outcome, course};
use glam::{DQuat, DVec3, Vec3};
use toile::Colliders;
use toile::model::{Model, StepSettings};
use toile::scene::{Mesh, RigidKey, RigidMotion, Settings, Shape, ShapeMotion};
use toile_lab::scenes::{ball, fabric, hanging_sheet, square};
use toile_lab::{DrawnMaps, Lab, LabError};
use toile_reference::ExactDistance;

const N: u32 = 12;
const FRAMES: u32 = 24;

pub(super) const INSIDE: Case = Case {
    name: "particles that start up to 3 cm inside a body",
    must: "all get out within 0.4 s, none faster than 3 m/s",
    run: inside,
};

pub(super) const TELEPORT: Case = Case {
    name: "a sphere that jumps 1 m into the cloth from one frame to the next",
    must: "finite; elongation below 20 % at the end",
    run: |lab| {
        moved(
            lab,
            vec![key(0.1, DVec3::new(0.5, -1.2, 0.5), 0.0), key(0.1 + 1.0 / 60.0, DVec3::new(0.5, -0.2, 0.5), 0.0)],
        )
    },
};

pub(super) const SPIN: Case = Case {
    name: "cloth on a sphere that spins at 10 rev/s",
    must: "finite; elongation below 20 % at the end",
    run: spin,
};

pub(super) const BULLET: Case = Case {
    name: "a sphere that passes through the cloth's place at 20 m/s",
    must: "finite; no particle ends inside it; elongation below 20 % at the end",
    run: |lab| moved(lab, vec![key(0.05, DVec3::new(0.5, -1.0, 0.5), 0.0), key(0.25, DVec3::new(0.5, 3.0, 0.5), 0.0)]),
};

fn key(time: f64, translation: DVec3, angle: f64) -> RigidKey {
    RigidKey { time, translation, rotation: DQuat::from_rotation_y(angle) }
}

/// A sheet on a sphere whose surface is above it.
fn inside(lab: &Lab) -> Result<Outcome, LabError> {
    let mut settings = Settings::new(fabric());
    settings.gravity = DVec3::ZERO;
    let body = Mesh::sphere(Vec3::ZERO, 0.2, 32);
    // At z = 17 cm, facing the front camera; 12 cm wide, so that its corners are nearly at the surface.
    let sheet = square(N, 0.12, DVec3::new(-0.06, -0.06, 0.17), DVec3::Y, Vec::new());
    let model = Model::from_sheet(&sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    let layers = DrawnMaps::draw(&lab.gpu(), settings.maps, &[(&body, step.thickness)], settings.texel as f32)?;
    let colliders = Colliders::new(Some(layers.maps), Vec::new());
    let (run, course) = course(lab, model, step, colliders, FRAMES)?;
    let exact = ExactDistance::new(&body);
    let depth = exact.penetrations(run.positions(lab)?).map_or(f64::NAN, |depth| depth.max);
    Ok(Outcome {
        happened: format!(
            "deepest particle at {:.2} mm at the end (negative is outside); {}",
            1e3 * depth,
            course.words()
        ),
        held: course.finite && depth < 1e-3 && course.speed_max < 3.0,
    })
}

/// The hanging sheet with a sphere of 15 cm that goes by keys.
fn moved(lab: &Lab, keys: Vec<RigidKey>) -> Result<Outcome, LabError> {
    let (sheet, settings) = hanging_sheet(N);
    let model = Model::from_sheet(&sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    let motion = ShapeMotion::Keys(RigidMotion { keys });
    let mut sphere = Shape::sphere(DVec3::ZERO, 0.15);
    sphere.motion = motion;
    let colliders = Colliders::new(None, vec![sphere.clone()]);
    let (run, course) = course(lab, model, step, colliders, FRAMES)?;
    let depths = run.positions(lab)?.into_iter().map(|p| sphere.depth(p, run.time()));
    let deepest = depths.fold(f64::NEG_INFINITY, f64::max);
    let outside = if deepest > 0.0 { format!("{:.2} mm inside", 1e3 * deepest) } else { "outside".to_owned() };
    Ok(Outcome {
        happened: format!("deepest particle {outside} at the end; {}", course.words()),
        // A sphere that goes on moving may be a step ahead of the cloth that it pushes.
        held: course.finite && deepest < 5e-3 && course.elongation_end < 0.2,
    })
}

/// A free sheet that lies on a sphere.
fn spin(lab: &Lab) -> Result<Outcome, LabError> {
    let settings = Settings::new(fabric());
    let sheet = square(N, 0.4, DVec3::new(-0.2, 0.256, 0.2), DVec3::NEG_Z, Vec::new());
    let model = Model::from_sheet(&sheet, &settings);
    let step = StepSettings::new(&settings, &model);
    // A quarter turn from key to key.
    let keys =
        (0..40).map(|k| key(f64::from(k) / 40.0, DVec3::ZERO, f64::from(k) * std::f64::consts::FRAC_PI_2)).collect();
    let mut sphere = ball();
    sphere.motion = ShapeMotion::Keys(RigidMotion { keys });
    let (_, course) = course(lab, model, step, Colliders::new(None, vec![sphere]), FRAMES)?;
    Ok(Outcome { happened: course.words(), held: course.finite && course.elongation_end < 0.2 })
}
