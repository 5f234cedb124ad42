//! What changes while a simulation runs.

use crate::Error;
use glam::DVec3;
use std::collections::BTreeMap;
use toile_model::{ModelError, Piece};
use toile_scene::{Fabric, OutOfRange, Settings, Shape, Wind};

/// Farthest that a pin may be from the origin [m].
const FARTHEST: f64 = 1e6;

/// What changes while a simulation runs, without new buffers or pipelines. A host takes [`Simulation::control`](crate::Simulation::control), changes what it likes
/// and gives it back to [`Simulation::set_control`](crate::Simulation::set_control).
///
/// Air or pressure where there was none, and another number of shapes, need other passes: then the run goes on in new buffers, which takes as long as
/// the start of a cloth. A host takes [`Cloth::frame`](crate::Cloth::frame) anew then.
///
/// ```no_run
/// # use toile::glam::dvec3;
/// # fn host(simulation: &mut toile::Simulation, encoder: &mut toile::wgpu::CommandEncoder) -> Result<(), toile::Error> {
/// let mut control = simulation.control().clone();
/// control.gravity = dvec3(0.0, -1.62, 0.0);
/// control.pins[0].insert(0, dvec3(0.1, 1.2, 0.0)); // Particle 0 of the first cloth is there at the end of the next advance.
/// simulation.set_control(encoder, &control)?;
/// simulation.advance(encoder, 1.0 / 144.0)?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Control {
    /// Gravity [m/s²]; while garments are sewn there is none.
    pub gravity: DVec3,
    /// The air around the cloth; `None` is none, not even still air. Garments are dressed without it.
    pub wind: Option<Wind>,
    /// What each cloth of the scene is made of, in its order. Density and thickness stay. Stiffness, rigidity and threshold make the numbers of springs and limits anew on the CPU,
    /// which takes as long as meshing does; damping and friction cost nothing.
    pub fabrics: Vec<Fabric>,
    /// The shapes; as many as before until all go together. Each moves on the clock of [`Simulation::time`](crate::Simulation::time).
    pub shapes: Vec<Shape>,
    /// For each cloth of the scene, in its order, the particles that are held, and where each is at the end of the next
    /// [`Simulation::advance`](crate::Simulation::advance) that does a step [m]. In the beginning those are the pins of the sheets. They are held once the run has begun.
    pub pins: Vec<BTreeMap<u32, DVec3>>,
}

impl Control {
    /// What a scene begins with.
    pub(crate) fn of(settings: &Settings, shapes: &[Shape], pieces: &[Piece]) -> Self {
        Self {
            gravity: settings.gravity,
            wind: settings.wind,
            fabrics: pieces.iter().map(|piece| piece.fabric.clone()).collect(),
            shapes: shapes.to_vec(),
            pins: pieces.iter().map(pins_of).collect(),
        }
    }

    /// The settings of a scene with what is controlled.
    pub(crate) fn settings(&self, settings: &Settings) -> Settings {
        let mut settings = settings.clone();
        settings.gravity = self.gravity;
        settings.wind = self.wind;
        settings
    }

    /// Whether springs and limits of a cloth have other numbers than with another fabric.
    pub(crate) fn changes_model(&self, cloth: usize, fabric: &Fabric) -> bool {
        let mut same = self.fabrics[cloth].clone();
        same.name = fabric.name.clone();
        same.damping = fabric.damping;
        same.friction = fabric.friction;
        same != *fabric
    }

    /// Whether it may ask for passes that a cloth under another control has not.
    pub(crate) fn may_ask_for_passes(&self, before: &Self) -> bool {
        let asks = |control: &Self| {
            let presses = control.wind.is_some_and(|wind| wind.pressure != 0.0);
            (control.wind.is_some(), presses, control.shapes.len())
        };
        asks(self) != asks(before)
    }

    /// # Errors
    /// [`Error::Model`] when a number is out of its range.
    ///
    /// # Panics
    /// When it is of another scene, or changes what stays.
    pub(crate) fn check(&self, before: &Self, settings: &Settings) -> Result<(), Error> {
        assert_eq!(self.pins.len(), before.pins.len(), "a control has pins for each cloth of the scene");
        assert_eq!(self.fabrics.len(), before.fabrics.len(), "a control has a fabric for each cloth of the scene");
        let lasting = |fabrics: &[Fabric]| -> Vec<[f64; 2]> {
            fabrics.iter().map(|fabric| [fabric.areal_density, fabric.thickness]).collect()
        };
        assert_eq!(
            lasting(&self.fabrics),
            lasting(&before.fabrics),
            "density and thickness of a cloth stay while it runs: begin a new simulation"
        );
        self.settings(settings).check().map_err(ModelError::from)?;
        self.fabrics.iter().try_for_each(|fabric| fabric.check("fabric.")).map_err(ModelError::from)?;
        self.shapes.iter().try_for_each(Shape::check).map_err(ModelError::from)?;
        for place in self.pins.iter().flat_map(BTreeMap::values) {
            check_place(*place).map_err(ModelError::from)?;
        }
        Ok(())
    }
}

fn check_place(place: DVec3) -> Result<(), OutOfRange> {
    place.to_array().into_iter().try_for_each(|value| OutOfRange::check("pin", value, &(-FARTHEST..=FARTHEST), "m"))
}

/// The particles that a piece begins with pinned, and where.
pub(crate) fn pins_of(piece: &Piece) -> BTreeMap<u32, DVec3> {
    let model = &piece.model;
    let pinned = (0..).zip(&model.inverse_masses).filter(|(_, inverse_mass)| **inverse_mass == 0.0);
    pinned.map(|(particle, _)| (particle, model.positions[particle as usize].as_dvec3())).collect()
}
