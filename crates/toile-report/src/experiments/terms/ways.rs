//! A scene with a term of the model and without it.

use crate::fixtures::{ball, fabric, hanging_sheet, square};
use crate::shapes::uv_sphere;
use crate::{Lab, LabError, Run};
use glam::{DVec3, Vec3};
use std::sync::Arc;
use toile::Colliders;
use toile::gpu::{BodyMaps, Surface};
use toile::model::{Csr, MapFrame, Model, StepSettings};
use toile::scene::{Friction, Rule, Settings, Sphere, SphereMotion, Wind};

/// Edge length of the texels of the moving sphere [m].
const TEXEL: f32 = 0.01;

/// A term of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// Drag and lift of the air.
    Wind,
    /// Springs that span two cells.
    BendSprings,
    /// The test of quad midpoints against the body.
    QuadMidpoints,
    /// The velocities of the surface in the maps of a moving body.
    VelocityMap,
    /// Friction on the body, by Coulomb's law.
    Friction,
    /// Coulomb's law instead of the papers'.
    FrictionLaw,
    /// Limits that span many cells, and from pins outward.
    Levels,
}

/// With the term or without it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// With the term.
    With,
    /// Without the term.
    Without,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Positions at the end [m], shape [particle_count]; not finite when the run diverged.
    pub positions: Vec<DVec3>,
    /// Cost of a step [state copies].
    pub copies: f64,
    /// The number that [`Term::purpose`] names.
    pub measure: f64,
}

impl Term {
    /// Every term.
    pub const ALL: [Self; 7] = [
        Self::Wind,
        Self::BendSprings,
        Self::QuadMidpoints,
        Self::VelocityMap,
        Self::Friction,
        Self::FrictionLaw,
        Self::Levels,
    ];

    /// What the report calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wind => "wind of 3 m/s",
            Self::BendSprings => "bend springs",
            Self::QuadMidpoints => "quad midpoints",
            Self::VelocityMap => "velocity map",
            Self::Friction => "friction, Coulomb 0.3",
            Self::FrictionLaw => "Coulomb's law, not the papers'",
            Self::Levels => "hierarchical levels",
        }
    }

    /// The scene that it is measured in.
    pub fn scene(self) -> &'static str {
        match self {
            Self::Wind | Self::BendSprings | Self::Levels => "hang",
            Self::QuadMidpoints | Self::Friction | Self::FrictionLaw => "ball",
            Self::VelocityMap => "moving ball",
        }
    }

    /// The number that it is there for, with its unit.
    pub fn purpose(self) -> &'static str {
        match self {
            Self::Wind => "mean displacement down the wind [mm]",
            Self::BendSprings => "mean angle between neighbouring edges [degrees]",
            Self::QuadMidpoints => "deepest midpoint below the thickness [mm]",
            Self::VelocityMap => "mean of the cloth behind the sphere's centre [mm]",
            Self::Friction | Self::FrictionLaw => "mean slip of the cloth on the sphere's top, 0.1 m around [mm]",
            Self::Levels => "largest elongation in the run [%]",
        }
    }

    fn leave_out(self, settings: &mut Settings) {
        match self {
            Self::Wind => settings.wind = None,
            Self::Friction => settings.fabric.friction = 0.0,
            Self::FrictionLaw => settings.friction = Friction::Papers { velocity_kept: 0.8, force_removed: 0.5 },
            Self::Levels => settings.velocity_modification.rule = Rule::Predictive,
            Self::BendSprings => settings.fabric.bend_stiffness = 0.0,
            Self::QuadMidpoints | Self::VelocityMap => {}
        }
    }
}

impl Way {
    /// With or without.
    pub fn word(self) -> &'static str {
        if self == Self::With { "with it" } else { "without" }
    }
}

/// Runs the scene of a term, n × n particles, for some frames.
pub fn outcome(lab: &Lab, term: Term, way: Way, n: u32, frames: u32) -> Result<Outcome, LabError> {
    let mut settings = Settings::new(fabric());
    let sheet = match term.scene() {
        "hang" => hanging_sheet(n).0,
        _ => square(n, 1.0, DVec3::new(-0.5, 0.26, 0.5), DVec3::NEG_Z, Vec::new()),
    };
    settings.wind = (term == Term::Wind).then(|| Wind::new(DVec3::new(0.0, 0.0, -3.0)));
    if way == Way::Without {
        term.leave_out(&mut settings);
    }
    let mut model = Model::from_sheet(&sheet, &settings);
    if way == Way::Without {
        thin(term, &mut model);
    }
    let step = StepSettings::new(&settings, &model);
    if term == Term::VelocityMap {
        return on_moving_ball(lab, model, step, way, frames);
    }
    let sphere = (term.scene() == "ball").then(ball);
    let mut run = Run::new(lab, model, step, Colliders { maps: None, sphere })?;
    let mut elongation_max: f32 = 0.0;
    for _ in 0..frames {
        let Some(status) = run.frame(lab)? else { return diverged(lab, run) };
        elongation_max = elongation_max.max(status.elongation_max);
    }
    let positions = run.positions(lab)?;
    let measure = match term {
        Term::Wind => {
            -1e3 * mean(positions.iter().zip(&run.model.positions).map(|(end, start)| end.z - f64::from(start.z)))
        }
        Term::BendSprings => mean_angle(&positions, n as usize),
        Term::QuadMidpoints => deepest_midpoint(&positions, n as usize, f64::from(run.step.thickness)),
        Term::Friction | Term::FrictionLaw => mean_slip(&positions, &run.model),
        Term::Levels => 1e2 * f64::from(elongation_max),
        Term::VelocityMap => unreachable!("it has a scene of its own"),
    };
    let copies = run.cost(lab, 2)?.copies();
    Ok(Outcome { positions, copies, measure })
}

