//! A scene as it is, or with one term changed.

use crate::experiments::terms::term::{Scene, Term};
use glam::{DVec3, Vec3};
use std::sync::Arc;
use toile::Colliders;
use toile::gpu::{BodyMaps, MapSpace, Surface};
use toile::model::{Arrays, Csr, MapBox, Model, StepSettings};
use toile::scene::{Friction, MapKind, Mesh, Rule, Settings, Shape, ShapeMotion, VelocityModification, Wind};
use toile_lab::scenes::{BALL_RADIUS, ball, fabric, hanging_sheet, square};
use toile_lab::{Lab, LabError, Run};

/// Edge length of the texels of the moving sphere [m].
const TEXEL: f32 = 0.01;
/// Time from one drawing of its maps to the next, and length of a frame [s].
const INTERVAL: f64 = 1.0 / 60.0;

/// A scene as it is, or with one term changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trial {
    /// The scene.
    pub scene: Scene,
    /// The term that is left out; wind is added.
    pub changed: Option<Term>,
}

impl Term {
    /// The trial that has it. Wind is no part of the scene as it is; all others are.
    pub fn with(self) -> Trial {
        Trial { scene: self.scene(), changed: (self == Self::Wind).then_some(self) }
    }

    /// The trial that lacks it.
    pub fn without(self) -> Trial {
        Trial { scene: self.scene(), changed: (self != Self::Wind).then_some(self) }
    }
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Positions at the start [m], shape [particle_count].
    pub start: Vec<DVec3>,
    /// Positions at the end [m], shape [particle_count]; not finite when the run diverged.
    pub positions: Vec<DVec3>,
    /// Corners of the quads.
    pub quads: Vec<[u32; 4]>,
    /// Distance that the cloth keeps from the body [m].
    pub thickness: f64,
    /// Where the sphere is at the end [m].
    pub centre: DVec3,
    /// Largest elongation at the end of any frame [1].
    pub elongation_max: f64,
    /// Cost of a step [state copies].
    pub copies: Option<f64>,
}

/// Runs a trial with n × n particles for some frames.
pub fn outcome(lab: &Lab, trial: Trial, n: u32, frames: u32) -> Result<Outcome, LabError> {
    let mut settings = Settings::new(fabric());
    let sheet = match trial.scene {
        Scene::Hang => hanging_sheet(n).0,
        Scene::Ball | Scene::MovingBall => square(n, 1.0, DVec3::new(-0.5, 0.256, 0.5), DVec3::NEG_Z, Vec::new()),
    };
    change_settings(trial, &mut settings);
    let model = Model::from_sheet(&sheet, &settings).changed(|model| change_model(trial, model))?;
    let step = StepSettings::new(&settings, &model);
    let moving = match trial.scene {
        Scene::MovingBall => Some(MovingBall::new(lab, &step, trial.changed != Some(Term::VelocityMap))?),
        Scene::Hang | Scene::Ball => None,
    };
    let colliders = Colliders::new(
        moving.as_ref().map(|ball| ball.maps.clone()),
        (trial.scene == Scene::Ball).then(ball).into_iter().collect(),
    );
    let mut run = Run::new(lab, model, step, colliders)?;
    let mut elongation_max: f64 = 0.0;
    for frame in 1..=frames {
        if let Some(ball) = &moving {
            ball.draw(lab, frame);
        }
        let Some(status) = run.frame(lab)? else { break };
        elongation_max = elongation_max.max(f64::from(status.elongation_max));
    }
    let positions = if run.diverged() { vec![DVec3::NAN; run.model.positions.len()] } else { run.positions(lab)? };
    Ok(Outcome {
        start: run.model.positions.iter().map(|position| position.as_dvec3()).collect(),
        positions,
        quads: run.model.quads.clone(),
        thickness: f64::from(run.step.thickness),
        centre: moving.map_or(DVec3::ZERO, |ball| ball.sphere.at(f64::from(frames) * INTERVAL).0),
        elongation_max,
        copies: run.cost(lab, 3)?.copies(),
    })
}

