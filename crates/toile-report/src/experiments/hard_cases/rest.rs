//! Rest that lasts: no creep and no heat.

use super::case::{Case, Outcome};
use glam::{DVec3, Vec3};
use toile::model::{Model, StepSettings};
use toile::scene::{Settings, Shape};
use toile_lab::scenes::{ball, fabric, hanging_sheet, square};
use toile_lab::{Lab, LabError};
use toile_reference::{Colliders, Reference};

/// Steps at rest by scale: a million in the full report.
const STEPS: [u32; 2] = [10_000, 1_000_000];

pub(super) const HANGING: Case = Case {
    name: "many steps at rest, hanging (10 000 quick, a million in full)",
    must: "it creeps less than 1 mm and stays slower than 1 mm/s",
    run: |lab| {
        let (sheet, settings) = hanging_sheet(6);
        rest(lab, Model::from_sheet(&sheet, &settings), settings, None)
    },
};

pub(super) const LYING: Case = Case {
    name: "many steps at rest, lying on a sphere (10 000 quick, a million in full)",
    must: "it creeps less than 1 mm and stays slower than 1 mm/s",
    run: |lab| {
        let settings = Settings::new(fabric());
        let sheet = square(6, 0.3, DVec3::new(-0.15, 0.256, 0.15), DVec3::NEG_Z, Vec::new());
        rest(lab, Model::from_sheet(&sheet, &settings), settings, Some(ball()))
    },
};

fn rest(lab: &Lab, model: Model, settings: Settings, sphere: Option<Shape>) -> Result<Outcome, LabError> {
    let steps = lab.pick(STEPS[0], STEPS[1]);
    let step = StepSettings::new(&settings, &model);
    let colliders = Colliders::new(None, sphere.into_iter().collect());
    // To rest first, with a damping that the long run does not have.
    let mut damped = step.clone();
    damped.damping = 3.0;
    let mut settling = Reference::new(&model, &damped, colliders.clone());
    (0..9000).for_each(|_| settling.step());
    let at_rest = model.changed(|model| model.positions = settling.positions().to_vec())?;
    let mut reference = Reference::new(&at_rest, &step, colliders);
    let mut speed: f32 = 0.0;
    let mut finite = true;
    let looks = 50;
    for _ in 0..looks {
        reference.steps(steps / looks);
        let status = reference.status();
        speed = speed.max(status.speed_max);
        finite &= status.non_finite_count == 0;
    }
    let creep = |(end, start): (&Vec3, &Vec3)| end.distance(*start);
    let creep = reference.positions().iter().zip(&at_rest.positions).map(creep).fold(0.0, f32::max);
    Ok(Outcome {
        happened: format!(
            "after {steps} steps ({:.0} s): farthest particle {:.4} mm away, fastest {:.4} mm/s",
            f64::from(steps) * f64::from(step.dt),
            1e3 * creep,
            1e3 * speed
        ),
        held: finite && creep < 1e-3 && speed < 1e-3,
    })
}