fn diverged(lab: &Lab, mut run: Run) -> Result<Outcome, LabError> {
    let positions = vec![DVec3::NAN; run.model.positions.len()];
    Ok(Outcome { positions, copies: run.cost(lab, 2)?.copies(), measure: f64::INFINITY })
}

/// Takes out of the model what the settings cannot switch off.
fn thin(term: Term, model: &mut Model) {
    match term {
        // A bend spring without stiffness pulls at nothing, but would still be looked at.
        Term::BendSprings => {
            let rows = (0..model.links.row_count()).map(|i| {
                let row = model.links.row(i).iter().copied();
                row.filter(|link| link.stiffness > 0.0).collect::<Vec<_>>()
            });
            model.links = Csr::from_rows(rows);
        }
        Term::QuadMidpoints => model.particle_quads = Csr::from_rows((0..model.positions.len()).map(|_| [])),
        _ => {}
    }
}

/// The sheet on the sphere that swings, seen through maps that are drawn anew each frame.
fn on_moving_ball(lab: &Lab, model: Model, step: StepSettings, way: Way, frames: u32) -> Result<Outcome, LabError> {
    let sphere = Sphere { motion: SphereMotion::Swing { amplitude: DVec3::new(0.4, 0.0, 0.0), period: 4.0 }, ..ball() };
    let mesh = uv_sphere(Vec3::ZERO, sphere.radius as f32, 24);
    let reach = sphere.radius as f32 + step.thickness + 2.0 * TEXEL;
    let size = MapFrame::size_for(glam::Vec3::splat(2.0 * reach), TEXEL);
    let frame_at = |centre: glam::Vec3| MapFrame::moving([centre - reach, centre + reach], TEXEL, size);
    let maps = Arc::new(BodyMaps::new(&lab.device, frame_at(glam::Vec3::ZERO), true)?);
    let thickness = step.thickness;
    let mut run = Run::new(lab, model, step, Colliders { maps: Some(maps.clone()), sphere: None })?;
    let interval = 1.0 / 60.0;
    let mut centre = DVec3::ZERO;
    for frame in 1..=frames {
        let before = centre;
        centre = sphere.at(f64::from(frame) * interval).0;
        let mut moved = mesh.clone();
        moved.positions.iter_mut().for_each(|position| *position += centre.as_vec3());
        let mut surface = Surface::at_rest(&lab.device, &moved);
        if way == Way::With {
            let velocity = ((centre - before) / interval).as_vec3();
            surface.velocities = Some(lab.vertex_buffer(&vec![velocity; moved.positions.len()]));
        }
        let mut encoder = lab.device.create_command_encoder(&Default::default());
        maps.record(&lab.device, &mut encoder, frame_at(centre.as_vec3()), &[(&surface, thickness)]);
        lab.queue.submit([encoder.finish()]);
        if run.frame(lab)?.is_none() {
            return diverged(lab, run);
        }
    }
    let positions = run.positions(lab)?;
    let measure = 1e3 * (centre.x - mean(positions.iter().map(|position| position.x)));
    let copies = run.cost(lab, 2)?.copies();
    Ok(Outcome { positions, copies, measure })
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_u32), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count.max(1))
}

/// Mean angle between an edge along a row and the next one [degrees].
fn mean_angle(positions: &[DVec3], n: usize) -> f64 {
    let angle = |k: usize| {
        let [a, b, c] = [positions[k], positions[k + 1], positions[k + 2]];
        (b - a).angle_between(c - b).to_degrees()
    };
    mean((0..n * n).filter(|k| k % n + 2 < n).map(angle))
}

/// How deep the deepest midpoint of a quad lies below the surface that is the thickness above the sphere [mm]; 0 for none.
fn deepest_midpoint(positions: &[DVec3], n: usize, thickness: f64) -> f64 {
    let radius = ball().radius + thickness;
    let middle = |k: usize| (positions[k] + positions[k + 1] + positions[k + n] + positions[k + n + 1]) / 4.0;
    let cells = (0..n * (n - 1)).filter(|k| k % n + 1 < n);
    1e3 * cells.map(|k| radius - middle(k).length()).fold(0.0, f64::max)
}

/// Mean sideways way of the particles that start within 0.1 m of the sphere's top [mm].
fn mean_slip(positions: &[DVec3], model: &Model) -> f64 {
    let ways = positions.iter().zip(&model.positions).filter_map(|(end, start)| {
        let start = start.as_dvec3();
        (start.x.hypot(start.z) < 0.1).then(|| (end.x - start.x).hypot(end.z - start.z))
    });
    1e3 * mean(ways)
}
