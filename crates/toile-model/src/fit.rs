//! What is seen before sewing: how the body stands, and how the panels stand around it; what can be mended is.

mod arms;
pub(crate) mod axis;
mod clearing;
mod error;
mod figure;
pub(crate) mod finding;
mod following;
mod laid;
mod outside;
mod pose;
mod section;
mod sleeves;
mod stance;

use crate::Inside;
use axis::Axis;
use clearing::Obstacle;
pub use error::FitError;
use figure::Figure;
use finding::Finding;
use glam::{DMat3, DVec2, DVec3};
use laid::Laid;
use pose::Choice;
use section::Skin;
use sleeves::Sleeve;
use toile_scene::{Body, Cloth, Garment, Mesh, Motion, MovingMesh, Scene};

/// What the caller knows of a body that is else looked for.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct FitOptions {
    /// Which axis of the body is up; `None` is looked for.
    pub up: Option<Axis>,
    /// Along which axis it faces, once it stands upright; `None` is looked for.
    pub facing: Option<Axis>,
    /// The same body with another motion, in whose first pose it is dressed; `None` lets the clearest pose be chosen.
    pub dress_in: Option<MovingMesh>,
}

/// A scene as it is sewn: body and panels mended where they did not stand as patterns need it, and what was found.
///
/// A scene that is fine stays as it is, bit for bit. Only garments around the only mesh of a scene are looked at. What is no person that
/// stands, such as a ball or a table, is neither turned nor followed; panels are moved out of it all the same.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Fit {
    /// What is simulated.
    pub scene: Scene,
    /// The body in the pose that it is dressed in, where that is not the first of its motion. Of a mesh at rest: its way from there to how it stands.
    pub dress_in: Option<MovingMesh>,
    /// What was found, in the order in which it was mended.
    pub findings: Vec<Finding>,
}

impl Fit {
    /// Looks at a scene before anything of it is sewn.
    ///
    /// # Errors
    /// [`FitError`] when a number of the scene is out of its range, or what stands in the way cannot be mended.
    pub fn new(scene: &Scene, options: &FitOptions) -> Result<Self, FitError> {
        scene.check()?;
        options.dress_in.as_ref().map_or(Ok(()), |pose| pose.check("the body to dress in"))?;
        let mut fit = Self { scene: scene.clone(), dress_in: options.dress_in.clone(), findings: Vec::new() };
        if fit.garments().next().is_none() {
            return Ok(fit);
        }
        fit.findings.extend(scene.cloths.iter().flat_map(loose));
        if fit.body().is_none() {
            return Ok(fit);
        }
        fit.stand(options)?;
        fit.place()?;
        Ok(fit)
    }

    /// The only mesh of the scene, in the pose that it is dressed in.
    fn body(&self) -> Option<&Mesh> {
        let mut meshes = self.scene.bodies.iter().filter_map(|body| match body {
            Body::Mesh(mesh) => Some(mesh),
            Body::Moving(moving) => Some(&moving.mesh),
            Body::Shape(_) => None,
        });
        let only = meshes.next().filter(|_| meshes.next().is_none())?;
        Some(self.dress_in.as_ref().map_or(only, |pose| &pose.mesh))
    }

    fn garments(&self) -> impl Iterator<Item = &Garment> {
        self.scene.cloths.iter().filter_map(|cloth| match cloth {
            Cloth::Garment(garment) => Some(garment),
            Cloth::Sheet(_) => None,
        })
    }

    /// Turns the body until it stands upright and faces +z.
    fn stand(&mut self, options: &FitOptions) -> Result<(), FitError> {
        let Some(body) = self.body() else { return Ok(()) };
        let stance = stance::of(body, options)?;
        self.findings.extend(stance.findings);
        if stance.turn == DMat3::IDENTITY {
            return Ok(());
        }
        let is_hosted = |body: &Body| matches!(body, Body::Moving(moving) if matches!(moving.motion, Motion::Hosted));
        if self.scene.bodies.iter().any(is_hosted) {
            return Err(FitError::Hosted);
        }
        for body in &mut self.scene.bodies {
            match body {
                Body::Mesh(mesh) => *mesh = mesh.turned(stance.turn),
                Body::Moving(moving) => *moving = moving.turned(stance.turn),
                Body::Shape(_) => {}
            }
        }
        self.dress_in = self.dress_in.as_ref().map(|pose| pose.turned(stance.turn));
        Ok(())
    }

