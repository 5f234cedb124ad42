//! A sheet that every program is given alike.

use crate::fixtures;
use glam::Vec3;
use toile::model::Model;
use toile::scene::{Form, Scene, Shape};

/// A square sheet of n × n particles, and what acts on it. Particle (column, row) has index row·n + column.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The scene that it is made of.
    pub scene: Scene,
    /// Its sheet as toile simulates it.
    pub model: Model,
    /// Particles on a side.
    pub n: u32,
    /// The sphere, where there is one.
    pub sphere: Option<Sphere>,
}

/// A fixed sphere around the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Distance from the origin that cloth keeps [m]: its thickness is in it.
    pub radius: f64,
    /// Coulomb's coefficient.
    pub friction: f64,
}

impl Trial {
    /// Names of the scenes that there are.
    pub const NAMES: [&str; 2] = ["hang", "ball"];

    /// A scene of [`Trial::NAMES`] at a size.
    ///
    /// # Panics
    /// When there is no such scene.
    pub fn new(name: &str, n: u32) -> Self {
        assert!(Self::NAMES.contains(&name), "the scenes are {:?}, not {name}", Self::NAMES);
        let scene = fixtures::scene(name, &[("n", &n.to_string())]);
        let fabric = &scene.settings.fabric;
        let sphere = fixtures::shapes(&scene).into_iter().find_map(|shape: Shape| match shape.form {
            Form::Sphere { radius } => Some(Sphere { radius: radius + fabric.thickness, friction: fabric.friction }),
            _ => None,
        });
        Self { model: fixtures::sheet_model(&scene), n, sphere, scene }
    }

    /// Length of a frame [s].
    pub fn frame_seconds(&self) -> f64 {
        1.0 / self.scene.settings.frame_rate
    }

    /// Side of a cell [m].
    pub fn spacing(&self) -> f64 {
        1.0 / f64::from(self.n - 1)
    }

    /// Positions at the start [m], shape [n·n].
    pub fn positions(&self) -> &[Vec3] {
        &self.model.positions
    }

    /// Whether both ends of the first row are held.
    pub fn is_held(&self) -> bool {
        self.model.inverse_masses[0] == 0.0
    }
}
