//! Sheets that come to rest, for the experiments that ask where.

use glam::DVec3;
use toile::Colliders;
use toile::model::{Arrays, Model, StepSettings};
use toile::scene::{Pin, Rule, Settings, Sheet, VelocityModification};
use toile_lab::scenes::{BALL_RADIUS, ball, fabric, square};
use toile_lab::{Lab, LabError, Run};

/// Damping that brings the sheets to rest soon [1/s]: about the critical one of the slowest motion, a swing of the hammock.
const DAMPING: f64 = 20.0;
/// Speed below which a sheet is at rest [m/s].
const SPEED_AT_REST: f32 = 2e-3;
/// Longest simulated time [s].
const SECONDS_MAX: f64 = 4.0;
/// Width of the hammock between its pins, as part of its length.
const HAMMOCK_WIDTH: f64 = 0.9;
/// Sag that it starts with [m].
const HAMMOCK_SAG: f64 = 0.12;
/// Height above the sphere that the cap starts with [m]: just above the thickness.
const CAP_HEIGHT: f64 = 0.0055;

/// A scene that has one rest shape, or nearly so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestScene {
    /// A sheet of 0.5 m × 0.5 m between two held edges that are 0.45 m apart.
    Hammock,
    /// A sheet of 0.4 m × 0.4 m laid around the top of a sphere of radius 0.25 m.
    Cap,
}

/// What is changed against the settings of a user who changes nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestSettings {
    /// Particles on a side.
    pub n: u32,
    /// Rule of the velocity modification.
    pub rule: Rule,
    /// Its sweeps.
    pub sweeps: u32,
    /// By how much the step is divided.
    pub step_division: u32,
    /// Frames per second [1/s].
    pub frame_rate: f64,
}

/// Where a sheet came to rest.
#[derive(Clone, Debug)]
pub struct Rest {
    /// Positions [m], shape [particle_count]; not finite when the run diverged.
    pub positions: Vec<DVec3>,
    /// Steps per second [1/s].
    pub steps_per_second: f64,
    /// Simulated time [s].
    pub seconds: f64,
    /// Largest speed at the end [m/s].
    pub speed: f64,
}

impl RestScene {
    /// What a caption says of it.
    pub fn description(self) -> &'static str {
        match self {
            RestScene::Hammock => "a sheet of 0.5 m × 0.5 m between two held edges 0.45 m apart",
            RestScene::Cap => {
                "a sheet of 0.4 m × 0.4 m laid around the top of a sphere of radius 0.25 m (thickness 5 mm, Coulomb friction 0.3)"
            }
        }
    }

    fn sheet(self, n: u32) -> Sheet {
        match self {
            RestScene::Hammock => {
                let pins = (0..n).flat_map(|row| [Pin { column: 0, row }, Pin { column: n - 1, row }]).collect();
                square(n, 0.5, DVec3::new(-0.25, 0.0, -0.25), DVec3::Z, pins)
            }
            RestScene::Cap => square(n, 0.4, DVec3::new(-0.2, 0.0, 0.2), DVec3::NEG_Z, Vec::new()),
        }
    }

    /// Puts the flat sheet near to where it will rest: the hammock along an arc, the cap around the sphere as a map around its pole.
    fn place(self, model: &mut Arrays) {
        for position in &mut model.positions {
            let flat = position.as_dvec3();
            let placed = match self {
                RestScene::Hammock => {
                    let s = flat.x / 0.25;
                    DVec3::new(HAMMOCK_WIDTH * flat.x, -HAMMOCK_SAG * (1.0 - s * s), flat.z)
                }
                RestScene::Cap => {
                    let radius = BALL_RADIUS + CAP_HEIGHT;
                    let way = flat.x.hypot(flat.z);
                    let (sin, cos) = (way / radius).sin_cos();
                    let outward = if way > 0.0 { radius * sin / way } else { 0.0 };
                    DVec3::new(flat.x * outward, radius * cos, flat.z * outward)
                }
            };
            *position = placed.as_vec3();
        }
    }
}

impl RestSettings {
    /// The default settings with n × n particles.
    pub fn new(n: u32) -> Self {
        let rule = Rule::Hierarchical;
        Self { n, rule, sweeps: rule.sweeps(), step_division: 1, frame_rate: 60.0 }
    }
}

/// Simulates a scene until it rests.
pub fn come_to_rest(lab: &Lab, scene: RestScene, change: RestSettings) -> Result<Rest, LabError> {
    let mut settings = Settings::new(fabric());
    settings.fabric.damping = DAMPING;
    settings.frame_rate = change.frame_rate;
    settings.velocity_modification = VelocityModification::new(change.rule);
    settings.velocity_modification.sweeps = Some(change.sweeps);
    let model = Model::from_sheet(&scene.sheet(change.n), &settings).changed(|model| scene.place(model))?;
    let mut step = StepSettings::new(&settings, &model);
    step.dt /= change.step_division as f32;
    step.steps_per_frame *= change.step_division;
    let steps_per_second = f64::from(step.steps_per_frame) * change.frame_rate;
    let colliders = Colliders::new(None, (scene == RestScene::Cap).then(ball).into_iter().collect());
    let mut run = Run::new(lab, model, step, colliders)?;
    let mut speed = f64::INFINITY;
    while run.time() < SECONDS_MAX {
        let Some(status) = run.frame(lab)? else {
            return Ok(Rest {
                positions: vec![DVec3::NAN; run.model.positions.len()],
                steps_per_second,
                seconds: run.time(),
                speed: f64::INFINITY,
            });
        };
        speed = f64::from(status.speed_max);
        // Everything is at rest at the very start, too.
        if status.speed_max < SPEED_AT_REST && run.time() > 0.2 {
            break;
        }
    }
    Ok(Rest { positions: run.positions(lab)?, steps_per_second, seconds: run.time(), speed })
}