    /// Turns panels outside out, moves garments to the landmarks of the body, chooses its pose, turns sleeves to its arms, and moves panels out of it.
    fn place(&mut self) -> Result<(), FitError> {
        let Some(body) = self.body() else { return Ok(()) };
        let figure = Figure::of(&Skin::of(body));
        let centre = body.bounds().map_or(DVec3::ZERO, |[low, high]| low.midpoint(high).as_dvec3());
        let middle = figure.as_ref().map_or(DVec2::new(centre.x, centre.z), |figure| figure.middle);
        for cloth in &mut self.scene.cloths {
            let Cloth::Garment(garment) = cloth else { continue };
            self.findings.extend(outside::turn(garment, &Laid::all(garment), middle));
        }
        if let Some(figure) = figure {
            for cloth in &mut self.scene.cloths {
                let Cloth::Garment(garment) = cloth else { continue };
                self.findings.extend(following::follow(garment, &Laid::all(garment), &figure)?);
            }
        }
        self.choose_pose();
        let Some(body) = self.body() else { return Ok(()) };
        let (skin, inside) = (Skin::of(body), Inside::of(body));
        let figure = Figure::of(&skin);
        let bounds = body.bounds();
        let obstacle = Obstacle { inside: &inside, figure: figure.as_ref() };
        let mut findings = Vec::new();
        for cloth in &mut self.scene.cloths {
            let Cloth::Garment(garment) = cloth else { continue };
            let laid = Laid::all(garment);
            if let Some(figure) = &figure {
                let astray = Sleeve::astray(garment, &laid, figure, &skin);
                findings.extend(astray.iter().map(|sleeve| sleeve.turn(garment, figure)));
            }
            findings.extend(clearing::clear(garment, &laid, &obstacle)?);
            findings.extend(bounds.into_iter().flat_map(|bounds| far(garment, &laid, bounds)));
        }
        self.findings.extend(findings);
        Ok(())
    }

    /// Chooses the pose that garments are sewn in, where the host leaves that open.
    fn choose_pose(&mut self) {
        if self.dress_in.is_some() || self.body().is_none() {
            return;
        }
        let garments: Vec<&Garment> = self.garments().collect();
        let is_mesh = |body: &&Body| !matches!(body, Body::Shape(_));
        match self.scene.bodies.iter().find(is_mesh) {
            Some(Body::Moving(moving)) => {
                let choice = pose::choose(moving, &garments);
                if choice.body.is_some() {
                    let Choice { body, time, has_raised_arms } = choice;
                    self.dress_in = body;
                    self.findings.push(match has_raised_arms {
                        true => Finding::RaisedArms { time },
                        false => Finding::Pose { time },
                    });
                }
            }
            Some(Body::Mesh(mesh)) => {
                if let Some(way) = pose::raise_arms(mesh, &garments) {
                    self.dress_in = Some(way);
                    self.findings.push(Finding::RaisedArms { time: None });
                }
            }
            Some(Body::Shape(_)) | None => {}
        }
    }

    /// How badly a body stands for garments as they are placed.
    fn misfit(body: &Mesh, garments: &[&Garment]) -> Misfit {
        let (skin, inside) = (Skin::of(body), Inside::of(body));
        let figure = Figure::of(&skin);
        let mut misfit = Misfit::default();
        for garment in garments {
            let laid = Laid::all(garment);
            let panels = garment.panels.iter().zip(&laid);
            misfit.points += panels.map(|(panel, laid)| laid.places_inside(panel, &inside).len()).sum::<usize>();
            if let Some(figure) = &figure {
                let astray = Sleeve::astray(garment, &laid, figure, &skin);
                misfit.points += astray.iter().map(|sleeve| sleeve.point_count(garment, &laid)).sum::<usize>();
                misfit.swept += arms::in_the_way(garment, &laid, figure, &inside);
            }
        }
        misfit
    }
}

/// How badly a body stands for garments as they are placed.
#[derive(Clone, Copy, Debug, Default)]
struct Misfit {
    /// Points of panels that are in the body, or of a sleeve that does not lie along its arm.
    points: usize,
    /// Points on the ways of seams that are in an arm without a sleeve.
    swept: usize,
}

impl Misfit {
    fn all(self) -> usize {
        self.points + self.swept
    }
}

/// The panels of a cloth that are in no seam, where others are.
fn loose(cloth: &Cloth) -> Vec<Finding> {
    let Cloth::Garment(garment) = cloth else { return Vec::new() };
    let is_sewn = |panel: usize| garment.seams.iter().flat_map(|seam| &seam.sides).any(|side| side.panel == panel);
    let panels = garment.panels.iter().enumerate().filter(|(index, _)| !is_sewn(*index));
    panels.map(|(_, panel)| Finding::Loose { garment: garment.name.clone(), panel: panel.name.clone() }).collect()
}

/// How far a panel may stand from the body [m] before that is told.
const FAR: f64 = 0.5;

/// The panels that stand far from the box around a body [m].
fn far(garment: &Garment, laid: &[Laid], [low, high]: [glam::Vec3; 2]) -> Vec<Finding> {
    let [low, high] = [low.as_dvec3(), high.as_dvec3()];
    let distance = |laid: &Laid, panel| {
        let [from, to] = laid.bounds(panel)?;
        Some((from - high).max(low - to).max(glam::DVec3::ZERO).length())
    };
    let panels = garment.panels.iter().zip(laid);
    let distances = panels.filter_map(|(panel, laid)| Some((panel, distance(laid, panel)?)));
    distances
        .filter(|(_, distance)| *distance > FAR)
        .map(|(panel, distance)| Finding::Far { garment: garment.name.clone(), panel: panel.name.clone(), distance })
        .collect()
}
