//! A rectangular sheet of cloth.

use crate::Fabric;
use glam::{DVec2, DVec3};

/// A rectangular sheet: the columns × rows grid of mass points of D §3.
///
/// Particle (column, row) starts at corner + right·size.x·column/(columns − 1) + down·size.y·row/(rows − 1) and has index
/// row·columns + column. The outside is right × down, so a sheet with right = x and down = z faces −y.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Sheet {
    /// Name shown in metrics and meshes.
    pub name: String,
    /// Number of particles along `right`, at least 2.
    pub columns: u32,
    /// Number of particles along `down`, at least 2.
    pub rows: u32,
    /// Rest length along `right` and `down` [m].
    pub size: DVec2,
    /// World position of particle (0, 0) [m].
    pub corner: DVec3,
    /// Unit direction of the columns.
    pub right: DVec3,
    /// Unit direction of the rows, perpendicular to `right`.
    pub down: DVec3,
    /// Particles that do not move.
    pub pins: Vec<Pin>,
    /// What it is made of; `None` is the fabric of the settings.
    pub fabric: Option<Fabric>,
}

impl Sheet {
    /// A sheet of `[columns, rows]` particles and of this size [m]. It lies at the origin with its columns along x and its rows along z, held
    /// nowhere, of the fabric of the settings.
    pub fn new(name: impl Into<String>, [columns, rows]: [u32; 2], size: DVec2) -> Self {
        Self {
            name: name.into(),
            columns,
            rows,
            size,
            corner: DVec3::ZERO,
            right: DVec3::X,
            down: DVec3::Z,
            pins: Vec::new(),
            fabric: None,
        }
    }
}

/// A particle of a sheet that does not move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pin {
    /// Column, below [`Sheet::columns`].
    pub column: u32,
    /// Row, below [`Sheet::rows`].
    pub row: u32,
}