fn change_settings(trial: Trial, settings: &mut Settings) {
    match trial.changed {
        Some(Term::Wind) => settings.wind = Some(Wind::new(DVec3::new(0.0, 0.0, -3.0))),
        Some(Term::BendSprings) => settings.fabric.bend_stiffness = 0.0,
        Some(Term::Levels) => {
            let sweeps = Some(Rule::Hierarchical.sweeps());
            settings.velocity_modification = VelocityModification::new(Rule::Predictive);
            settings.velocity_modification.sweeps = sweeps;
        }
        Some(Term::Friction) => settings.fabric.friction = 0.0,
        Some(Term::FrictionLaw) => {
            settings.friction = Friction::Papers { velocity_kept: 0.8, force_removed: 0.5 };
        }
        Some(Term::QuadMidpoints | Term::VelocityMap) | None => {}
    }
}

/// Takes out of the model what the settings cannot switch off.
fn change_model(trial: Trial, model: &mut Arrays) {
    match trial.changed {
        // A spring without stiffness pulls at nothing, but would still be looked at.
        Some(Term::BendSprings) => {
            let rows = (0..model.links.row_count()).map(|i| {
                let row = model.links.row(i).iter().copied();
                row.filter(|link| link.stiffness > 0.0).collect::<Vec<_>>()
            });
            model.links = Csr::from_rows(rows);
        }
        Some(Term::QuadMidpoints) => model.particle_quads = Csr::from_rows((0..model.positions.len()).map(|_| [])),
        _ => {}
    }
}

/// A sphere that swings sideways, seen through maps that are drawn anew each frame.
struct MovingBall {
    sphere: Shape,
    maps: Arc<BodyMaps>,
    thickness: f32,
    size: [u32; 3],
    with_velocities: bool,
}

impl MovingBall {
    fn new(lab: &Lab, step: &StepSettings, with_velocities: bool) -> Result<Self, LabError> {
        let swing = ShapeMotion::Swing { amplitude: DVec3::new(0.4, 0.0, 0.0), period: 4.0 };
        let mut sphere = ball();
        sphere.motion = swing;
        let thickness = step.thickness;
        let size = MapBox::size_for(Vec3::splat(2.0 * reach(thickness)), TEXEL);
        let map_box = map_box_at(&sphere, 0.0, thickness, size);
        // Area of a sphere.
        let area = 4.0 * std::f64::consts::PI * BALL_RADIUS * BALL_RADIUS;
        let mut space = MapSpace::new(MapKind::Layers, map_box, area);
        space.moving = with_velocities;
        let maps = Arc::new(BodyMaps::new(&lab.device, &space)?);
        Ok(Self { sphere, maps, thickness, size, with_velocities })
    }

    /// Draws the maps of the end of a frame.
    fn draw(&self, lab: &Lab, frame: u32) {
        let time = f64::from(frame) * INTERVAL;
        let [before, centre] = [time - INTERVAL, time].map(|time| self.sphere.at(time).0);
        let mut mesh = Mesh::sphere(Vec3::ZERO, BALL_RADIUS as f32, 24);
        mesh.positions.iter_mut().for_each(|position| *position += centre.as_vec3());
        let mut surface = Surface::new(&lab.device, &mesh, TEXEL);
        if self.with_velocities {
            let velocity = ((centre - before) / INTERVAL).as_vec3();
            surface.velocities = Some(lab.vertex_buffer(&vec![velocity; mesh.positions.len()]));
        }
        let map_box = map_box_at(&self.sphere, time, self.thickness, self.size);
        let mut encoder = lab.device.create_command_encoder(&Default::default());
        self.maps.record(&lab.device, &mut encoder, map_box, &[(&surface, self.thickness)]);
        lab.queue.submit([encoder.finish()]);
    }
}

fn reach(thickness: f32) -> f32 {
    BALL_RADIUS as f32 + thickness + 2.0 * TEXEL
}

fn map_box_at(sphere: &Shape, time: f64, thickness: f32, size: [u32; 3]) -> MapBox {
    let [centre, reach] = [sphere.at(time).0.as_vec3(), Vec3::splat(reach(thickness))];
    MapBox::moving([centre - reach, centre + reach], TEXEL, size)
}
