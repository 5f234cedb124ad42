//! What is simulated: panels, seams, fabrics, garments, sheets, bodies and settings.
//!
//! Plain data in SI units (metre, kilogram, second, newton), y up. Flat patterns and placements are f64: they are read
//! once and everything later is derived from them. Nothing here computes a step.

mod body;
mod check;
mod check_body;
mod check_garment;
mod clip;
mod fabric;
mod garment;
mod jump;
mod mesh;
mod moving;
mod number;
mod outline;
mod rig;
mod rigid;
mod settings;
mod shape;
mod sheet;
mod skin;
mod threshold;

pub use body::Body;
pub use clip::{Channel, Clip, Interpolation, Keys};
pub use fabric::Fabric;
pub use garment::{Curve, Edge, EdgeRef, Garment, Panel, Placement, Seam};
pub use jump::{Jump, Lead};
pub use mesh::Mesh;
pub use moving::{MeshSequence, Motion, MovingMesh};
pub use number::{Number, OutOfRange};
pub use rig::{Joint, LocalTransform, OwnAncestor, Rig, RigNode};
pub use rigid::{RigidKey, RigidMotion};
pub use settings::{AIR_DENSITY, Friction, MapKind, Polish, Rule, Settings, VelocityModification, Wind};
pub use shape::{Form, Shape, ShapeMotion};
pub use sheet::{Pin, Sheet};
pub use skin::{Displacement, Influence, Morphs, Pose, Skin, normal_before, turned_normal};
pub use threshold::Threshold;

/// Everything a run needs: the cloth, what it collides with, and how it is simulated.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Scene {
    /// Name shown in pictures and metrics.
    pub name: String,
    /// The cloth. Garments are dressed in this order: each lies over the ones before it.
    pub cloths: Vec<Cloth>,
    /// What the cloth collides with. Empty: no map and no contact kernel exists.
    pub bodies: Vec<Body>,
    /// How it is simulated.
    pub settings: Settings,
}

impl Scene {
    /// A scene without any cloth or body.
    pub fn new(name: impl Into<String>, settings: Settings) -> Self {
        Self { name: name.into(), cloths: Vec::new(), bodies: Vec::new(), settings }
    }

    /// What each cloth is made of, in their order: a fabric of its own, or that of the settings.
    pub fn fabrics(&self) -> impl Iterator<Item = &Fabric> {
        self.cloths.iter().map(|cloth| cloth.fabric().unwrap_or(&self.settings.fabric))
    }
}

/// A piece of cloth.
#[derive(Clone, Debug)]
pub enum Cloth {
    /// A rectangular sheet that starts where it is placed.
    Sheet(Sheet),
    /// Panels that are sewn first.
    Garment(Garment),
}

impl Cloth {
    /// Its name.
    pub fn name(&self) -> &str {
        match self {
            Self::Sheet(sheet) => &sheet.name,
            Self::Garment(garment) => &garment.name,
        }
    }

    /// What it is made of; `None` is the fabric of the settings.
    pub fn fabric(&self) -> Option<&Fabric> {
        match self {
            Self::Sheet(sheet) => sheet.fabric.as_ref(),
            Self::Garment(garment) => garment.fabric.as_ref(),
        }
    }

    /// Has it be made of a fabric of its own.
    pub fn set_fabric(&mut self, fabric: Fabric) {
        match self {
            Self::Sheet(sheet) => sheet.fabric = Some(fabric),
            Self::Garment(garment) => garment.fabric = Some(fabric),
        }
    }
}
