//! A scene turned into immutable arrays: meshing, springs, sewing, limits, colouring.
//!
//! [`Model`] is what the solvers (GPU and reference) read. It is built once on the CPU and never changes. `mesh` makes flat meshes of
//! panels, `cloth` makes the arrays of them, and `run` has what a run needs beside them.

mod cloth;
mod csr;
mod error;
mod fit;
mod mesh;
mod run;
mod union_find;

pub use cloth::digest::digest_of;
pub use cloth::model::{
    Arrays, Attachment, CLUSTER_PAIRS, Cluster, CoarseParticle, Hold, Leader, Level, Limit, Link, Merge, Model,
    PanelMesh, SeamPair, Spring, SpringKind,
};
pub use csr::Csr;
pub use error::ModelError;
pub use fit::axis::Axis;
pub use fit::finding::{Finding, InBody};
pub use fit::{Fit, FitError, FitOptions};
pub use mesh::geometry::NO_CORNER;
pub use mesh::inside::Inside;
pub use run::dressing::{CALM_FRAMES, Dressing, DressingStage, REST_SPEED};
pub use run::map_box::MapBox;
pub use run::motion::Motion;
pub use run::piece::{Open, Piece, raised_ways};
pub use run::pin_target::PinTarget;
pub use run::shape_step::{ShapeKind, ShapeStep};
pub use run::side_box::SideBox;
pub use run::status::Status;
pub use run::step::StepSettings;
pub use run::verdict::{Flaw, Judged, Opening, Place, Solid, Verdict, crossed_particles};
