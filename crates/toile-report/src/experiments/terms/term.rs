//! The terms of the model that can be left out, and the scene that each is measured in.

/// A scene of the experiment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scene {
    /// A sheet swings down on two corners.
    Hang,
    /// A sheet is laid on a sphere.
    Ball,
    /// A sheet lies on a sphere that swings sideways.
    MovingBall,
}

/// A term of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// Drag and lift of the air.
    Wind,
    /// Springs that span two cells.
    BendSprings,
    /// Limits that span many cells, and from pins outward.
    Levels,
    /// The test of quad midpoints against the body.
    QuadMidpoints,
    /// Friction on the body, by Coulomb's law.
    Friction,
    /// Coulomb's law instead of the papers'.
    FrictionLaw,
    /// The velocities of the surface in the maps of a moving body.
    VelocityMap,
}

impl Scene {
    /// What the report calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hang => "hang",
            Self::Ball => "ball",
            Self::MovingBall => "moving ball",
        }
    }
}

impl Term {
    /// Every term.
    pub const ALL: [Self; 7] = [
        Self::Wind,
        Self::BendSprings,
        Self::Levels,
        Self::QuadMidpoints,
        Self::Friction,
        Self::FrictionLaw,
        Self::VelocityMap,
    ];

    /// What the report calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Wind => "wind of 3 m/s",
            Self::BendSprings => "bend springs",
            Self::Levels => "hierarchical levels",
            Self::QuadMidpoints => "quad midpoints",
            Self::Friction => "friction, Coulomb 0.3",
            Self::FrictionLaw => "Coulomb's law, not the papers'",
            Self::VelocityMap => "velocity map",
        }
    }

    /// The scene that it is measured in.
    pub fn scene(self) -> Scene {
        match self {
            Self::Wind | Self::BendSprings | Self::Levels => Scene::Hang,
            Self::QuadMidpoints | Self::Friction | Self::FrictionLaw => Scene::Ball,
            Self::VelocityMap => Scene::MovingBall,
        }
    }
}
