//! A cloth of an outfit, with what it sees and how the cloth over it sees it.

use crate::Cloth;
use crate::pins::Pins;
use std::sync::Arc;
use toile_gpu::{BodyMaps, Kernels, Raised, Surface, Trail};

/// One cloth and what it sees.
#[derive(Debug)]
pub(crate) struct Layer {
    pub(crate) cloth: Cloth,
    pub(crate) is_worn: bool,
    /// What the host holds of it.
    pub(crate) pins: Pins,
    pub(crate) maps: Option<Arc<BodyMaps>>,
    /// What the maps of the next cloth draw of this one; the outermost has none.
    pub(crate) seen: Option<Seen>,
}

/// A cloth as the one over it sees it.
#[derive(Debug)]
pub(crate) struct Seen {
    pub(crate) surface: Surface,
    pub(crate) trail: Trail,
    /// Where one over it is thinner.
    pub(crate) raised: Option<Raised>,
}

/// What raises a surface by a way [m], and has it be the raised one; `None` where it stays.
pub(crate) fn raised(kernels: &Kernels, surface: &mut Surface, vertex_count: u32, way: f32) -> Option<Raised> {
    (way > 0.0).then(|| {
        let raised = Raised::new(kernels, [&surface.positions, &surface.normals], vertex_count, way);
        surface.positions = raised.positions().clone();
        surface.normals = raised.normals().clone();
        raised
    })
}
